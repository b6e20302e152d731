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

import program
from decks import box_of, clock, contacts, in_modes, material
from recorded import Recorded, write_samples

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

    def rock(self, time_step, ranks=program.RANKS):
        return Recorded(self, ["-structures", "block",
                               *box_of("block",
                                       f"x0={-HALF_WIDTH},lx={2 * HALF_WIDTH},ly=1,lz={HEIGHT!r},nz={LAYERS}", "stone"),
                               "-block_clamp", "z_min:x+y", *material("stone", 30e9, 0.2, 2500), *in_modes("block", 3),
                               "-block_modal_attachment", "false", "-gravity", GRAVITY, "-preload", "static",
                               "-block_initial_velocity", f"{self.SPEED!r},0,0",
                               *contacts(ground=("block:z_min", "wall", 0)), *clock(time_step, 2), "-energy_interval",
                               10, "-probes", "edge,other", "-edge_structure", "block", "-edge_at",
                               f"{-HALF_WIDTH},0,0", "-other_structure", "block", "-other_at",
                               f"{HALF_WIDTH},0,0"], ranks, identity=1e-11)

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


class ShakenTower(unittest.TestCase):
    """A tower of 8 x 30 m on hard ground, moved by one cycle of a sine of 0.8 Hz: it stands still until g b / h, .27 g,
    then rocks, beside an integration of the rigid body about the edge it stands on, which loses Housner's part at each
    impact. Its masses stand above its edges, h is the height of their centre."""
    HALF_WIDTH, HEIGHT, LAYERS, FREQUENCY = 4.0, 30.0, 15, 0.8
    ARM = HEIGHT / 2
    LIMIT = GRAVITY * HALF_WIDTH / ARM
    MEAN_SQUARE = HEIGHT**2 * (((numpy.arange(LAYERS) / LAYERS)**2).sum() + 0.5) / LAYERS
    ABOUT_EDGE = MEAN_SQUARE + 2 * HALF_WIDTH**2  # per mass: of the middle of the base, and of its edge
    KEPT = MEAN_SQUARE / ABOUT_EDGE

    def ground(self, part, t):
        inside = (t >= 0) & (t <= 1 / self.FREQUENCY)
        return numpy.where(inside, part * self.LIMIT * numpy.sin(2 * math.pi * self.FREQUENCY * t), 0.0)

    def expected(self, part, end, step=1e-4):
        """Angle of the tower [rad] at multiples of the step, above 0 where it stands on its edge at x > 0: central
        differences; the ground pulls its masses by -a, so that -a h turns it."""
        time = step * numpy.arange(round(end / step) + 1)
        pushes = self.ground(part, time) * self.ARM / self.ABOUT_EDGE
        back = GRAVITY * self.HALF_WIDTH / self.ABOUT_EDGE
        angle, rate, history = 0.0, 0.0, []
        for push in pushes:
            history.append(angle)
            side = math.copysign(1, angle) if angle != 0 else math.copysign(1, -push)
            if angle == 0 and rate == 0 and abs(push) <= back:
                continue
            rate += step * (-push - side * back)
            after = angle + step * rate
            if angle * after < 0:
                rate *= self.KEPT
                if abs(rate) < step * back:
                    rate = after = 0.0
            angle = after
        return time, numpy.array(history)

    def shake(self, part, ranks, end=8.0, identity=1e-11):
        record = write_samples(self.ground(part, 1e-3 * numpy.arange(1501)), 1e-3)
        mesh = f"x0={-self.HALF_WIDTH},lx={2 * self.HALF_WIDTH},ly={2 * self.HALF_WIDTH},lz={self.HEIGHT},nz={self.LAYERS}"
        run = Recorded(self, ["-structures", "tower", *box_of("tower", mesh, "stone"), "-tower_clamp", "z_min:x+y",
                              *material("stone", 30e9, 0.2, 2500), *in_modes("tower", 3), "-tower_modal_attachment",
                              "false", "-tower_modal_residual", "false",  # a rigid body
                              "-gravity", GRAVITY, "-preload", "static", "-motion_x_record", record,
                              "-motion_x_unit", "m/s2", *contacts(ground=("tower:z_min", "wall", 0)),
                              *clock(1e-4, end, 1e-3), "-energy_interval", 100, "-probes", "left,right",
                              "-left_structure", "tower", "-left_at", f"{-self.HALF_WIDTH},0,0", "-right_structure",
                              "tower", "-right_at", f"{self.HALF_WIDTH},0,0"],
            ranks, identity)
        lifts = run.displacement("left.z"), run.displacement("right.z")
        return run, (lifts[0] - lifts[1]) / (2 * self.HALF_WIDTH), numpy.maximum(*lifts)

    def test_stands_still_below_its_limit(self):
        _, angle, _ = self.shake(0.98, 1, 2.0, identity=1)  # what stands still has no energy to compare
        self.assertLess(abs(angle).max(), 1e-9)
        _, angle, _ = self.shake(1.02, 1, 2.0)
        self.assertGreater(abs(angle).max(), 1e-6)

    def test_rocks_as_a_rigid_body(self):
        for ranks in (1, 2):
            run, angle, lift = self.shake(1.5, ranks)
            time, expected = self.expected(1.5, 8.0)
            expected = numpy.interp(run.time, time, expected)
            self.assertAlmostEqual(abs(angle).max() / abs(expected).max(), 1, delta=2e-3, msg="largest angle")
            self.assertLess(abs(angle - expected).max() / abs(expected).max(), 2e-2, "angle")
            weight = 2500 * GRAVITY * (2 * self.HALF_WIDTH)**2 * self.HEIGHT
            self.assertAlmostEqual(run.force("ground")[1] / weight, 1, delta=1e-9)
            self.assertAlmostEqual(lift.max() / (2 * self.HALF_WIDTH * abs(expected).max()), 1, delta=2e-3)
            self.assertGreater(lift.max(), 0.2)  # m
            self.assertLess(run.energy["contact"], -0.8 * run.energy["input"])  # impacts brake it


if __name__ == "__main__":
    unittest.main()
