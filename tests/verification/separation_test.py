"""The joint that would be needed, by response spectrum: two oscillators against numpy, the difference rule against
white noise, and what becomes of it on more ranks, in modes and at a wall."""
import os
import unittest

import h5py
import numpy

import program
import sdof_pounding_test as oscillators
from recorded import write_samples

STEP = 0.01  # of the record [s]
RATIOS = tuple(alpha / (2 * 2 * numpy.pi * f) for alpha, f in zip(oscillators.ALPHA, (2.1, 3.7)))


def correlation(f1, z1, f2, z2):
    """Of two oscillators in white noise, from the integral of the product of their transfer functions."""
    w1, w2 = 2 * numpy.pi * f1, 2 * numpy.pi * f2
    crossed = (2 * z1 * w1 + 2 * z2 * w2) / ((w1**2 - w2**2)**2 + 4 * z1 * z2 * w1 * w2 * (w1**2 + w2**2)
                                             + 4 * (z1**2 + z2**2) * w1**2 * w2**2)
    alone = [1 / (4 * z * w**3) for z, w in ((z1, w1), (z2, w2))]
    return crossed / numpy.sqrt(alone[0] * alone[1])


def transition(f, z, step):
    """Exact step of an oscillator under an acceleration that is constant over it: x <- A x + b a."""
    w = 2 * numpy.pi * f
    whole = numpy.zeros((3, 3))
    whole[:2] = [[0, 1, 0], [-w * w, -2 * z * w, -1]]
    power = numpy.eye(3)
    term = numpy.eye(3)
    for k in range(1, 40):
        term = term @ whole * step / k
        power = power + term
    return power[:2, :2], power[:2, 2]


def largest_displacement(record, f, z, parts=20):
    """Of an oscillator under a record that is linear between its samples, then in free vibration [m]."""
    times = numpy.arange(len(record) + int(2 / STEP)) * STEP
    fine = numpy.arange(0, times[-1], STEP / parts)
    ground = numpy.interp(fine + STEP / parts / 2, times[:len(record)], record, right=0)
    matrix, load = transition(f, z, STEP / parts)
    state, most = numpy.zeros(2), 0.0
    for a in ground:
        state = matrix @ state + load * a
        most = max(most, abs(state[0]))
    return most


class Oscillators(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        random = numpy.random.default_rng(3)
        time = numpy.arange(0, 6, STEP)
        cls.record = 2 * numpy.interp(time, [0, 1, 4, 6], [0, 1, 1, 0]) * sum(
            numpy.sin(2 * numpy.pi * f * time + random.uniform(0, 6)) for f in (1.5, 2.3, 3.1, 4.2))
        cls.file = write_samples(cls.record, STEP)

    def words(self, *more):
        return oscillators.scene(0.4, 1e-3, self.file, 0.01) + ["-modes", 12, "-resampling", "linear", *more]

    def found(self, *more, ranks=program.RANKS):
        _, summary = program.must_run(self, self.words(*more), ranks)
        return summary["separations"]["gap"]

    def test_two_oscillators_are_those_of_numpy(self):
        u1, u2 = (largest_displacement(self.record, f, z) for f, z in zip((2.1, 3.7), RATIOS))
        rho = correlation(2.1, RATIOS[0], 3.7, RATIOS[1])
        expected = {"sum": u1 + u2, "srss": numpy.hypot(u1, u2), "correlation": rho,
                    "ddc": numpy.sqrt(u1**2 + u2**2 - 2 * rho * u1 * u2),
                    "modal": numpy.sqrt(u1**2 + u2**2 - 2 * rho * u1 * u2)}
        for ranks in (1, 2):
            found = self.found(ranks=ranks)
            self.assertAlmostEqual(found["secondary"]["peak_displacement"] / u1, 1, delta=1e-3, msg="left")
            self.assertAlmostEqual(found["primary"]["peak_displacement"] / u2, 1, delta=1e-3, msg="right")
            self.assertAlmostEqual(found["secondary"]["damping_ratio"], RATIOS[0], delta=1e-9)
            for name, value in expected.items():
                self.assertAlmostEqual(found[name] / value, 1, delta=1e-3, msg=name)

    def test_beside_the_run_itself(self):
        """The gap is so wide that nothing hits: the closing of a history is near, and below the sum."""
        folder, summary = program.must_run(self, self.words("-end_time", 8))
        with h5py.File(os.path.join(folder, "history.h5")) as file:
            closing = 0.4 - numpy.nanmin(file["gap"][()])
        found = summary["separations"]["gap"]
        self.assertEqual(summary["impacts"]["episodes"], 0)
        self.assertLess(closing, found["sum"])
        self.assertAlmostEqual(found["modal"] / closing, 1, delta=0.35)

    def test_printed_by_every_dry_run(self):
        for ranks in (1, 2):
            result = program.must_end(self, [*self.words(), "-dry_run"], ranks)
            self.assertRegex(result.stdout, r"joint gap, 400 mm: peaks along its normal by response spectrum: left ")
            self.assertRegex(result.stdout, r"needed so that nothing hits: modal [\d.]+ mm, DDC [\d.]+ \(correlation 0\.0")

    def test_reduced_structures(self):
        full = self.found()
        reduced = self.found("-left_model", "modal", "-left_modal_vectors", 12, "-right_model", "modal",
                             "-right_modal_vectors", 12, "-right_modal_damping", RATIOS[1])
        for name in ("sum", "srss", "ddc", "modal"):
            self.assertAlmostEqual(reduced[name] / full[name], 1, delta=1e-6, msg=name)

    def test_a_wall_does_not_move(self):
        words = self.words()
        pairs = [pair for pair in zip(words[::2], words[1::2])
                 if not pair[0].startswith(("-left_", "-material_left", "-face1"))]
        changed = {"-structures": "right", "-gap_secondary": "right:x_min", "-gap_primary": "wall", "-probes": "face2"}
        _, summary = program.must_run(self, [word for name, value in pairs for word in (name, changed.get(name, value))])
        found = summary["separations"]["gap"]
        self.assertEqual(found["primary"], {"structure": "wall", "peak_displacement": 0.0, "modes": 0,
                                            "frequency": 0.0, "damping_ratio": 0.0})
        for name in ("sum", "srss", "ddc", "modal"):
            self.assertAlmostEqual(found[name], found["secondary"]["peak_displacement"], delta=1e-15)

    def test_none_without_modes(self):
        result = program.must_end(self, [*self.words("-modes", 0), "-dry_run"], 2)
        self.assertNotIn("joint gap", result.stdout)


class WhiteNoise(unittest.TestCase):
    """1000 stationary runs of two oscillators under the same white noise."""

    def test_difference_rule(self):
        random = numpy.random.default_rng(7)
        step, runs, warm, steps = 0.01, 1000, 3000, 3000
        for f1, z1, f2, z2 in ((2.0, 0.05, 2.4, 0.05), (2.0, 0.02, 2.4, 0.10), (2.0, 0.10, 2.4, 0.02), (1.0, 0.05, 3.0, 0.02)):
            systems = [transition(f, z, step) for f, z in ((f1, z1), (f2, z2))]
            state = numpy.zeros((2, 2, runs))
            squares = numpy.zeros(3)
            for n in range(warm + steps):
                noise = random.normal(size=runs)
                for k, (matrix, load) in enumerate(systems):
                    state[k] = matrix @ state[k] + numpy.outer(load, noise)
                if n >= warm:
                    x1, x2 = state[:, 0]
                    squares += [numpy.mean(x1**2), numpy.mean(x2**2), numpy.mean((x1 - x2)**2)]
            u1, u2, apart = numpy.sqrt(squares / steps)
            rho = correlation(f1, z1, f2, z2)
            rule = numpy.sqrt(u1**2 + u2**2 - 2 * rho * u1 * u2)
            self.assertAlmostEqual(rule / apart, 1, delta=0.03, msg=(f1, z1, f2, z2))


if __name__ == "__main__":
    unittest.main()
