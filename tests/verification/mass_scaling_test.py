"""Scaled mass: what it costs in frequencies, the new limit of the time step, and impacts on it.

The stiff beams of a structure get the mass S = sum of c_e K_e beside M. A mode phi of frequency omega,
phi^T M phi = 1, changes by a part c omega^2 of its squared frequency times the share of its strain energy
in these beams, so by at most max(c) omega^2. References: that bound; the coarse two-storey pair with a
small step.
"""
import math
import tempfile
import unittest

import numpy

import decks
import modal_run
import program
from recorded import Recorded

BETA = 2e-5
ELEMENTS, STEP = 12, 1.2e-4  # s, four times what the portal allows


def portal(step):
    """Columns and a girder of one section; so stiff out of the plane that the lowest modes are plane."""
    words = modal_run.material(200e9, 0.3, 7800) + ["-@_clamp", "base"]
    for name in ("columns", "girder"):
        words += modal_run.group(name, "beam", section=f"@{name[0]}")
        words += decks.section(f"@{name[0]}", 5.38e-3, 1.673e-5, 1.673e-5, 3e-5)
    words += ["-@_damping_alpha", 0.2, "-@_damping_beta", BETA]
    if step:
        words += ["-@_mass_scaling", step]
    return modal_run.case("portal", words, n=ELEMENTS)


class Frequencies(unittest.TestCase):
    def test_low_modes_move_by_less_than_predicted(self):
        plain, scaled = modal_run.structures(self, [portal(0), portal(STEP)], modes=12)
        scaling = scaled["mass_scaling"]
        self.assertEqual(scaling["elements"], 3 * ELEMENTS)
        self.assertEqual(scaling["coupled_dofs"], 6 * (3 * ELEMENTS - 1))
        self.assertGreater(scaled["stable_time_step"], STEP)
        self.assertLess(plain["stable_time_step"], 0.4 * STEP)
        falls = [after / before - 1 for before, after in zip(modal_run.frequencies(plain), modal_run.frequencies(scaled))]
        self.assertAlmostEqual(scaling["largest_change"] / min(falls), 1, delta=0.01)
        c = scaling["largest_factor"]
        self.assertLess(c, STEP * (2 * BETA + STEP) / 4)
        for before, after in zip(modal_run.frequencies(plain), modal_run.frequencies(scaled)):
            change = 1 - (after / before)**2
            bound = c * (2 * math.pi * before)**2
            self.assertGreater(change, 0.5 * bound)  # every element is scaled, by nearly the same
            self.assertLess(change, bound * (1 + 1e-6))

    def test_without_stiff_elements_nothing_changes(self):
        plain, asked = modal_run.structures(self, [portal(0), portal(1e-7)], modes=4)
        self.assertEqual(asked["mass_scaling"]["elements"], 0)
        self.assertEqual(asked["mass_scaling"]["coupled_dofs"], 0)
        for name in ("omega_max", "stable_time_step", "frequencies"):
            self.assertEqual(plain[name], asked[name])


class NewLimit(unittest.TestCase):
    def swing(self, part, steps):
        """Free vibration with a part of the new stable step."""
        limit = modal_run.structures(self, [portal(STEP)])[0]["stable_time_step"]
        words = [str(word).replace("@", "b0") for word in portal(STEP)]
        return ["-structures", "b0", *words, "-b0_initial_velocity", "1,2,3", "-modes", 0,
                "-time_step", repr(part * limit), "-end_time", repr(steps * part * limit),
                "-spectra_frequencies", 10, "-allow_unstable"]

    def test_below_it_the_run_is_stable_and_its_energy_balance_closes(self):
        _, summary = program.must_run(self, self.swing(0.99, 4000))
        energy = summary["energy"]
        # Measured: 1.5e-12, and 1.2e-12 for the frame without scaled mass at its own limit.
        self.assertLess(energy["relative_residual"], 1e-11)
        start = summary["structures"]["b0"]["mass"] * (1 + 4 + 9) / 2
        self.assertLess(energy["kinetic"] + energy["strain"], start)
        self.assertGreater(energy["damping"], 0.1 * start)

    def test_above_it_the_run_diverges_and_says_so(self):
        with tempfile.TemporaryDirectory() as folder:
            result = program.run(self.swing(1.001, 60000) + ["-output", folder])
        self.assertEqual(result.returncode, 1)
        line, = program.error_lines(result)
        self.assertIn("the run diverged: structure b0", line)


class Opening(unittest.TestCase):
    """A pipe goes through a slab of the small plant pair: a few elements round it, a tenth of the others' size."""

    PLANT = ["-options_file", "petsc-options/plant/small.yaml", "-block_mesh_set", "m=1,pipe=0.3,finer=12",
             "-floor1_gap", 0.001, "-floor2_gap", 0.001, "-frame_initial_velocity", "-0.2,0,0", "-end_time", 0.2,
             "-output_interval", 2e-4]
    STEP = 8.5e-5  # s

    @classmethod
    def setUpClass(cls):
        cls.plain = cls().run_of("-time_step", 2e-5)
        cls.scaled = cls().run_of("-block_mass_scaling", cls.STEP)

    def run_of(self, *words):
        return Recorded(self, [*self.PLANT, "-modes", 6, *words])

    def test_the_rest_holds_the_step(self):
        plain, scaled = (run.summary["structures"]["block"] for run in (self.plain, self.scaled))
        scaling = scaled["mass_scaling"]
        self.assertGreater(scaled["stable_time_step"], self.STEP)
        self.assertLess(plain["stable_time_step"], 0.4 * self.STEP)
        self.assertGreater(scaling["coupled_dofs"], 0)
        self.assertLess(scaling["coupled_dofs"], 0.15 * scaled["dofs"])
        for before, after in zip(plain["frequencies"], scaled["frequencies"]):
            change = 1 - (after["frequency"] / before["frequency"])**2
            self.assertLess(change, scaling["largest_factor"] * (2 * math.pi * before["frequency"])**2)
            self.assertGreater(change, -1e-9)

    def test_impacts_and_histories_are_those_of_small_steps(self):
        self.assertGreater(self.plain.summary["impacts"]["episodes"], 0)
        self.assertEqual(self.plain.summary["impacts"]["episodes"], self.scaled.summary["impacts"]["episodes"])
        # Impacts begin with a step: those of 1e-5 and 2e-5 s alone are 4e-3 apart. Of one step only mass differs.
        for run, allowed in ((self.scaled, 2e-2), (self.run_of("-block_mass_scaling", self.STEP, "-time_step", 2e-5), 1e-5)):
            for probe in ("block_floor.x", "tower_roof.x", "frame_floor2.x"):
                expected = self.plain.displacement(probe)
                found = numpy.interp(self.plain.time, run.time, run.displacement(probe))
                self.assertLess(abs(found - expected).max() / abs(expected).max(), allowed, probe)


def slabs(step, scaling):
    words = program.COARSE_PAIR + [
        "-motion_x_pga", 1e-9, "-s1_initial_velocity", "0.3,0,0", "-floor2_gap", "2e-4", "-floor1_gap", "0.02", "-end_time",
        0.012, "-time_step", repr(step), "-output_interval", 1e-4 * (1 + 1e-9), "-energy_interval", 10]
    return words + (["-s1_mass_scaling", scaling, "-s2_mass_scaling", scaling] if scaling else [])


class Impact(unittest.TestCase):
    """The upper slabs of the coarse pair meet at 0.3 m/s, at nodes that beams couple."""

    def slabs(self, step, scaling):
        return Recorded(self, slabs(step, scaling), identity=1e-11)

    def test_errors_fall_with_the_step(self):
        reference = self.slabs(2e-6, 0)
        histories, impulses = [], []
        for step in (4e-5, 2e-5, 1e-5):
            run = self.slabs(step, step)
            self.assertEqual(run.summary["impacts"]["episodes"], reference.summary["impacts"]["episodes"])
            error = 0
            for probe in ("s1_floor2.x", "s2_floor2.x"):
                expected = reference.displacement(probe)
                found = numpy.interp(reference.time, run.time, run.displacement(probe))
                error = max(error, abs(found - expected).max() / abs(expected).max())
            histories.append(error)
            impulses.append(abs(run.summary["impacts"]["total_impulse"] /
                                reference.summary["impacts"]["total_impulse"] - 1))
        # Measured: 2.1e-3, 2.2e-3, 4.8e-4, where the moment of contact falls within a step decides;
        # and 6.8e-4, 2.3e-4, 8.8e-5.
        self.assertLess(max(histories), 5e-3)
        self.assertLess(histories[-1], 0.4 * histories[0])
        self.assertLess(impulses[0], 1.5e-3)
        self.assertLess(impulses[-1], 0.3 * impulses[0])


ON_RANKS = {"slabs that meet where scaled mass couples them": slabs(4e-5, 4e-5)}


if __name__ == "__main__":
    unittest.main()
