"""A rigid block rocks on hard ground: Housner's ratio comes out of the impacts by itself.

The block, 2 b wide, is its rigid modes alone; its base may lift off and not slide. It turns about one edge,
falls back, and goes on about the other one with the part

    (I - m b^2) / (I + m b^2) = 1 - 3/2 sin^2 alpha,      sin^2 alpha = b^2 / (b^2 + h^2)

of its speed, I about the middle of the base (G. W. Housner, Bulletin of the Seismological Society of America 53
(1963) 403). At small displacements the moment m g b brings it back from theta0 in sqrt(2 theta0 (I / m + b^2) / (g b)).
Its masses stand above its two edges, in 16 layers whose height is such that I is that of a solid block of h = 2 m:
nodes of the base between the edges would take turns as pivots.
"""
import math
import unittest

import numpy

from recorded import Recorded

GRAVITY, HALF_WIDTH, LAYERS = 9.81, 0.5, 16
ABOUT_BASE = (HALF_WIDTH**2 + 4 * 2.0**2) / 3  # I / m of the solid block
ABOUT_EDGE = ABOUT_BASE + HALF_WIDTH**2
RATIO = 1 - 1.5 * HALF_WIDTH**2 / (HALF_WIDTH**2 + 2.0**2)
MEAN_SQUARE = sum((k / LAYERS)**2 for k in range(LAYERS)) / LAYERS + 0.5 / LAYERS  # of the layers of height 1
HEIGHT = math.sqrt((ABOUT_BASE - HALF_WIDTH**2) / MEAN_SQUARE)


class Rocking(unittest.TestCase):
    TOP = 0.02  # rad
    RATE = math.sqrt(2 * GRAVITY * HALF_WIDTH * TOP / ABOUT_EDGE)  # at the start
    # A block that moves as a whole keeps its momentum about the edge that stays down.
    SPEED = RATE * ABOUT_EDGE / (HEIGHT / 2)

    def rock(self, time_step, ranks=2):
        return Recorded(self, [
            "-structures", "block", "-block_mesh", "tests/meshes/box.geo", "-block_mesh_set",
            f"x0={-HALF_WIDTH},lx={2 * HALF_WIDTH},ly=1,lz={HEIGHT!r},nz={LAYERS}", "-block_clamp", "z_min:x+y",
            "-block_body_element", "hex8", "-block_body_material", "stone", "-material_stone_young", 30e9,
            "-material_stone_poisson", 0.2, "-material_stone_density", 2500, "-block_model", "modal",
            "-block_modal_vectors", 3, "-block_modal_attachment", "false", "-gravity", GRAVITY, "-preload", "static",
            "-block_initial_velocity", f"{self.SPEED!r},0,0", "-contacts", "ground", "-ground_secondary", "block:z_min",
            "-ground_primary", "wall", "-ground_gap", 0, "-time_step", time_step, "-end_time", 2, "-output_interval",
            time_step, "-energy_interval", 10, "-probes", "edge,other", "-edge_structure", "block", "-edge_at",
            f"{-HALF_WIDTH},0,0", "-other_structure", "block", "-other_at", f"{HALF_WIDTH},0,0"], ranks, identity=1e-11)

    def turns(self, run):
        """Rates at which the block sets out about each edge in turn, the times at which it does, and its angle
        [rad/s, s, rad]."""
        angle = (run.displacement("edge.z") - run.displacement("other.z")) / (2 * HALF_WIDTH)
        rate = (run.velocity("edge.z") - run.velocity("other.z")) / (2 * HALF_WIDTH)
        at = numpy.nonzero(numpy.sign(angle[1:-2]) * numpy.sign(angle[2:-1]) < 0)[0] + 2
        return abs(rate[at + 1]), run.time[at], angle

    def test_housners_ratio(self):
        self.assertAlmostEqual((ABOUT_BASE - HALF_WIDTH**2) / ABOUT_EDGE, 0.911765, delta=5e-7)
        errors = []
        for time_step in (4e-5, 1e-5):
            rates, times, _ = self.turns(self.rock(time_step))
            self.assertGreaterEqual(len(rates), 5)
            errors.append(abs(rates[1:] / rates[:-1] / RATIO - 1).max())
            for k in range(len(times) - 1):
                expected = 2 * rates[k] * ABOUT_EDGE / (GRAVITY * HALF_WIDTH)
                self.assertAlmostEqual((times[k + 1] - times[k]) / expected, 1, delta=40 * time_step)
        self.assertLess(errors[1], 5e-4)
        self.assertLess(errors[1], errors[0] / 2)

    def test_quarter_period(self):
        expected = math.sqrt(2 * self.TOP * ABOUT_EDGE / (GRAVITY * HALF_WIDTH))
        self.assertAlmostEqual(expected, 0.214968, delta=5e-7)
        for ranks in (1, 2):
            run = self.rock(1e-5, ranks)
            _, times, angle = self.turns(run)
            first = abs(angle[run.time < times[0]])
            self.assertAlmostEqual(first.max() / self.TOP, 1, delta=1e-4)
            self.assertAlmostEqual(times[0] / 2 / expected, 1, delta=1e-4)
            self.assertLess(run.energy["contact"], 0)


if __name__ == "__main__":
    unittest.main()
