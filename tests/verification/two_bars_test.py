"""Two elastic bars collide: Saint-Venant's impact, with equal and unequal bars.

The first bar moves at v0 = 1 m/s, the second rests; section 0.01 m2, no Poisson effect. With the
impedances Z = rho c A the force is v0 Z1 Z2 / (Z1 + Z2). Bars of equal transit time L/c: contact
for 2 L/c, then v1' = v0 (Z1 - Z2)/(Z1 + Z2), v2' = 2 v0 Z1/(Z1 + Z2), both without vibration.
Second bar of twice the length: contact for 2 L1/c, then no force while the faces still touch, and
v1' = 0, v2' = v0 / 2. The scheme loses exactly half of m1 m2/(m1 + m2) v0^2, with the lumped
masses of the two contact faces. Figures of the discrete solution: an independent one-dimensional
code.
"""
import math
import unittest

import numpy

import program
from decks import box_of, clock, contacts
from recorded import IDENTITY_OF_A_FLIGHT, Recorded, assert_follows
from references import chains

CONCRETE, STEEL = (30e9, 2400.0), (210e9, 7800.0)
GAP = 0.00010013700000000002
STEEL_LENGTH = 2.935197542821371  # same transit time as 2 m of concrete

# first bar, second bar (length, material, elements); force, duration, v1', v2' of the theory;
# force, duration, impulse, v1', v2' of the discrete solution at Courant number 0.9
CASES = {
    "identical": ((2.0, CONCRETE, 100), (2.0, CONCRETE, 100),
                  (42426.40687119285, 0.001131370849898476, 0.0, 1.0),
                  (42426.24336873229, 0.001135330647873121, 47.79723767158577,
                   0.004224215175296365, 0.9957757848247035)),
    "light on heavy": ((2.0, CONCRETE, 100), (STEEL_LENGTH, STEEL, 100),
                       (70146.178654819, 0.001131370849898476, -0.6533612867, 0.3466387133),
                       (70145.90832618045, 0.0011353306478731208, 79.02610237763064,
                        -0.6463771328673048, 0.3451744367821006)),
    "heavy on light": ((STEEL_LENGTH, STEEL, 100), (2.0, CONCRETE, 100),
                       (70146.178654819, 0.001131370849898476, 0.6533612867, 1.6533612867),
                       (70145.90832618039, 0.0011353306478731208, 79.02610237763058,
                        0.6548255632178999, 1.6463771328673042)),
    "short on long": ((1.0, CONCRETE, 100), (2.0, CONCRETE, 200),
                      (42426.40687119285, 0.000565685424949238, 0.0, 0.5),
                      (42426.45258980296, 0.0005905755836470045, 24.075428031201643,
                       -0.00314283463340184, 0.5015714173167004)),
}


def sound(material):
    return math.sqrt(material[0] / material[1])


def step_of(bars, courant):
    return courant * min(length / n / sound(material) for length, material, n in bars)


def scene(bars, time_step, end_time, gap=GAP, area=0.01, more=(), abreast=1):
    """abreast: so many pairs of such bars side by side, grown together."""
    words = ["-structures", "one,two", *contacts(joint=("two:x_min", "one:x_max", gap)),
             *clock(repr(time_step), repr(end_time), repr(time_step / 2)), "-energy_interval", 1, "-impact_merge_time",
             1e-4, "-one_initial_velocity", "1,0,0", "-probes",
             "one_body,one_x_min,one_x_max,two_body,two_x_min,two_x_max"]
    side = math.sqrt(area)
    for name, (length, material, n) in zip(("one", "two"), bars):
        start = -length if name == "one" else 0
        for group in ("body", "x_min", "x_max"):
            words += [f"-{name}_{group}_structure", name, f"-{name}_{group}_group", group]
        words += [*box_of(name, f"x0={start},lx={length},nx={n},ly={abreast * side!r},ny={abreast},lz={side!r}", name,
                          "hex8_full"),
                  f"-material_{name}_young", material[0], f"-material_{name}_poisson", 0, f"-material_{name}_density",
                  material[1]]
    return words + list(more)


def collide(test, arguments, ranks=program.RANKS):
    return Recorded(test, arguments, ranks, IDENTITY_OF_A_FLIGHT)


def velocities(run, bars):
    """Of the centres of mass."""
    return [run.bar_velocity(f"{name}_body", (f"{name}_x_min", f"{name}_x_max"), n, "x")
            for name, (_, _, n) in zip(("one", "two"), bars)]


class TwoBars(unittest.TestCase):
    def compare(self, case, ranks=program.RANKS):
        one, two, theory, discrete = CASES[case]
        run = collide(self, scene((one, two), step_of((one, two), 0.9), 0.0024), ranks)
        masses = [0.01 * length * material[1] for length, material, _ in (one, two)]
        force, duration, v1, v2 = theory
        start = run.column("start")[0]
        mean = run.plateau("joint", start + 0.2 * duration, start + 0.8 * duration)
        motion = velocities(run, (one, two))
        after = [velocity[-1] for velocity in motion]
        with self.subTest(case, against="theory"):
            self.assertAlmostEqual(start, GAP, delta=run.time_step)
            self.assertAlmostEqual(mean / force, 1, delta=1e-3)
            self.assertAlmostEqual(after[0], v1, delta=0.01)
            self.assertAlmostEqual(after[1], v2, delta=0.01)
            self.assertLessEqual(run.column("max_penetration")[0], run.time_step)
        with self.subTest(case, against="discrete solution"):
            self.assertAlmostEqual(mean / discrete[0], 1, delta=1e-4)
            self.assertAlmostEqual(run.column("duration")[0], discrete[1], delta=1e-9)
            self.assertAlmostEqual(run.summary["impacts"]["total_impulse"] / discrete[2], 1,
                                   delta=1e-8)
            self.assertAlmostEqual(after[0], discrete[3], delta=1e-9)
            self.assertAlmostEqual(after[1], discrete[4], delta=1e-9)
        with self.subTest(case, against="balances"):
            momentum = masses[0] * motion[0] + masses[1] * motion[1]
            self.assertLess(abs(momentum / masses[0] - 1).max(), 1e-10)  # round-off of K u
        contact_masses = [mass / bar[2] / 2 for mass, bar in zip(masses, (one, two))]
        lost = contact_masses[0] * contact_masses[1] / sum(contact_masses) / 2
        return run, lost

    def test_equal_transit_times(self):
        for case in ("identical", "light on heavy", "heavy on light"):
            run, lost = self.compare(case)
            self.assertAlmostEqual(run.energy["contact"] / -lost, 1, delta=1e-10)
            self.assertAlmostEqual(run.column("energy_lost").sum() / lost, 1, delta=1e-10)
            duration = CASES[case][2][1]
            self.assertAlmostEqual(run.column("duration")[0] / duration, 1, delta=0.01)

    def test_faces_stay_together_without_force(self):
        self.compare("short on long")

    def test_damped_bars_exchange_all_momentum(self):
        # Short on long with stiffness damping: the tail of zero force is smooth, and the impulse
        # is that of the theory to the last digit.
        bars = CASES["short on long"][:2]
        ratio = 0.3  # at the highest frequency 2 c/h
        beta = ratio * 0.01 / sound(CONCRETE)
        time_step = step_of(bars, 0.9) * (math.sqrt(1 + ratio**2) - ratio)
        run = collide(self, scene(bars, time_step, 0.0036, GAP, 0.01,
                                  ("-one_damping_beta", repr(beta),
                                   "-two_damping_beta", repr(beta))))
        self.assertAlmostEqual(run.summary["impacts"]["total_impulse"], 24, delta=24e-9)
        after = [velocity[-1] for velocity in velocities(run, bars)]
        self.assertAlmostEqual(after[0], 0, delta=1e-9)
        self.assertAlmostEqual(after[1], 0.5, delta=1e-9)
        self.assertAlmostEqual(run.energy["contact"], -0.03, delta=0.03e-9)

    def follow_chain(self, ranks, abreast=1):
        """Bars of ten and seven elements, whose clocks differ, step by step against an independent
        implementation of the scheme."""
        # One section for both, wide enough for the time step; the second bar has twice the section of the
        # first by its material.
        area, bars = 0.05, [(2.0, CONCRETE, 10), (1.5, (2 * STEEL[0], 2 * STEEL[1]), 7)]
        time_step, gap = step_of(bars, 0.8), 1e-4
        run = collide(self, scene(bars, time_step, 0.003, gap, area, abreast=abreast), ranks)
        parts = [chains.bar(n, length, *material, area) for length, material, n in bars]
        mass, stiffness = chains.side_by_side(*parts)
        first = len(parts[0][0])
        row = numpy.zeros(len(mass))
        row[first - 1], row[first] = -1, 1
        speeds = numpy.where(numpy.arange(len(mass)) < first, 1.0, 0.0)
        steps = len(run.time)
        _, v, impulse = chains.march(mass, stiffness, row, gap, time_step, steps, speeds)
        self.assertGreater((impulse > 0).sum(), 10)
        assert_follows(self, run.time, time_step * numpy.arange(steps), 1e-12, "time")
        assert_follows(self, run.force("joint") * time_step / abreast, impulse, 1e-9, "impulse")
        for velocity, part in zip(velocities(run, bars), (slice(first), slice(first, None))):
            assert_follows(self, velocity, chains.centre(mass, v, part), 1e-9, "velocity")
        return run

    def test_history_step_by_step(self):
        for ranks in (1, 2, 3):
            self.follow_chain(ranks)

    def test_history_when_the_ranks_share_the_faces(self):
        for ranks in (2, 3):
            run = self.follow_chain(ranks, abreast=30)
            self.assertEqual(run.summary["partition"]["interface_ranks"], ranks)
            self.assertEqual(run.summary["contacts"]["joint"]["matched"], 62)


if __name__ == "__main__":
    unittest.main()
