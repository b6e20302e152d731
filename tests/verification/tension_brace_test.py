"""Free vibration of a mass held by bars that resist stretching only.

Two bars on each side, inclined 3 in 4: whichever way the mass moves, one pair is taut, so it
vibrates as if one pair always held it, with k = 2 (E A / L) (4/5)^2. One pair beside a grounded
spring k1: half periods pi sqrt(m / (k1 + k)) and pi sqrt(m / k1), amplitudes v0 / omega on either
side. References: closed forms.
"""
import math
import unittest

import numpy

import program
from decks import clock, in_modes, material, probes
from recorded import Recorded, assert_continues

MASS, YOUNG, AREA, SPRING, SPEED = 100.0, 2e9, 1e-4, 30000.0, 0.5
BRACES = 2 * (YOUNG * AREA / 5) * 0.8**2
DENSITY = 1e-9  # of the bars: without weight beside the mass


def scene(sides, spring, time_step, end_time):
    words = ["-structures", "frame", "-frame_mesh", "tests/meshes/braces.geo", "-frame_clamp", "anchors",
             "-frame_initial_velocity", f"{SPEED},0,0", *material("steel", YOUNG, 0.3, DENSITY),
             *clock(repr(time_step), repr(end_time), repr(time_step / 2)), "-energy_interval", 1,
             *probes(hung="frame@0,0,0"), "-frame_mass_element", "point_mass", "-frame_mass_mass", MASS]
    for side in sides:
        words += [f"-frame_{side}_element", "bar", f"-frame_{side}_material", "steel",
                  f"-frame_{side}_area", AREA, f"-frame_{side}_tension_only", "true"]
    words += ["-frame_ignore", ",".join({"left", "right"} - set(sides)) or "none"]
    if spring:
        words += ["-frame_support_element", "grounded_spring", "-frame_support_stiffness",
                  f"{spring},{spring},{spring}"]
    return words


def crossings(run):
    """Times at which the mass passes its place, by linear interpolation."""
    u, t = run.displacement("hung.x"), run.time
    at = numpy.nonzero(u[1:-1] * u[2:] < 0)[0] + 1
    return t[at] + (t[at + 1] - t[at]) * u[at] / (u[at] - u[at + 1])


class BracesOnBothSides(unittest.TestCase):
    OMEGA = math.sqrt(BRACES / MASS)
    PERIOD = 2 * math.pi / OMEGA

    def test_vibrates_as_if_one_pair_always_held(self):
        time_step = self.PERIOD / 1000
        for ranks in (1, 2, 3):
            run = Recorded(self, scene(("left", "right"), 0, time_step, 3.1 * self.PERIOD), ranks)
            exact = SPEED / self.OMEGA * numpy.sin(self.OMEGA * run.time)
            u = run.displacement("hung.x")
            self.assertLess(abs(u - exact).max(), 1e-4 * abs(exact).max())
            self.assertAlmostEqual(u.max(), SPEED / self.OMEGA, delta=1e-5 * SPEED / self.OMEGA)
            self.assertAlmostEqual(u.min(), -SPEED / self.OMEGA, delta=1e-5 * SPEED / self.OMEGA)
            halves = numpy.diff(crossings(run))
            self.assertEqual(len(halves), 5)
            self.assertLess(abs(halves / (self.PERIOD / 2) - 1).max(), 1e-5)
            self.assertLess(abs(run.displacement("hung.y")).max(), 1e-12 * SPEED / self.OMEGA)

    def test_answers_are_the_same_on_every_number_of_ranks(self):
        one, *others = (Recorded(self, scene(("left", "right"), 0, self.PERIOD / 50, 3 * self.PERIOD), ranks)
                        for ranks in (1, 2, 3))
        for other in others:
            self.assertTrue(numpy.array_equal(one.displacement("hung.x"), other.displacement("hung.x")))

    def test_bars_hold_the_energy_at_the_turn(self):
        time_step = self.PERIOD / 1000
        run = Recorded(self, scene(("left", "right"), 0, time_step, self.PERIOD / 4))
        held = MASS * SPEED**2 / 2
        self.assertAlmostEqual(run.energy["strain"] / held, 1, delta=1e-4)
        self.assertLess(run.energy["kinetic"], 1e-4 * held)
        self.assertLess(abs(run.energy["devices"]), 1e-12 * held)


class BracesOnOneSideBesideASpring(unittest.TestCase):
    def test_bilinear_half_periods_and_amplitudes(self):
        stiff = math.sqrt((SPRING + BRACES) / MASS)
        soft = math.sqrt(SPRING / MASS)
        period = math.pi / stiff + math.pi / soft
        for side, sign in (("left", 1), ("right", -1)):  # the bars on the left are taut when u > 0
            run = Recorded(self, scene((side,), SPRING, period / 4000, 2.8 * period))
            u = sign * run.displacement("hung.x")
            self.assertAlmostEqual(u.max() * stiff / SPEED, 1, delta=1e-3)
            self.assertAlmostEqual(u.min() * soft / SPEED, -1, delta=1e-3)
            times = crossings(run)
            first = math.pi / (stiff if sign > 0 else soft)
            exact = [first, period, period + first, 2 * period, 2 * period + first]
            self.assertEqual(len(times[:5]), 5)
            self.assertLess(abs(times[:5] / exact - 1).max(), 1e-3)
            energy = sum(run.energy[name] for name in ("kinetic", "strain", "devices"))
            self.assertAlmostEqual(energy / (MASS * SPEED**2 / 2), 1, delta=1e-12)


class PressedOnly(unittest.TestCase):
    """Bars that resist shortening only, once a gap is closed: those on the right do what hooks on the left do."""

    def words(self, side, gap, *more):
        only = {"left": "tension_only", "right": "compression_only"}[side]
        words = scene((side,), SPRING, 1e-3, 1.0)
        at = words.index(f"-frame_{side}_tension_only")
        return [*words[:at], f"-frame_{side}_{only}", *words[at + 1:], f"-frame_{side}_slack", gap, *more]

    def same(self, one, other, tolerance=1e-12):
        for name in ("hung.x", "hung.y"):
            scale = abs(one.displacement("hung.x")).max()
            self.assertLess(abs(one.displacement(name) - other.displacement(name)).max(), tolerance * scale)

    def test_gap_and_hook(self):
        for gap in (0, 5e-3):
            hook = Recorded(self, self.words("left", gap))
            self.assertLess(hook.displacement("hung.x").max(), -0.95 * hook.displacement("hung.x").min())
            for ranks in (1, 2, 3):
                self.same(hook, Recorded(self, self.words("right", gap), ranks))
            self.same(hook, Recorded(self, self.words("right", gap, *in_modes("frame", 3)), 2), 1e-9)
            damped = [self.words(side, gap, f"-frame_{side}_dashpot", 300) for side in ("left", "right")]
            self.same(*(Recorded(self, words) for words in damped))

    def test_at_rest(self):
        """A load that closes the gap, and one that opens it, from which the run starts."""
        gap, bar = 5e-3, YOUNG * AREA / 5
        for force, place in ((600, (600 + 1.6 * bar * gap) / (SPRING + 1.28 * bar)), (-600, -600 / SPRING), (150, 150 / SPRING)):
            for modal in ((), in_modes("frame", 3)):
                run = Recorded(self, self.words("right", gap, "-loads", "push", "-push_on", "frame:mass", "-push_force",
                                                f"{force},0,0", "-preload", "static", "-frame_initial_velocity", "0,0,0", *modal))
                self.assertLess(abs(run.displacement("hung.x") / place - 1).max(), 1e-9)

    def test_continues_and_is_refused(self):
        assert_continues(self, self.words("right", 5e-3, "-output_interval", 1e-2), 0.5, 200, 2)
        for more, words in ((("-frame_right_tension_only", "true"), "not beside tension_only"),
                            (("-frame_right_yield_force", 50), "compression_only"),
                            (("-frame_right_compression_only", "false"), "tension_only or compression_only")):
            program.must_refuse(self, self.words("right", 5e-3, *more), words)


if __name__ == "__main__":
    unittest.main()
