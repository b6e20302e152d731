"""Ratios of masses to 1e12 in a contact, masses that cannot move, ratios of stiffnesses to 1e10.

Node against node, faces as free masses: v+ = m1 v / (m1 + m2) on both sides, impulse m1 m2 v / (m1 + m2).
A wall, or a clamped node, is a mass without end: impulse m1 v; a pair of two clamped nodes is none.
Two masses on springs of 1 and 1e10 N/m: sqrt(1 / 2) and 1.4e5 rad/s.
"""
import math
import unittest

import numpy

from history import History, scenes

SOFT = 1e-30  # Young's modulus of cubes whose nodes are free masses [Pa]


class MassRatio(unittest.TestCase):
    def test_plastic_impact(self):
        for ratio in (1e-12, 1e-8, 1.0, 1e8, 1e12):
            with self.subTest(ratio):
                run = History(self, scenes.blocks((2.0, 2.0 * ratio), young=SOFT), 2)
                one, two = (run.channel("velocity", f"probe{i}.x")[-1] for i in (0, 1))
                common = 1 / (1 + ratio)
                self.assertAlmostEqual(one, common, delta=1e-15)
                self.assertAlmostEqual(two / common, 1, delta=1e-15)
                self.assertAlmostEqual(one + ratio * two, 1, delta=1e-15)
                self.assertAlmostEqual(run.summary["impacts"]["total_impulse"] / (ratio * common), 1, delta=2e-15)
                self.assertAlmostEqual(run.summary["impacts"]["energy_lost"] / (ratio * common / 2), 1, delta=2e-15)
                self.assertEqual(run.summary["impacts"]["episodes"], 1)
                self.assertLess(run.energy["relative_residual"], 1e-14)


class MassesThatCannotMove(unittest.TestCase):
    def test_wall_takes_the_whole_momentum(self):
        words = scenes.blocks((2.0, 2.0), young=SOFT)
        words[words.index("-joint_primary") + 1] = "wall"
        run = History(self, words)
        self.assertEqual(run.channel("velocity", "probe0.x")[-1], 0)
        self.assertAlmostEqual(run.summary["impacts"]["total_impulse"], 1, delta=1e-15)
        self.assertEqual(run.summary["impacts"]["max_penetration"], run.column("max_penetration")[0])

    def test_partner_clamped_at_some_nodes(self):
        # Two of the four pairs of nodes meet a clamped one: they stop; the others share their momentum.
        run = History(self, [*scenes.blocks((2.0, 2.0), young=SOFT), "-two_clamp", "z_min"], 2)
        self.assertAlmostEqual(run.summary["impacts"]["total_impulse"], 0.5 + 0.25, delta=1e-15)
        self.assertAlmostEqual(run.channel("velocity", "probe0.x")[-1], 0.25, delta=1e-15)
        self.assertEqual(run.summary["contacts"]["joint"]["pairs"], 4)

    def test_pair_of_two_clamped_nodes_is_left_out(self):
        run = History(self, [*scenes.blocks((2.0, 2.0), young=SOFT), "-one_clamp", "z_min",
                             "-two_clamp", "z_min"])
        self.assertAlmostEqual(run.summary["impacts"]["total_impulse"], 0.25, delta=1e-15)
        self.assertEqual(int(run.impacts["points"][0]), 2)
        self.assertTrue(numpy.isfinite(run.data["velocity"]).all())


class StiffnessRatio(unittest.TestCase):
    SPEED, RATIO = 0.5, 1e10

    def test_both_frequencies(self):
        words = ["-structures", "chain", *scenes.two_masses("chain", 1.0, self.RATIO, self.SPEED),
                 "-end_time", 1e-9, "-modes", 6, "-spectra_frequencies", 10]
        chain = History(self, words).summary["structures"]["chain"]
        found = [2 * math.pi * mode["frequency"] for mode in chain["frequencies"]]
        for low in found[:3]:
            self.assertAlmostEqual(low / 0.7071067811865476, 1, delta=1e-6)  # 1e-16 x ratio
        for high in found[3:] + [chain["omega_max"]]:
            self.assertAlmostEqual(high / 141421.3562390773, 1, delta=2e-6)
        self.assertAlmostEqual(chain["stable_time_step"] / 1.4142135623554172e-05, 1, delta=1e-9)

    def test_history_and_round_off_of_the_energy(self):
        dt = 0.9 * 1.4142135623554172e-05
        run = History(self, ["-structures", "chain", *scenes.two_masses("chain", 1.0, self.RATIO, self.SPEED),
                             "-time_step", repr(dt), "-end_time", 0.5, "-output_interval", 1e-3, "-modes", 0,
                             "-spectra_frequencies", 10, "-probes", "one,two", "-one_structure", "chain",
                             "-one_at", "1,0,0", "-two_structure", "chain", "-two_at", "2,0,0"])
        exact = scenes.two_masses_history(self.RATIO, self.SPEED, dt, numpy.rint(run.time / dt))
        one, two = (run.channel("displacement", f"{name}.x") for name in ("one", "two"))
        self.assertLess(abs(one - exact).max(), 1e-8 * exact.max())
        self.assertLess(abs(one - two).max(), 1e-9 * exact.max())
        self.assertGreater(exact.max(), 0.2)
        # The strain energy cancels from terms ratio u^2: that is what 1e-16 is relative to.
        floor = 1e-16 * self.RATIO * exact.max()**2 / (2 * self.SPEED**2 / 2)
        self.assertLess(run.energy["relative_residual"], 10 * floor)


if __name__ == "__main__":
    unittest.main()
