"""Dofs without mass that springs hold: they follow as at rest, in closed form and beside a published history."""
import math
import os
import tempfile
import unittest

import numpy
import scipy.linalg

import program
from program import write_samples
from recorded import Recorded, assert_continues
from springs_test import SPEED, chain, point, spring

MASS, INNER, OUTER = 50.0, 3e4, 2e4
SOFT = INNER * OUTER / (INNER + OUTER)


def scene(time_step, end_time, *more, scaling=1e-3):
    """The ground, a spring, a node without mass, a spring, a mass; the node turns on springs as well."""
    return chain(time_step, end_time, "-chain_clamp", "ground", "-chain_mesh_set", "links=3", *point("second", MASS),
                 *spring("link1", "spring", f"{INNER!r},{INNER!r},{INNER!r}"),
                 *spring("link2", "spring", f"{OUTER!r},{OUTER!r},{OUTER!r}"),
                 *spring("support", "grounded_spring", "0,0,0,5e3,5e3,5e3"), "-chain_mass_scaling", scaling,
                 "-output_interval", 1e-3, *more)


class BetweenSprings(unittest.TestCase):
    OMEGA = math.sqrt(SOFT / MASS)

    def check(self, run, tolerance):
        exact = SPEED / self.OMEGA * numpy.sin(self.OMEGA * run.time)
        self.assertLess(abs(run.displacement("two.x") - exact).max(), tolerance * abs(exact).max())
        part = OUTER / (INNER + OUTER)
        self.assertLess(abs(run.displacement("one.x") - part * exact)[1:].max(), 2 * tolerance * abs(exact).max())

    def test_history(self):
        run = Recorded(self, scene(1e-4, 1, scaling=1e-4))
        self.check(run, 1e-4)
        self.assertEqual(run.summary["structures"]["chain"]["condensed_dofs"], 6)

    def test_second_order(self):
        errors = []
        for step in (2e-3, 1e-3):
            run = Recorded(self, scene(step, 1, "-output_interval", 2e-3, scaling=step))
            exact = SPEED / self.OMEGA * numpy.sin(self.OMEGA * run.time)
            errors.append(abs(run.displacement("two.x") - exact).max())
        self.assertAlmostEqual(errors[0] / errors[1], 4, delta=.4)

    def test_the_step_is_the_one_that_was_asked_for(self):
        run = Recorded(self, scene(0, .01, scaling=2e-3))
        reached = run.summary["structures"]["chain"]["stable_time_step"] / 2e-3
        self.assertGreater(reached, 1)
        self.assertLess(reached, 1.1)

    def test_in_modes(self):
        run = Recorded(self, scene(1e-4, 1, "-chain_model", "modal", "-chain_modal_vectors", 3, "-chain_mass_scaling", 0))
        self.check(run, 1e-4)
        found = run.summary["structures"]["chain"]["frequencies"][0]["frequency"]
        self.assertAlmostEqual(found * 2 * math.pi / self.OMEGA, 1, delta=1e-6)

    def test_a_continued_run_is_the_uninterrupted_one(self):
        assert_continues(self, scene(1e-4, .2, scaling=1e-4), .1, 300, 2)

    def test_by_name_without_scaled_mass(self):
        program.must_refuse(self, scene(1e-4, .2, scaling=0), "(1, 0, 0)", "no mass along x", "link1, link2",
                            "-chain_mass_scaling")
        program.must_refuse(self, scene(1e-4, .2, "-chain_first_element", "point_mass", "-chain_first_mass", 5, scaling=0),
                            "against turning about x", "support hold", "-chain_first_rotary_inertia", "-chain_mass_scaling")


class Stick(unittest.TestCase):
    """Three beams without mass that carry three masses without rotary inertia: rotations condensed by dense algebra."""
    HEIGHT, YOUNG, INERTIA, MASSES = 3.0, 2e11, 2e-5, [2000.0] * 3

    def reference(self, times):
        h, count = self.HEIGHT, 3
        stiffness = numpy.zeros((2 * count + 2,) * 2)
        for e in range(count):
            stiffness[2 * e:2 * e + 4, 2 * e:2 * e + 4] += self.YOUNG * self.INERTIA / h**3 * numpy.array(
                [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2],
                 [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]])
        y, r = [2, 4, 6], [3, 5, 7]
        condensed = stiffness[numpy.ix_(y, y)] - stiffness[numpy.ix_(y, r)] @ numpy.linalg.solve(
            stiffness[numpy.ix_(r, r)], stiffness[numpy.ix_(r, y)])
        squares, shapes = scipy.linalg.eigh(condensed, numpy.diag(self.MASSES))
        omega = numpy.sqrt(squares)
        start = shapes.T @ (numpy.array(self.MASSES) * SPEED)
        return omega, (shapes @ (start[:, None] * numpy.sin(numpy.outer(omega, times)) / omega[:, None]))[2]

    def scene(self, path, *more):
        return ["-structures", "s", "-s_mesh", path, "-s_clamp", "base", "-s_stem_element", "beam", "-s_stem_material", "light",
                "-material_light_young", self.YOUNG, "-material_light_poisson", .3, "-material_light_density", 0,
                "-s_stem_section", "rod", "-section_rod_area", .01, "-section_rod_inertia_y", self.INERTIA,
                "-section_rod_inertia_z", self.INERTIA, "-section_rod_torsion", self.INERTIA, "-section_rod_z_axis", "1,0,0",
                "-s_floors_element", "point_mass", "-s_floors_mass", self.MASSES[0], "-s_initial_velocity", f"0,{SPEED},0",
                "-end_time", 2, "-output_interval", 5e-3, "-probes", "top", "-top_structure", "s", "-top_at",
                f"0,0,{3 * self.HEIGHT}", *more]

    def test_history_and_modes(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "stick.geo")
            with open(path, "w") as file:
                file.write("".join(f"Point({i + 1}) = {{0, 0, {self.HEIGHT * i}}};\n" for i in range(4)) +
                           "".join(f"Line({i}) = {{{i}, {i + 1}}}; Transfinite Curve {{{i}}} = 2;\n" for i in range(1, 4)) +
                           'Physical Point("base") = {1}; Physical Point("floors") = {2, 3, 4};\n'
                           'Physical Curve("stem") = {1, 2, 3};\n')
            program.must_refuse(self, self.scene(path), "no mass against turning", "only stem holds",
                                "-s_floors_rotary_inertia", "-s_mass_scaling")
            errors = []
            for step in (1e-3, 5e-4):
                run = Recorded(self, self.scene(path, "-s_mass_scaling", step, "-time_step", step))
                omega, exact = self.reference(run.time)
                errors.append(abs(run.displacement("top.y") - exact).max() / abs(exact).max())
                self.assertEqual(run.summary["structures"]["s"]["condensed_dofs"], 9)
            self.assertLess(errors[1], 1e-2)
            self.assertAlmostEqual(errors[0] / errors[1], 4, delta=.4)
            coarse = Recorded(self, self.scene(path, "-s_mass_scaling", 0.02, "-time_step", 5e-3, "-modes", 4)).summary["structures"]["s"]
            falls = [2 * math.pi * coarse["frequencies"][at]["frequency"] / value - 1 for value, at in zip(omega, (0, 2))]
            self.assertLess(min(falls), -1e-3)
            self.assertAlmostEqual(coarse["mass_scaling"]["largest_change"] / min(falls), 1, delta=0.05)
            run = Recorded(self, self.scene(path, "-s_model", "modal", "-s_modal_vectors", 6, "-modes", 6, "-time_step", 5e-4))
            found = sorted(2 * math.pi * mode["frequency"] for mode in run.summary["structures"]["s"]["frequencies"])
            for value, at in zip(omega, (0, 2, 4)):
                self.assertAlmostEqual(found[at] / value, 1, delta=1e-6)


class ZenerByNodes(unittest.TestCase):
    def test_support_that_jumps(self):
        """SDND107A as in series_test.py, the node within it being one of the mesh."""
        step = 2e-5
        jump = write_samples([0, .1 / step**2, -.1 / step**2, 0], step)
        words = chain(step, 2.01, *point("second", 1), "-chain_mesh_set", "links=2", "-chain_initial_velocity", "0,0,0",
                      *spring("link2", "spring", "120,120,120"), *spring("support", "grounded_spring", "10,10,10", "1.7,0,0"),
                      "-chain_support_dashpot_stiffness", "60,0,0", "-chain_mass_scaling", step, "-motion_x_record", jump,
                      "-motion_x_unit", "m/s2", "-output_interval", 2e-4)
        run = Recorded(self, words, identity=1e-7)
        position = numpy.interp([t + 1.5 * step for t in (.5, 1, 1.5, 2)], run.time, run.displacement("two.x")) + .1
        self.assertLess(abs(position - [.114023, .151027, .096798, .075906]).max(), 2e-6)


ON_RANKS = {"a node without mass between springs": scene(1e-4, .5, scaling=1e-4)}


if __name__ == "__main__":
    unittest.main()
