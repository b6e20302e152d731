"""Two oscillators that pound against each other on a shaken ground, against event-driven results.

Masses 9200 and 7000 kg, 2.1 and 3.7 Hz, 1.5 % damping of the mass-proportional kind; plastic impact
(a lumped node keeps no velocity of approach). Ground: 0.30 g sin(2 pi 2.6 t) for 5 s, or an
earthquake of 0.45 g for 15 s; gaps of 5, 2 and 0 cm. Each oscillator is one hexahedron of unit
section and length without Poisson effect, clamped at its far face: its free face carries half of
its mass on the stiffness E A / L.

Reference: solution between events in closed form, event times by bisection (tests/references). The
scheme is of first order at impacts; the program follows, step by step, what an independent
implementation of the scheme makes of the two masses.
"""
import math
import unittest

import numpy

import decks
import program
from recorded import Recorded, assert_follows, write_samples, write_sine
from references import earthquake, oscillators

MASS = (9200.0, 7000.0)
STIFFNESS = (1601718.3590439898, 3783216.759025573)
ALPHA = (0.3958406743523139, 0.697433569096934)
ACCELERATION, FREQUENCY = 0.30 * 9.81, 2.6

# gap [m], under the harmonic ground: time [s] and impulse [N s] of the first impacts
REFERENCE = {
    0.05: [(0.422429616787, 1221.920827), (0.787569518184, 3355.041405), (1.187177989549, 5271.265067)],
    0.02: [(0.366897113831, 2649.258601), (0.381065922116, 4.167007), (0.747218570206, 4921.420469)],
    0.00: [(0.335794468221, 2345.863299), (0.721708509749, 4991.614191), (1.104032251240, 5658.692036)],
}
CASES = [f"{ground}_gap{gap}" for ground in ("harm", "quake") for gap in ("0.05", "0.02", "0")]
TIME_STEPS = (1e-3, 5e-4, 2.5e-4, 1.25e-4)


def scene(gap, time_step, record, end_time):
    return [*decks.oscillators(MASS, STIFFNESS, ALPHA), "-end_time", end_time, "-time_step", repr(time_step),
            "-output_interval", repr(time_step / 2), "-impact_merge_time", 1e-9, "-gap_gap", gap,
            "-motion_x_record", record, "-motion_x_unit", "m/s2"]


def impacts(run):
    """Times and impulses of the steps at which the faces meet: force after a step without."""
    impulse = run.force("gap") * run.time_step
    first = numpy.nonzero((impulse > 0) & (numpy.append(0, impulse[:-1]) == 0))[0]
    return run.time[first], impulse[first]


class SdofPounding(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.record = write_sine(ACCELERATION, FREQUENCY, 5.0)
        cls.earthquake = write_samples(earthquake.acceleration(), earthquake.STEP)

    def test_frequencies_are_those_of_the_oscillators(self):
        _, summary = program.must_run(self, scene(0.05, 1e-3, self.record, 0.01) + ["-modes", 12])
        for name, frequency in (("left", 2.1), ("right", 3.7)):
            modes = summary["structures"][name]["frequencies"]
            stretch = [mode["frequency"] for mode in modes
                       if mode["direction"] == "x" and mode["fraction"] > 0.99]
            self.assertAlmostEqual(stretch[0], frequency, delta=1e-6)

    def test_first_impacts(self):
        time_step = 1.25e-4
        for gap, reference in REFERENCE.items():
            run = Recorded(self, scene(gap, time_step, self.record, 1.3))
            times, impulses = impacts(run)
            for time, impulse in reference:
                if impulse < 100:  # a touch at 1 mm/s: which step sees it is a matter of chance
                    continue
                nearest = abs(times - time).argmin()
                self.assertLess(abs(times[nearest] - time), 1.5 * time_step, (gap, time, times))
                self.assertLess(abs(impulses[nearest] / impulse - 1), 0.01, (gap, time))

    def test_every_oscillator_on_a_rank_of_its_own(self):
        run = Recorded(self, scene(0.02, 2e-4, self.record, 0.01), 3)
        self.assertEqual(run.summary["partition"]["interface_ranks"], 2)

    def ground(self, name):
        """Record and end of the run, samples of the reference and their step [s]."""
        if name.startswith("harm"):
            times = numpy.arange(50001) * 1e-4
            return self.record, 5.0, ACCELERATION * numpy.sin(2 * math.pi * FREQUENCY * times), 1e-4
        fine = numpy.arange(30001) * 5e-4
        coarse = earthquake.acceleration()
        return self.earthquake, 15.0, numpy.interp(fine, numpy.arange(len(coarse)) * earthquake.STEP, coarse), 5e-4

    def errors(self, run, exact, step):
        """Of both displacements, every 5 ms (root mean square over that of the reference), and the largest of
        the first eight impact times [s]."""
        samples = numpy.arange(round(len(exact.u1) * step / 5e-3)) * 5e-3
        errors = []
        for probe, reference in (("face1.x", exact.u1), ("face2.x", exact.u2)):
            expected = reference[numpy.rint(samples / step).astype(int)]
            found = run.displacement(probe)[numpy.rint(samples / run.time_step).astype(int)]
            errors.append(math.sqrt(((found - expected)**2).mean() / (expected**2).mean()))
        times, _ = impacts(run)
        hard = [time for time, _, closing in exact.impacts if closing > 0.02][:8]
        errors.append(max(abs(times - time).min() for time in hard))
        return errors

    def test_follows_the_scheme_and_nears_the_exact_motion_with_first_order(self):
        bodies = [oscillators.Oscillator(*body) for body in zip(MASS, STIFFNESS, ALPHA)]
        for name in CASES:
            gap = float(name.split("gap")[1])
            record, end, ground, step = self.ground(name)
            exact = oscillators.events(*bodies, gap, ground, step)
            self.assertGreater(len(exact.impacts), 3)
            found = []
            for time_step in TIME_STEPS:
                run = Recorded(self, scene(gap, time_step, record, end))
                with self.subTest(name, time_step=time_step):
                    first, second, impulse = oscillators.scheme(*bodies, gap, ground, step, time_step, end)
                    assert_follows(self, run.displacement("face1.x"), first, 1e-7, "left")
                    assert_follows(self, run.displacement("face2.x"), second, 1e-7, "right")
                    self.assertAlmostEqual(run.force("gap").sum() * time_step / impulse.sum(), 1, delta=1e-6)
                    found.append(self.errors(run, exact, step))
                    self.assertLess(max(found[-1][:2]), 80 * time_step)
                    self.assertLess(found[-1][2], (3.4 if name.startswith("harm") else 13) * time_step)
            for k in (0, 1):
                order = math.log2(found[0][k] / found[-1][k]) / 3
                self.assertTrue((0.8 if name.startswith("harm") else 0.5) < order < 1.3, (name, order, found))


ON_RANKS = {"two oscillators that pound": lambda: scene(0.02, 2e-4, write_sine(ACCELERATION, FREQUENCY, 0.8), 0.8)}


if __name__ == "__main__":
    unittest.main()
