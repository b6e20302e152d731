"""The two-storey pair, contacts and bars of one direction at the end of what the method bears.

Below the stable step the pair's largest displacement is that of half the step, above it the run stops by itself. Contacts
that hold a place twice, or on meshes that hardly differ, move it as once. What can only take energy gives none.
"""
import math
import tempfile
import unittest
from pathlib import Path

import numpy

import program
from history import History, refused, scenes
from small_meshes import brick

BAR = 2 * (2e9 * 1e-4 / 5) * 0.8**2  # stiffness of the pair of tension-only bars on one side [N/m]
MASS = 100.0
CELLS = 3  # along each side of the faces
SNAP = 1e-6  # of the program: a node this close to another, in cells, is paired with it as it stands
LONG = program.ALL


def pair(peak=6.0):
    return scenes.shaken_pair(Path(tempfile.mkdtemp()), peak, 0.5)


class Pair(unittest.TestCase):
    def test_time_step_up_to_the_stable_one_and_above(self):
        stable = History(self, [*pair(), "-end_time", 1e-9]).summary["stable_time_step"]
        reference = None
        for fraction in (0.5, 0.8, 0.9, 0.99, 0.999, 1.0) if LONG else (0.5, 0.999):
            run = History(self, [*pair(), "-time_step", repr(fraction * stable), "-allow_unstable", "true"], 2)
            peak = abs(run.data["displacement"]).max()
            reference = reference or peak
            self.assertLessEqual(abs(peak / reference - 1), 0.02, fraction)
        for fraction in (1.001, 1.003, 1.01) if LONG else (1.01,):
            words = [*pair(), "-time_step", repr(fraction * stable)]
            refused(self, [*words, "-allow_unstable", "true"], "diverged", ranks=2)
            refused(self, words, "-time_step")

    @program.long
    def test_shaking_from_nothing_to_a_thousand_g(self):
        for peak in (0.0, 1e-6, 1e-3, 0.1, 1.0, 10.0, 100.0, 1000.0):
            run = History(self, scenes.shaken_pair(Path(tempfile.mkdtemp()), peak * 9.80665), 2)
            self.assertLessEqual(run.energy["relative_residual"], 1e-9, peak)
            for name in ("displacement", "velocity", "acceleration"):
                self.assertTrue(numpy.isfinite(run.data[name]).all(), peak)
                self.assertEqual(abs(run.data[name]).max() == 0, peak == 0, (name, peak))

    @program.long
    def test_a_million_steps_come_to_rest(self):
        step = History(self, [*pair(), "-end_time", 1e-9]).summary["time_step"]
        run = History(self, [*pair(), "-end_time", repr(1e6 * step), "-output_interval", repr(50 * step)], 2)
        self.assertLessEqual(run.energy["relative_residual"], 1e-9)
        self.assertTrue(numpy.array_equal(run.time, numpy.rint(run.time / step) * step))
        self.assertLessEqual(0, run.energy["kinetic"] + run.energy["strain"])
        self.assertLessEqual(run.energy["kinetic"] + run.energy["strain"], run.energy["input"])


def struck(shift=0.0):
    """Two soft cubes of 1 m, the first thrown at the second; the nodes inside the second one's face lie `shift` [m] beside
    those that they meet."""
    words = scenes.blocks((2.0, 3.0), young=1e7, time_step=1e-4, end_time=0.02)
    for name, start in (("one", -1), ("two", 0)):
        mesh = brick((start, 0, 0), (start + 1, 1, 1), (1, CELLS, CELLS))
        inside = (mesh.nodes[:, 1] > 0.1) & (mesh.nodes[:, 1] < 0.9)
        mesh.nodes[inside, 1] += shift if name == "two" else 0.0
        words[words.index(f"-{name}_mesh") + 1] = mesh.write(f"{tempfile.mkdtemp()}/{name}.msh")
        words[words.index(f"-{name}_mesh_set") + 1] = "none"
    return words


def again(secondary, primary):
    """The cubes with their contact once more."""
    words = struck()
    words[words.index("-contacts") + 1] += ",twin"
    return [*words, "-twin_secondary", secondary, "-twin_primary", primary, "-twin_gap", 0.001]


class Rows(unittest.TestCase):
    def test_that_are_there_twice_or_nearly_change_nothing(self):
        faces = ("one:x_max", "two:x_min")
        shifts = (0.0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-3) if LONG else (0.0, 1e-9, 1e-5)
        twice = [("listed twice", again(*faces), 0.0), ("sides swapped", again(*faces[::-1]), 0.0)]
        twice += [(f"nodes {shift:g} m apart", [*struck(shift), "-joint_passes", 2], shift) for shift in shifts]
        once = History(self, struck())
        for case, words, shift in twice:
            allowed = 1e-9 + (shift if shift * CELLS < SNAP else 0.0)
            alone, run = History(self, words), History(self, words, 2)
            rows = (32, 32)
            if "-joint_passes" in words:  # which holds a pair of nodes once; half of them are shifted
                rows = (16, 0) if shift * CELLS < SNAP else (24, 24)
            self.assertEqual((run.summary["contact_rows"], run.summary["coupled_rows"]), rows, case)
            for other in (once, alone):
                for name in ("velocity", "displacement"):
                    self.assertLessEqual(abs(run.data[name] - other.data[name]).max() / abs(other.data[name]).max(),
                                         allowed, (case, name))
            impacts, reference = run.summary["impacts"], once.summary["impacts"]
            self.assertLessEqual(abs(impacts["total_impulse"] / reference["total_impulse"] - 1), allowed, case)
            self.assertLessEqual(impacts["complementarity_residual"], allowed, case)


def hung_mass(ratio, beta, courant):
    """A mass on a grounded spring 1 / ratio times as stiff as the tension-only bars on its left."""
    spring = repr(BAR / ratio)
    period = 2 * math.pi * math.sqrt(MASS * ratio / BAR / (1 + ratio))
    return ["-structures", "frame", "-frame_mesh", "tests/meshes/braces.geo", "-frame_clamp", "anchors",
            "-frame_ignore", "right", "-frame_initial_velocity", "1,0,0", "-frame_damping_beta", repr(beta * period),
            *scenes.material("steel", 2e9, 0.3, 1e-9), "-courant", courant, "-end_time", repr(300 * period),
            "-output_interval", repr(period), "-energy_interval", 1, "-frame_mass_element", "point_mass",
            "-frame_mass_mass", MASS, "-frame_left_element", "bar", "-frame_left_material", "steel",
            "-frame_left_area", 1e-4, "-frame_left_tension_only", "true", "-frame_support_element", "grounded_spring",
            "-frame_support_stiffness", f"{spring},{spring},{spring}", *scenes.cheap("frame:mass")]


class NoEnergyIsGiven(unittest.TestCase):
    def column(self, run, *names):
        """Sum of columns of the ledger."""
        return sum(numpy.array(run.ledger[name], dtype=float) for name in names)

    def test_bars_that_switch(self):
        """The limit of the taut bars is no limit of the switching ones where their tension is frozen."""
        for ratio in (0.01, 0.1, 0.2, 0.5, 1.0, 2.0, 10.0, 100.0) if LONG else (0.2, 10.0):
            for courant in (0.4, 0.6, 0.9, 0.99) if LONG else (0.4, 0.9):
                for beta in (0.0, 1e-3):
                    run = History(self, hung_mass(ratio, beta, courant))
                    energy = self.column(run, "kinetic", "strain")
                    self.assertLessEqual(max(0.0, numpy.diff(energy).max()) / energy[0], 1e-9, (ratio, courant, beta))
                    self.assertLessEqual(run.energy["relative_residual"], 1e-9, (ratio, courant, beta))

    def test_dashpots_and_damping(self):
        """Two masses on springs, thrown, with one thing at a time that takes energy."""
        devices = {"-chain_support_dashpot": "{},0,0", "-chain_link2_dashpot": "{},0,0", "-chain_link2_damping_beta": "{}",
                   "-chain_damping_alpha": "{}", "-chain_damping_beta": "{}"}
        for option, value in devices.items():
            for ratio in (0.01, 1.0, 30.0) if LONG else (1.0,):
                run = History(self, ["-structures", "chain", *scenes.two_masses("chain", 1.0, 1.0, 0.5), "-end_time", 30,
                                     "-output_interval", 0.1, "-energy_interval", 1, option,
                                     value.format(repr(2 * ratio)), *scenes.cheap("chain:first")])
                taken = self.column(run, "damping_loss", "device_work", "plastic_loss")
                first = self.column(run, "kinetic", "strain")[0]
                self.assertGreater(taken[-1] / first, 0.01, (option, ratio))
                self.assertLessEqual(max(0.0, -numpy.diff(taken).min()) / first, 1e-12, (option, ratio))
                self.assertLessEqual(run.energy["relative_residual"], 1e-12, (option, ratio))


if __name__ == "__main__":
    unittest.main()
