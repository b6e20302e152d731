"""Dashpots at mid-step, whatever else the structure has: dense steps of the same scheme.

Two masses in line, the first on a grounded spring with a dashpot, a second dashpot to a clamped point
and a third between the masses, so that one moves the others. Reference, with C of all dashpots and S
the scaled mass of the springs: (M + S) (v+ - v-) = -h K u - h C (v+ + v-) / 2, h half a step at first.
A structure reduced to all of its modes is the same structure in other coordinates, with dashpots and
with bars that resist stretching only.
"""
import os
import tempfile
import unittest

import numpy
import scipy.io

import program
from decks import clock, contacts, in_modes, material, probes
from loops_test import Loops, check_area
from recorded import Recorded, assert_continues, ensemble_of
from springs_test import SPEED, chain, point, spring
from tension_brace_test import scene as braces

MASS = numpy.diag([50.0, 20.0])
STIFFNESS = {"support": 3e4, "link1": 1e4, "link2": 2e4}
STRONG = {"support": 2e2, "link1": 3e7, "link2": 4e6}  # x = c dt / (2 m) of up to 30 and 20
MILD = {"support": 2e2, "link1": 300.0, "link2": 150.0}
TIME_STEP = 1e-4


def words(dashpots, *more, stiffness=None):
    result = chain(TIME_STEP, 0.1, *point("first", 50.0), *point("second", 20.0),
                   "-chain_clamp", "ground", "-chain_mesh_set", "links=3")
    for group, k in (stiffness or STIFFNESS).items():
        c = dashpots[group]
        result += spring(group, "grounded_spring" if group == "support" else "spring",
                         f"{k!r},{k!r},{k!r}", f"{c!r},{c / 2!r},{c / 3!r}")
    return result + list(more)


def between(values):
    """Matrix over the two masses of springs or dashpots."""
    ends = {"support": numpy.array([1, 0]), "link1": numpy.array([1, 0]), "link2": numpy.array([-1, 1])}
    return sum(value * numpy.outer(ends[group], ends[group]) for group, value in values.items())


def steps(count, dashpots, mass=MASS, stiffness=None):
    k, c = between(stiffness or STIFFNESS), between(dashpots)
    u, v = numpy.zeros(2), numpy.full(2, SPEED)
    result = numpy.zeros((count, 2))
    for n in range(count):
        result[n] = u
        h = TIME_STEP if n > 0 else TIME_STEP / 2
        v = numpy.linalg.solve(mass + h / 2 * c, (mass - h / 2 * c) @ v - h * k @ u)
        u = u + TIME_STEP * v
    return result


class RowBetweenWalls(unittest.TestCase):
    """SDLD27 of Code_Aster's manual of verification: 8 masses, springs, and dashpots that do not follow K or M."""
    FREQUENCIES = [5.53, 10.9, 15.93, 20.45, 24.34, 27.49, 29.84, 31.29]
    RATIOS = [.01521, .02877, .0396, .04709, .05098, .05183, .05115, .05036]  # -Re / Im

    def test_damped_modes_of_the_exported_matrices(self):
        with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
            path = os.path.join(folder, "row.geo")
            with open(path, "w") as file:
                file.write("For i In {0:9}\n  Point(i + 1) = {i, 0, 0};\nEndFor\n"
                           "For i In {1:9}\n  Line(i) = {i, i + 1};\n  Transfinite Curve {i} = 2;\nEndFor\n"
                           "Physical Point(\"walls\") = {1, 10};\n"
                           "Physical Point(\"masses\") = {2:9};\nPhysical Curve(\"first\") = {1};\n"
                           "Physical Curve(\"middle\") = {2:8};\nPhysical Curve(\"last\") = {9};\n")
            row = ["-structures", "chain", "-chain_mesh", path, "-chain_clamp", "walls", "-end_time", 1e-12,
                   "-modes", 0, "-chain_masses_element", "point_mass", "-chain_masses_mass", 10, "-export_matrices",
                   folder]
            for group, dashpot in (("first", 250), ("middle", 50), ("last", 25)):
                row += spring(group, "spring", "1e5,1e5,1e5", f"{dashpot},0,0")
            program.must_run(self, row)
            # components of x alone, which come first of three at each node
            stiffness, mass, damping = (
                scipy.io.mmread(os.path.join(folder, "chain", f"{name}.mtx")).toarray()[::3, ::3]
                for name in ("stiffness", "mass", "damping"))
        order = len(mass)
        mass = numpy.diag(mass.ravel()) if mass.shape[1] == 1 else mass
        self.assertEqual(order, 8)
        whole = numpy.block([[numpy.zeros((order, order)), numpy.eye(order)],
                             [-numpy.linalg.solve(mass, stiffness), -numpy.linalg.solve(mass, damping)]])
        values = sorted((value for value in numpy.linalg.eigvals(whole) if value.imag > 0), key=lambda v: v.imag)
        for value, frequency, ratio in zip(values, self.FREQUENCIES, self.RATIOS):
            self.assertAlmostEqual(value.imag / (2 * numpy.pi) / frequency, 1, delta=1e-3)
            self.assertAlmostEqual(-value.real / value.imag / ratio, 1, delta=1e-3)


class TwoMasses(unittest.TestCase):
    def check(self, run, expected, tolerance=1e-10):
        for i, name in enumerate(("one", "two")):
            u = run.displacement(f"{name}.x")
            self.assertLess(abs(u - expected[:len(u), i]).max(), tolerance * abs(expected).max())
        self.assertGreater(run.energy["devices"], 0)
        self.assertLess(run.energy["relative_residual"], 1e-12)

    def test_dashpots_that_move_each_other(self):
        for dashpots in (MILD, STRONG):
            self.check(Recorded(self, words(dashpots)), steps(1010, dashpots))

    def test_limit_is_that_without_them(self):
        found = [program.must_run(self, words(dashpots, "-end_time", TIME_STEP))[1]["structures"]
                 ["chain"]["stable_time_step"] for dashpots in (MILD, STRONG)]
        squares = numpy.linalg.eigvalsh(between(STIFFNESS) / numpy.sqrt(numpy.outer([50, 20], [50, 20])))
        for limit in found:
            self.assertAlmostEqual(limit / (2 / numpy.sqrt(squares[-1])), 1, delta=1e-9)

    def test_beside_scaled_mass(self):
        """Springs so stiff that the step would be too long: S = dt^2 / 4 K, and what it couples."""
        stiffness = {"support": 3e4, "link1": 4e12, "link2": 4e12}
        mass = MASS + TIME_STEP**2 / 4 * between(stiffness)
        run = Recorded(self, words(STRONG, "-chain_mass_scaling", TIME_STEP, stiffness=stiffness))
        self.assertEqual(run.summary["structures"]["chain"]["mass_scaling"]["elements"], 3)
        self.check(run, steps(1010, STRONG, mass, stiffness), 1e-6)

    def test_beside_uniform_damping(self):
        run = Recorded(self, words(STRONG, "-chain_damping_uniform", 0.04, "-chain_damping_band", "1,100"))
        self.assertLess(run.energy["relative_residual"], 1e-12)
        self.assertGreater(run.energy["devices"], 0)

    def test_in_all_modes(self):
        for dashpots in (MILD, STRONG):
            full = Recorded(self, words(dashpots))
            run = Recorded(self, words(dashpots, *in_modes("chain", 6)))
            for name in ("one", "two"):
                u, v = full.displacement(f"{name}.x"), run.displacement(f"{name}.x")
                self.assertLess(abs(u - v).max(), 1e-9 * abs(u).max())
            self.assertLess(run.energy["relative_residual"], 1e-12)

    def test_a_continued_run_is_the_uninterrupted_one(self):
        assert_continues(self, words(STRONG, "-output_interval", 1e-3), 0.05, 300, 2)


class AtAContact(unittest.TestCase):
    """A bar strikes a wall with the very nodes that dashpots hold: contact comes after them."""

    def test_energy_never_grows(self):
        for dashpot in (1e4, 1e6, 1e7):
            folder, summary = program.must_run(self, ["-structures", "bar", "-bar_mesh", "tests/meshes/sprung_bar.geo",
                                                      "-bar_body_element", "hex8", "-bar_body_material", "steel",
                                                      *material("steel", 2e11, 0.3, 7800), "-bar_ends_element",
                                                      "grounded_spring", "-bar_ends_stiffness", "0,0,0",
                                                      "-bar_ends_dashpot", f"{dashpot!r},{dashpot!r},0", "-bar_ignore",
                                                      "inner", "-bar_initial_velocity", "1,0,0",
                                                      *contacts(hit=("bar:x_max", "wall", 1e-6)), "-end_time", 4e-2,
                                                      "-energy_interval", 1, "-modes", 0])
            self.assertLess(summary["energy"]["relative_residual"], 1e-12)
            columns = program.read_csv(f"{folder}/energy.csv")
            total = [float(a) + float(b) for a, b in zip(columns["kinetic"], columns["strain"])]
            self.assertGreater(len(total), 100)
            self.assertTrue(all(b <= a * (1 + 1e-9) for a, b in zip(total, total[1:])), dashpot)
            self.assertGreater(summary["impacts"]["hit"]["episodes"], 0)
            bar = summary["structures"]["bar"]  # a dashpot is not the stiffest element
            self.assertIn("body", bar["stiffest_element"])
            self.assertLess(bar["element_frequency_bound"], 2 * bar["omega_max"])


def damped(braces_dashpot="", axes_dashpot="0,0,0", *more, time_step=2e-3):
    """A mass of 100 kg on a spring to the ground: dashpots in two braces, 4 in x to 3 in y, and dashpots along the axes."""
    words = ["-structures", "frame", "-frame_mesh", "tests/meshes/braces.geo", "-frame_mass_element", "point_mass", "-frame_mass_mass", 100, "-frame_support_element", "grounded_spring",
             "-frame_support_stiffness", "3e4,2e4,1e4", "-frame_support_dashpot", axes_dashpot, "-frame_initial_velocity",
             "0.5,0.2,0", *clock(time_step, 2.0, time_step / 2), "-energy_interval", 1, *probes(hung="frame@0,0,0")]
    bars = ["-frame_clamp", "anchors", "-frame_left_element", "bar", "-frame_left_dashpot", braces_dashpot]
    bars = bars if braces_dashpot else []
    return [*words, "-frame_ignore", "right" if bars else "left,right", *bars, *more]


STEEL = ["-frame_left_area", 1e-4, "-frame_left_material", "steel", *material("steel", 2e9, 0.3, 1e-9)]


class SkewBraces(unittest.TestCase):
    """Dashpots along the lines of bars, c in each of two: 1.28 c along x and 0.72 c along y."""

    def check(self, left, right, tolerance=1e-12, ranks=program.RANKS):
        found, turned = (Recorded(self, words, ranks) for words in (left, right))
        for name in ("hung.x", "hung.y"):
            u, v = turned.displacement(name), found.displacement(name)
            self.assertLess(abs(u - v).max(), tolerance * abs(turned.displacement("hung.x")).max())
        self.assertAlmostEqual(found.energy["devices"] / turned.energy["devices"], 1, delta=1e-9)
        self.assertGreater(turned.energy["devices"], 0.1 * turned.energy["input"])
        return found

    def test_alone_they_are_those_along_the_axes(self):
        for ranks in (1, 2, 3):
            self.check(damped("250"), damped("", "320,180,0"), ranks=ranks)

    def test_decrement_is_that_of_the_closed_form(self):
        run = Recorded(self, damped("250", "0,0,0", "-frame_initial_velocity", "0.5,0,0", time_step=2e-4))
        u = run.displacement("hung.x")[1:]
        peaks = u[1:-1][(u[1:-1] > u[:-2]) & (u[1:-1] > u[2:])]
        ratio = 320 / (2 * numpy.sqrt(100 * 3e4))
        decrement = 2 * numpy.pi * ratio / numpy.sqrt(1 - ratio**2)
        self.assertAlmostEqual(numpy.log(peaks[0] / peaks[4]) / 4 / decrement, 1, delta=1e-4)

    def test_powers_and_springs_in_series(self):
        along_x = ("-frame_initial_velocity", "0.5,0,0")
        series = 2e4 * 2 * .8**2  # of both
        for power in (0.4, 1, 2):
            turned = 250 * 2 * .8**(1 + power)
            for bars, axes in ((), ()), (("-frame_left_dashpot_stiffness", 2e4),
                                         ("-frame_support_dashpot_stiffness", f"{series!r},0,0")):
                self.check(damped("250", "0,0,0", *along_x, "-frame_left_dashpot_exponent", power, *bars),
                           damped("", f"{turned!r},0,0", *along_x, "-frame_support_dashpot_exponent", power, *axes), 1e-10)

    def test_beside_the_bars_own_stiffness_and_laws(self):
        """Of two groups on the same lines, the stiffness of one and the dashpot of the other, and of one that has both."""
        for law in ((), ("-frame_left_yield_force", 300), ("-frame_left_tension_only", "true")):
            both = Recorded(self, damped("250", "0,0,0", *STEEL, *law))
            axes = Recorded(self, damped("0", "320,180,0", *STEEL, *law))
            for name in ("hung.x", "hung.y"):
                u = axes.displacement(name)
                self.assertLess(abs(u - both.displacement(name)).max(), 1e-12 * abs(u).max())

    def test_heavy_dampers_without_stiffness_carry_no_waves(self):
        """Their mass moves with their ends, and what a mesh carries is asked of other elements."""
        self.check(damped("250", "0,0,0", "-frame_left_mass_per_length", 4), damped("", "320,180,0", "-frame_mass_mass", 100 + 4 * 5))

    def test_in_all_modes(self):
        for more in ((), STEEL, (*STEEL, "-frame_left_yield_force", 300), ("-frame_left_dashpot_exponent", 0.5)):
            self.check(damped("250", "0,0,0", *more, *in_modes("frame", 3)), damped("250", "0,0,0", *more), 1e-9)

    def test_members_of_an_ensemble_are_single_runs(self):
        words = damped("250", "0,0,0", *in_modes("frame", 3), "-modes", 0, "-spectra_frequencies", 10)
        peaks, residuals = ensemble_of(self, words, "frame_stiffness_factor", [1.2])
        self.assertLess(abs(residuals).max(), 1e-12)
        run = Recorded(self, [*words, "-frame_stiffness_factor", 1.2])
        self.assertAlmostEqual(peaks.ravel()[0] / abs(run.displacement("hung.x")).max(), 1, delta=1e-9)

    def test_exported(self):
        with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
            program.must_run(self, damped("250", "0,0,0", "-export_matrices", folder, "-end_time", 1e-3))
            damping = scipy.io.mmread(os.path.join(folder, "frame", "damping.mtx")).toarray()
        self.assertLess(abs(damping - numpy.diag([320, 180, 0])).max(), 1e-11)

    def test_loops_hold_what_the_ledger_took(self):
        words = damped("250", "0,0,0", *STEEL, "-frame_left_yield_force", 300, "-loops", "frame:left", time_step=2e-4)
        run = Loops(self, [*words, "-frame_support_stiffness", "0,0,0", "-output_interval", 2e-4,
                           "-end_time", 0.2])
        self.assertEqual([name.split(".", 2)[2] for name in run.names], ["axial", "axial.dashpot"] * 2)
        check_area(self, run)

    def test_refused(self):
        for more, words in (((), "no area"), (("-frame_left_dashpot", "1,2,3"), "one number"),
                            (("-frame_left_dashpot", 5, "-frame_left_yield_force", 5), "of its dashpot alone"),
                            (("-frame_left_dashpot", 5, "-frame_left_material", "steel"), "frame_left_area"),
                            (("-frame_left_dashpot", 5, "-frame_left_dashpot_exponent", 2, "-export_matrices",
                              "/tmp/none"), "power")):
            program.must_refuse(self, damped("0", "0,0,0", *more), words)

    def test_a_continued_run_is_the_uninterrupted_one(self):
        assert_continues(self, damped("250", "0,0,0", *STEEL, "-frame_left_yield_force", 300,
                                      "-frame_left_dashpot_stiffness", 2e5, "-output_interval", 1e-2), 1.0, 300, 2)


BRACED = braces(("left",), 3e4, 2e-3, 2.0)


class Braces(unittest.TestCase):
    """Bars that go slack, in all modes of the structure that has them taut."""

    def test_same_as_the_finite_elements(self):
        full, run = (Recorded(self, words) for words in (BRACED, [*BRACED, *in_modes("frame", 3)]))
        u = full.displacement("hung.x")
        self.assertGreater(-u.min(), 1.1 * u.max())  # it did go slack
        self.assertLess(abs(run.displacement("hung.x") - u).max(), 1e-9 * abs(u).max())
        self.assertLess(run.energy["relative_residual"], 1e-12)
        self.assertAlmostEqual(run.energy["strain"] / full.energy["strain"], 1, delta=1e-6)

    def test_with_uniform_damping_they_are_refused(self):
        program.must_refuse(self, [*BRACED, *in_modes("frame", 3), "-frame_damping_uniform", 0.02], "-frame_left_tension_only")


ON_RANKS = {"dashpots that move each other": words(STRONG),
            "dashpots in all modes": words(STRONG, *in_modes("chain", 6)),
            "dashpots along braces": damped("250", "0,0,0", *STEEL, "-frame_left_yield_force", 300),
            "bars that go slack in modes": [*BRACED, *in_modes("frame", 3)]}


if __name__ == "__main__":
    unittest.main()
