"""Structures that start away from rest: masses on springs, a bar, a mass beside a wall.

References: closed forms of the scheme, which moves a mode from u_0 at rest to u_0 cos(n theta) at step
n, sin(theta / 2) = omega dt / 2, and keeps the energy u_0^T K u_0 / 2 - dt^2 |M^-1/2 K u_0|^2 / 8.
"""
import math
import unittest

import numpy

from decks import clock, contacts, material, probes
from recorded import Recorded

START = 0.02


def mass(time_step, end_time, *more):
    """A mass at x = 1 that starts at START; the other point of the mesh is a mass that stays."""
    return ["-structures", "chain", "-chain_mesh", "tests/meshes/chain.geo", "-chain_first_element", "point_mass",
            "-chain_first_mass", 50, "-chain_second_element", "point_mass", "-chain_second_mass", 1,
            "-chain_initial_displacement", f"{START},0,0", *clock(repr(time_step), repr(end_time), repr(time_step / 2)),
            "-energy_interval", 1, *probes(one="chain@1,0,0", two="chain@2,0,0"), *more]


COUNT, YOUNG, DENSITY, AREA = 8, 2e11, 7800.0, 0.01
MOVED_BAR = ["-structures", "bar", "-bar_mesh", "tests/meshes/line.geo", "-bar_mesh_set", f"length=4,n={COUNT}", "-bar_clamp",
             "x_min", "-bar_line_element", "bar", "-bar_line_material", "steel", "-bar_line_area", AREA,
             *material("steel", YOUNG, 0.3, DENSITY), "-bar_initial_displacement", f"{START},0,0", *clock(2e-5, 2e-3, 1e-5),
             "-energy_interval", 1, *probes(tip="bar@4,0,0")]
ON_RANKS = {"a bar that starts displaced": MOVED_BAR}


class InitialDisplacement(unittest.TestCase):
    def test_free_body_stays_where_it_starts(self):
        run = Recorded(self, mass(1e-4, 0.01))
        for name in ("one", "two"):
            self.assertTrue((run.displacement(f"{name}.x") == START).all())
            self.assertTrue((run.displacement(f"{name}.y") == 0).all())
            self.assertTrue((run.velocity(f"{name}.x") == 0).all())

    def test_release_of_a_spring(self):
        stiffness, time_step = 2e4, 1e-3
        run = Recorded(self, mass(time_step, 1.0, "-chain_support_element", "grounded_spring",
                                  "-chain_support_stiffness", f"{stiffness},{stiffness},0"))
        theta = 2 * math.asin(math.sqrt(stiffness / 50) * time_step / 2)
        expected = START * numpy.cos(theta * numpy.arange(len(run.time)))
        self.assertLess(abs(run.displacement("one.x") - expected).max(), 1e-11 * START)
        self.assertLess(abs(run.displacement("one.y")).max(), 1e-15)
        energy = run.energy["kinetic"] + run.energy["strain"]
        start = stiffness * START**2 / 2 * (1 - stiffness / 50 * time_step**2 / 4)
        self.assertAlmostEqual(energy / start, 1, delta=1e-11)
        self.assertLess(run.energy["relative_residual"], 1e-12)

    def test_release_of_a_damped_spring(self):
        """(1 + x) z^2 - (2 - omega^2 dt^2) z + (1 - x) = 0, x = c dt/(2 m); half of x in the first step."""
        stiffness, dashpot, time_step = 2e4, 300.0, 1e-3
        run = Recorded(self, mass(time_step, 1.0, "-chain_support_element", "grounded_spring",
                                  "-chain_support_stiffness", f"{stiffness},0,0",
                                  "-chain_support_dashpot", f"{dashpot},0,0"))
        square, x = stiffness / 50 * time_step**2, dashpot / 50 * time_step / 2
        u = [START, START * (1 - square / 2 / (1 + x / 2))]
        while len(u) < len(run.time):
            u.append(((2 - square) * u[-1] - (1 - x) * u[-2]) / (1 + x))
        self.assertLess(abs(run.displacement("one.x") - u).max(), 1e-11 * START)
        self.assertLess(run.energy["relative_residual"], 1e-12)
        self.assertGreater(run.energy["devices"], 0.9 * stiffness * START**2 / 2)

    def test_bar_that_was_moved_as_a_whole(self):
        """Uniform displacement of a bar fixed at one end: the end element is stretched by all of it."""
        count, young, density, area = COUNT, YOUNG, DENSITY, AREA
        h = 4 / count
        k = young * area / h * (2 * numpy.eye(count) - numpy.eye(count, k=1) - numpy.eye(count, k=-1))
        k[-1, -1] /= 2
        m = density * area * h * numpy.ones(count)
        m[-1] /= 2
        root = numpy.sqrt(m)
        squares, modes = numpy.linalg.eigh(k / numpy.outer(root, root))
        theta = 2 * numpy.arcsin(numpy.sqrt(squares) * 2e-5 / 2)
        run = Recorded(self, MOVED_BAR)
        amounts = modes.T @ (root * START)
        steps = numpy.arange(len(run.time))
        expected = numpy.cos(numpy.outer(steps, theta)) * amounts @ modes[-1] / root[-1]
        self.assertLess(abs(run.displacement("tip.x") - expected).max(), 1e-9 * START)
        energy = run.energy["kinetic"] + run.energy["strain"]
        force = k @ (START * numpy.ones(count))
        start = START * force.sum() / 2 - 2e-5**2 * (force**2 / m).sum() / 8
        self.assertAlmostEqual(energy / start, 1, delta=1e-10)
        self.assertLess(run.energy["relative_residual"], 1e-12)

    def test_gap_starts_with_it(self):
        """A block moved towards a wall by most of the gap hits it when the rest is run through."""
        gap, speed, time_step = 0.03, 0.7, 1e-4
        words = ["-structures", "block", "-block_mesh", "tests/meshes/box.geo", "-block_body_element", "hex8",
                 "-block_body_material", "rock", *material("rock", 1e9, 0.2, 2400),
                 "-block_initial_displacement", f"{START},0,0", "-block_initial_velocity", f"{speed},0,0",
                 *contacts(hit=("block:x_max", "wall", gap)), "-end_time", 0.03, "-time_step", repr(time_step)]
        run = Recorded(self, words)
        self.assertEqual(len(run.impacts["start"]), 1)
        self.assertAlmostEqual(run.column("start")[0], (gap - START) / speed, delta=time_step)


if __name__ == "__main__":
    unittest.main()
