"""What must scale: without a gap of its own the problem is homogeneous, and units are a matter of taste.

Factors that are powers of two change exponents only, so that not one bit of the digits may differ;
other factors leave round-off. Nothing at all gives nothing at all, and a thousand g a finite answer.
"""
import os
import tempfile
import unittest

import numpy

from history import History, scenes
from houses import GAP, Pair, Run, assert_same, shaking

GRAVITY = 9.80665


class Amplitude(unittest.TestCase):
    def scaled(self, factor, ranks=1):
        """The pair with record, gap, tolerance and velocity times a factor, divided by it again."""
        pair = Pair(gap=GAP * factor)
        pair.record, pair.velocity = shaking(factor), pair.velocity * factor
        run = Run(self, pair, ranks, more=["-gap_tolerance", repr(1e-12 * factor)])
        for values in [*run.vectors.values(), run.gap, run.force]:
            values /= factor
        return run

    def test_powers_of_two_change_no_digit(self):
        reference = Run(self, Pair())
        for factor in (2.0**10, 2.0**-20):
            assert_same(self, self.scaled(factor), reference, 0)

    def test_other_factors_leave_round_off(self):
        assert_same(self, self.scaled(1000.0, 2), Run(self, Pair(), 2), 1e-11)

    def test_nothing_gives_exactly_nothing(self):
        pair = Pair(gap=0.0)
        pair.record, pair.velocity = shaking(0.0), numpy.zeros(3)
        run = Run(self, pair, 2)
        for name in ("displacement", "velocity", "acceleration", "gap", "contact_force", "ground_acceleration"):
            self.assertFalse(run.data[name].any(), name)
        for name in ("displacement", "pseudo_velocity", "pseudo_acceleration"):
            self.assertEqual(set(run.spectra[name]), {"0"})
        self.assertEqual(run.summary["impacts"]["episodes"], 0)
        self.assertEqual(set(run.energy.values()), {0.0})


class Violent(unittest.TestCase):
    """Two oscillators of 2.1 and 3.7 Hz, each the lumped end of one clamped brick."""

    MASS, STIFFNESS, ALPHA = (9200.0, 7000.0), (1601718.3590439898, 3783216.759025573), (0.396, 0.697)
    FREQUENCY, GAP, TIME_STEP, END = 2.6, 0.02, 2e-4, 2.0

    def words(self, record):
        words = scenes.blocks([2 * mass for mass in self.MASS], 0.0, self.GAP, 1.0, self.TIME_STEP, self.END)
        for name, wall, stiffness, alpha in zip(("one", "two"), ("x_min", "x_max"), self.STIFFNESS, self.ALPHA):
            words += [f"-{name}_clamp", wall, f"-material_{name}_young", repr(stiffness),
                      f"-{name}_damping_alpha", alpha]
        return [*words, "-motion_x_record", record, "-motion_x_unit", "m/s2", "-motion_x_time_step", self.TIME_STEP]

    def scheme(self, ground):
        """The same step by step: displacements, shape (steps + 1, 2)."""
        mass, stiffness, alpha = (numpy.array(values) for values in (self.MASS, self.STIFFNESS, self.ALPHA))
        u, v, history = numpy.zeros(2), numpy.zeros(2), []
        for n, acceleration in enumerate(ground):
            duration = self.TIME_STEP if n > 0 else self.TIME_STEP / 2
            u = u + self.TIME_STEP * v if n > 0 else u
            v = v - duration * (acceleration + alpha * v + stiffness / mass * u)
            closing = v[0] - v[1]
            if self.GAP + u[1] - u[0] <= 0 and closing > 0:
                v += numpy.array([-1, 1]) * closing / (1 / mass).sum() / mass
            history.append(u)
        return numpy.array(history)

    def test_a_thousand_g(self):
        steps = round(self.END / self.TIME_STEP)
        phase = 2 * numpy.pi * self.FREQUENCY * self.TIME_STEP * numpy.arange(steps + 1)
        ground = 1000 * GRAVITY * numpy.sin(phase)
        with tempfile.TemporaryDirectory() as folder:
            record = os.path.join(folder, "record.txt")
            numpy.savetxt(record, ground, fmt="%.17g")
            run = History(self, self.words(record), 2)
        exact = self.scheme(ground)
        found = numpy.array([run.channel("displacement", f"probe{i}.x") for i in (0, 1)]).T
        self.assertEqual(found.shape, exact.shape)
        self.assertLess(abs(found - exact).max(), 1e-9 * abs(exact).max())
        self.assertGreater(abs(exact).max(), 10)  # [m]; far beyond the hypotheses, but finite
        self.assertGreater(run.summary["impacts"]["episodes"], 2)
        self.assertLess(run.energy["relative_residual"], 1e-12)


class Units(unittest.TestCase):
    def test_units_in_powers_of_two(self):
        reference = Run(self, Pair())
        for length, mass in ((1024.0, 1 / 1024), (1 / 64, 4096.0)):
            assert_same(self, Run(self, Pair(length=length, mass=mass)), reference, 0)

    def test_newton_millimetre_tonne_second(self):
        # The inputs are rounded anew: a few 1e-16 in omega, times the radians of the fastest motion.
        assert_same(self, Run(self, Pair(length=1e3, mass=1e-3)), Run(self, Pair()), 1e-10)


if __name__ == "__main__":
    unittest.main()
