"""Uniform damping of what acts in one direction only: compression-only springs and tension-only bars.

Masses on springs that a weight presses, and masses that hang on bars, swing without letting go: they
decay as uniform damping promises over its band, like springs that act both ways. Where they let go
nothing acts, the ledger stays closed, and a continued run is the uninterrupted one.
"""
import math
import os
import tempfile
import unittest

import numpy

import program
from decks import clock
from recorded import Recorded, assert_continues
from uniform_damping_test import Filters, decay

FREQUENCIES = (1, 3, 10, 30, 100)  # Hz
RATIO, RIPPLE = 0.04, 0.0788  # of three filters between 1 and 400 Hz
GRAVITY = 9.81
MASS = 100.0

HANGER = """
// A point at the end of an upright bar of 2 m.
Point(1) = {0, 0, 0};
Point(2) = {0, 0, 2};
Line(1) = {1, 2};
Transfinite Curve {1} = 2;
Physical Point("mass") = {1};
Physical Point("top") = {2};
Physical Curve("bar") = {1};
"""


def of_body(name, frequency, *more):
    """Masses, gravity and damping: they swing along z about their rest, by 0.3 of their sag."""
    speed = 0.3 * GRAVITY / (2 * math.pi * frequency)
    return [f"-{name}_mass_element", "point_mass", f"-{name}_mass_mass", MASS, f"-{name}_initial_velocity",
            f"0,0,{speed!r}", f"-{name}_damping_uniform", RATIO, f"-{name}_damping_reference", frequency,
            f"-at_{name}_structure", name, f"-at_{name}_at", "0,0,0", *more]


def spring(name, frequency, *more):
    stiffness = MASS * (2 * math.pi * frequency)**2
    return of_body(name, frequency, f"-{name}_mesh", "tests/meshes/braces.geo", f"-{name}_ignore",
                   "anchors,left,right", f"-{name}_support_element", "grounded_spring", f"-{name}_support_stiffness",
                   f"{stiffness!r},{stiffness!r},{stiffness!r}", *more)


def scene(bodies, words, *more):
    return ["-structures", ",".join(bodies), "-probes", ",".join(f"at_{name}" for name in bodies), *words, "-gravity",
            GRAVITY, "-preload", "static", *more]


def springs(one_way, *more):
    names = {f"f{frequency}": frequency for frequency in FREQUENCIES}
    words = [word for name, frequency in names.items() for word in
             spring(name, frequency, f"-{name}_support_compression_only", one_way)]
    return scene(names, words, *more)


class Held(unittest.TestCase):
    def hangers(self, *more):
        handle, mesh = tempfile.mkstemp(suffix=".geo")
        with os.fdopen(handle, "w") as file:
            file.write(HANGER)
        names = {f"f{frequency}": frequency for frequency in FREQUENCIES}
        words = []
        for name, frequency in names.items():
            young = 2 * MASS * (2 * math.pi * frequency)**2 / 1e-3
            words += of_body(name, frequency, f"-{name}_mesh", mesh, f"-{name}_clamp", "top,mass:x+y",
                             f"-{name}_bar_element", "bar", f"-{name}_bar_tension_only", "true", f"-{name}_bar_area",
                             1e-3, f"-{name}_bar_material", name, f"-material_{name}_young", repr(young),
                             f"-material_{name}_poisson", 0.3, f"-material_{name}_density", 1e-3)
        return scene(names, words, *more)

    def check(self, words, ranks):
        run = Recorded(self, [*words, *clock(4e-5, 5), "-energy_interval", 100], ranks)
        for frequency in FREQUENCIES:
            u = run.displacement(f"at_f{frequency}.z")
            sag = GRAVITY / (2 * math.pi * frequency)**2
            self.assertAlmostEqual(u[0] / -sag, 1, delta=1e-7)
            cycles = int(min(len(u) - 1, 30 / frequency / 4e-5))
            found = decay(run.time[:cycles], u[:cycles] - u[0])
            with self.subTest(frequency=frequency):
                self.assertAlmostEqual(found / RATIO, 1, delta=RIPPLE + 0.005)
                root = Filters(run.summary["structures"][f"f{frequency}"]["damping"]).root(2 * math.pi * frequency)
                self.assertAlmostEqual(found / (-root.real / abs(root)), 1, delta=0.006)
        self.assertLess(run.energy["relative_residual"], 1e-11)
        return run

    def test_springs_that_a_weight_presses_decay_as_promised(self):
        self.check(springs("true"), 1)

    def test_bars_that_a_weight_stretches_decay_as_promised(self):
        self.check(self.hangers(), 2)

    def test_are_springs_of_both_ways_in_second_order(self):
        errors = []
        for step in (4e-4, 2e-4):
            runs = [Recorded(self, springs(way, *clock(step, 0.5)), 1)
                    for way in ("true", "false")]
            u, v = (run.displacement("at_f30.z") for run in runs)
            errors.append(abs(u - v).max() / abs(v - v[0]).max())
        self.assertLess(errors[1], 2e-3)
        self.assertGreater(errors[0] / errors[1], 3)


class Thrown(unittest.TestCase):
    """Thrown up from a compression-only spring, it flies, and bounces lower and lower."""

    def words(self, *more):
        body = spring("body", 3, "-body_support_compression_only", "true", "-body_initial_velocity", "0,0,2")
        return scene(["body"], body, *clock(1e-4, 4), "-energy_interval", 1, *more)

    def heights(self, damping):
        """Highest places of the first two flights, the law integrated apart: what presses on the mass is
        N = max(0, s k (e + (1/s - 1) sag) + sum q) of branches s a k that follow e while it presses, that slip
        where they would pull, and that let go alone once it is off.
        """
        law = Filters(damping)
        stiffness = law.at_rest * MASS * (2 * math.pi * 3)**2
        branch = law.weights * stiffness
        sag = GRAVITY / (2 * math.pi * 3)**2
        released = sag * (1 - 1 / law.at_rest)
        step, pressed, rate, forces, tops = 1e-5, sag, -2.0, numpy.zeros(len(branch)), []
        while len(tops) < 2:
            spring = stiffness * (pressed - released)
            held = spring > 0
            total = spring + forces.sum()
            follows = rate if held else 0.0
            if held and total < 0:
                follows = max(rate, (forces * law.rates).sum() / branch.sum())
            before = rate
            rate += step * (GRAVITY - (max(0.0, total) if held else 0.0) / MASS)
            pressed += step * rate
            forces = (forces + step * branch * follows) / (1 + step * law.rates)
            if before < 0 <= rate:
                tops.append(-pressed)
        return tops

    def test_nothing_acts_in_flight_and_each_bounce_is_lower(self):
        run = Recorded(self, self.words())
        u = run.displacement("at_body.z")
        flying = u > 1e-2
        acceleration = numpy.diff(run.velocity("at_body.z"))[flying[1:] & flying[:-1]] / run.time_step
        self.assertLess(abs(acceleration / -GRAVITY - 1).max(), 1e-6)
        tops = numpy.array([u[i] for i in range(1, len(u) - 1) if u[i - 1] < u[i] >= u[i + 1]])
        self.assertGreater(len(tops), 4)
        self.assertTrue((numpy.diff(tops) < 0).all())
        for top, expected in zip(tops, self.heights(run.summary["structures"]["body"]["damping"])):
            self.assertAlmostEqual(top / expected, 1, delta=1e-3)
        self.assertLess(run.energy["relative_residual"], 1e-12)
        self.assertGreater(run.energy["devices"], 0)
        self.assertEqual(run.summary["contact_ratio"]["body"]["smallest"], 0)

    def test_a_continued_run_is_the_uninterrupted_one(self):
        assert_continues(self, self.words("-end_time", 1), 0.6, 3300, 2)

    def test_stable_up_to_the_step_that_is_told(self):
        _, summary = program.must_run(self, self.words("-end_time", 1e-4), 1)
        step = 0.999 * summary["structures"]["body"]["stable_time_step"]
        run = Recorded(self, self.words(*clock(step, 2000 * step)))
        self.assertLess(abs(run.displacement("at_body.z")).max(), 1)


if __name__ == "__main__":
    unittest.main()
