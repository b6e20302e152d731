"""No time at all, and a million steps: counts of steps and samples, time, momentum, silence.

Times are n dt, not a sum; recorded accelerations are changes of velocity over the interval, whatever
the interval; a free body keeps its momentum; what decays reaches zero, and does not dwell among the
subnormal numbers, whose arithmetic is slow.
"""
import sys
import unittest

import numpy

from history import History, scenes
from houses import TIME_STEP, Pair, Run

SMALLEST = sys.float_info.min  # normal number


def free_mass(*more):
    return ["-structures", "mass", "-mass_mesh", "tests/meshes/chain.geo", "-mass_first_element", "point_mass",
            "-mass_first_mass", 1, "-mass_initial_velocity", "0.5,0,0", "-probes", "it", "-it_structure", "mass",
            "-it_at", "1,0,0", "-modes", 0, "-spectra_frequencies", 10, *more]


class Short(unittest.TestCase):
    def test_less_than_a_step_is_one_step(self):
        for end_time, steps in ((1e-3 * TIME_STEP, 1), (TIME_STEP, 1), (1.001 * TIME_STEP, 2)):
            run = Run(self, Pair(), 2, end_time=end_time)
            self.assertEqual(run.summary["steps"], steps)
            self.assertTrue(numpy.array_equal(run.time, numpy.arange(steps + 1) * TIME_STEP))
            for name in ("displacement", "velocity", "acceleration", "gap", "contact_force"):
                self.assertEqual(len(run.data[name]), steps + 1)
                self.assertTrue(numpy.isfinite(run.data[name]).all())
            self.assertEqual(len(run.ledger["time"]), steps)
            self.assertEqual(len(run.impacts["start"]), 0)
            self.assertEqual(len(run.spectra["frequency"]), 2 * 3)


class Long(unittest.TestCase):
    STEPS = 1000000

    def test_a_million_steps(self):
        dt, omega = 1.6e-6, 2 * numpy.pi * 3
        words = ["-structures", "mass", *scenes.oscillator("mass", omega**2, 1.0, 0.5), "-time_step", repr(dt),
                 "-end_time", repr(self.STEPS * dt), "-output_interval", 5e-5, "-probes", "it", "-it_structure", "mass",
                 "-it_at", "1,0,0", "-modes", 0, "-spectra_frequencies", 10]
        run = History(self, words)
        self.assertEqual(run.summary["steps"], self.STEPS)
        stride = round(run.summary["output_interval"] / dt)
        self.assertEqual(stride, 31)
        self.assertTrue(numpy.array_equal(run.time, numpy.arange(len(run.time)) * stride * dt))
        self.assertEqual(len(run.time), self.STEPS // stride + 1)
        self.assertLessEqual(len(run.ledger["time"]), 5001)
        self.assertLess(run.energy["relative_residual"], 1e-11)
        theta = 2 * numpy.arcsin(omega * dt / 2)
        exact = 0.5 * dt * numpy.sin(numpy.arange(len(run.time)) * stride * theta) / numpy.sin(theta)
        self.assertLess(abs(run.channel("displacement", "it.x") - exact).max(), 1e-9 * abs(exact).max())

    def test_no_impulse_is_lost_between_samples(self):
        fine = Run(self, Pair(), 2)
        self.assertGreater(fine.summary["impacts"]["episodes"], 0)
        for stride in (2, 37, 1000):
            coarse = Run(self, Pair(), 2, more=["-output_interval", repr(TIME_STEP * stride * (1 + 1e-9))])
            samples = len(coarse.time)
            self.assertEqual(samples, fine.summary["steps"] // stride + 1)
            for name in ("acceleration", "contact_force", "ground_acceleration"):
                blocks = fine.data[name][1:1 + (samples - 1) * stride]
                means = blocks.reshape(samples - 1, stride, -1).mean(axis=1)
                self.assertLess(abs(coarse.data[name][1:] - means).max(), 1e-10 * abs(blocks).max(), (name, stride))
            for name in ("displacement", "velocity", "gap"):
                self.assertTrue(numpy.array_equal(coarse.data[name], fine.data[name][::stride]), name)


class FreeBody(unittest.TestCase):
    COLLISION = ["-structures", "one,two", "-contacts", "joint", "-joint_secondary", "one:x_max", "-joint_primary",
                 "two:x_min", "-joint_gap", 1e-3, "-one_mesh_set", "lx=1.5,nx=3,ny=2,nz=2", "-two_mesh_set",
                 "x0=1.5,nx=2,ny=2,nz=2", *scenes.material("concrete", *scenes.CONCRETE)]

    def words(self, names):
        words = []
        for name in names:
            words += [f"-{name}_mesh", "tests/meshes/box.geo", f"-{name}_body_element", "hex8",
                      f"-{name}_body_material", "concrete"]
        return words

    def test_flies_straight(self):
        velocity = numpy.array([1.0, -2.0, 3.0])
        run = History(self, ["-structures", "one", *self.words(["one"]), "-one_mesh_set", "nx=2,ny=2,nz=2",
                             *scenes.material("concrete", *scenes.CONCRETE), "-one_initial_velocity", "1,-2,3",
                             "-end_time", 12, "-output_interval", 1e-2, "-probes", "all", "-all_structure", "one",
                             "-all_group", "body", "-all_average", "false", "-modes", 0, "-spectra_frequencies", 10], 2)
        self.assertGreater(run.summary["steps"], 1e5)
        found = run.data["velocity"].reshape(len(run.time), -1, 3)
        self.assertLess(abs(found - velocity).max(), 1e-13)
        path = run.data["displacement"].reshape(len(run.time), -1, 3)
        self.assertLess(abs(path - run.time[:, None, None] * velocity).max(), 1e-11 * abs(path).max())

    def momentum(self, run):
        """Of the two together, shape (samples, 3), from the lumped masses of their nodes."""
        total, first = 0, 0
        velocity = run.data["velocity"].reshape(len(run.time), -1, 3)
        for name in ("one", "two"):
            nodes = numpy.array([probe["position"] for probe in run.summary["probes"].values()
                                 if probe["structure"] == name])
            share = numpy.ones(len(nodes))
            for axis in range(3):
                x = nodes[:, axis]
                share[(x < x.min() + 1e-9) | (x > x.max() - 1e-9)] /= 2
            mass = run.summary["structures"][name]["mass"] * share / share.sum()
            total = total + numpy.einsum("tni,n->ti", velocity[:, first:first + len(nodes)], mass)
            first += len(nodes)
        return total

    def test_two_that_collided_keep_their_momentum(self):
        # On one rank an element gives its nodes forces that cancel; elsewhere they are rounded again,
        # and that of a rigid motion over metres is a force of 1e-16 K u.
        for ranks, tolerance in ((1, 1e-12), (2, 1e-10)):
            run = History(self, [*self.COLLISION, *self.words(["one", "two"]), "-one_initial_velocity", "1,-0.2,0.3",
                                 "-end_time", 6, "-output_interval", 5e-3, "-modes", 0, "-spectra_frequencies", 10,
                                 "-probes", "a,b", "-a_structure", "one", "-a_group", "body", "-b_structure", "two",
                                 "-b_group", "body", "-a_average", "false", "-b_average", "false"], ranks)
            self.assertEqual(run.summary["impacts"]["episodes"], 1)
            self.assertGreater(run.summary["steps"], 5e4)
            start = run.summary["structures"]["one"]["mass"] * numpy.array([1, -0.2, 0.3])
            self.assertLess(abs(self.momentum(run) - start).max(), tolerance * abs(start).max(), ranks)


class Silence(unittest.TestCase):
    def test_decay_ends_at_zero(self):
        # Half of the velocity each step: subnormal after 1022 steps, if such numbers were kept.
        run = History(self, free_mass("-mass_damping_alpha", 500, "-time_step", 1e-3, "-end_time", 2,
                                      "-output_interval", 5e-4))
        velocity = abs(run.channel("velocity", "it.x"))
        self.assertEqual(velocity[900], 0.375 * 2.0**-900)
        self.assertEqual(velocity[-1], 0)
        self.assertFalse(((velocity > 0) & (velocity < SMALLEST)).any(), "subnormal numbers were kept")

    def test_what_the_ground_does_not_reach_stays_at_rest(self):
        pair = Pair(gap=1.0)
        pair.velocity, pair.record = numpy.zeros(3), pair.record * (0, 0, 1)
        pair.record[:20] = 0  # a tenth of a second of silence first
        run = Run(self, pair, 2, end_time=0.12)
        quiet = run.time < 0.095
        for name in ("displacement", "velocity", "acceleration"):
            self.assertFalse(run.data[name][quiet].any(), name)
            self.assertTrue(run.data[name][~quiet].any(), name)


if __name__ == "__main__":
    unittest.main()
