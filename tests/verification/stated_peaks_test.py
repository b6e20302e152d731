"""Peaks that do not follow the time step or the samples: the two-storey pair, coarse, struck.

The peak acceleration of a probe is that of its record after a low-pass without phase (SAE J211-1: two poles of
Butterworth, forwards and backwards), the largest force of an impact its largest impulse within 1 ms over that
time. Both are computed here once more, from history.h5 alone, and stay what they are where the sampled peaks
and the largest impulse of a step over the step change by factors.
"""
import math
import os
import unittest

import h5py
import numpy

import program
from nonlinear_springs_test import mass, spring

PAIR = program.COARSE_PAIR + ["-motion_x_pga", 6, "-motion_x_envelope", "0.2,20", "-floor2_gap", "0.004,0.002",
                              "-floor1_gap", 0.02, "-end_time", 0.72, "-probes", "edge,middle",
                              "-edge_structure", "s1", "-edge_at", "3.36,0.912,5.22",
                              "-middle_structure", "s1", "-middle_at", "1.44,0.912,5.22"]
REDUCED = ["-s1_model", "modal", "-s1_modal_vectors", 40, "-s2_model", "modal", "-s2_modal_vectors", 40]
CUT = 400   # Hz, the highest frequency of the spectra


def filtered(values, interval, cut):
    """The formula of docs/manual/results.md, sample by sample."""
    w = math.tan(math.pi * cut * interval) / (math.sqrt(2) - 1) ** 0.25
    scale = 1 + math.sqrt(2) * w + w * w
    b, a1, a2 = w * w / scale, 2 * (1 - w * w) / scale, -(1 - math.sqrt(2) * w + w * w) / scale
    for _ in range(2):
        x1 = x2 = y1 = y2 = values[0]
        out = []
        for x in values:
            y = b * (x + 2 * x1 + x2) + a1 * y1 + a2 * y2
            x1, x2, y1, y2 = x, x1, y, y1
            out.append(y)
        values = out[::-1]
    return numpy.array(values)


class Run:
    def __init__(self, test, words, ranks):
        self.folder, self.summary = program.must_run(test, PAIR + words, ranks)
        table = program.read_csv(os.path.join(self.folder, "impacts.csv"))
        self.impacts = {name: numpy.array(table[name], dtype=float) for name in table if name != "contact"}
        with h5py.File(os.path.join(self.folder, "history.h5")) as file:
            self.data = {name: file[name][()] for name in ("time", "acceleration", "contact_force")}

    def peaks(self, probe, key="peak_acceleration"):
        return numpy.array(self.summary["probes"][probe][key])


class Peaks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        test = unittest.TestCase()
        cls.full = Run(test, ["-output_interval", 5e-5], 1)
        cls.coarse = Run(test, ["-output_interval", 2e-4], 2)
        cls.short = Run(test, ["-output_interval", 5e-5, "-courant", 0.4], 1)
        # Reduced structures step as far as their samples.
        cls.reduced = [Run(test, REDUCED + ["-output_interval", interval], ranks)
                       for interval, ranks in ((1e-5, 1), (5e-5, 2), (2e-4, 2))]

    def test_peaks_are_those_of_the_formula(self):
        for run in (self.full, self.coarse, self.reduced[1]):
            self.assertEqual(run.summary["peak_frequency"], CUT)
            for p, probe in enumerate(("edge", "middle")):
                found = [abs(filtered(run.data["acceleration"][:, 3 * p + d], run.summary["output_interval"], CUT)).max()
                         for d in range(3)]
                numpy.testing.assert_allclose(run.peaks(probe), found, rtol=1e-9)

    def test_peaks_do_not_follow_the_samples(self):
        for probe in ("edge", "middle"):
            self.assertAlmostEqual(self.coarse.peaks(probe)[0] / self.full.peaks(probe)[0], 1, delta=0.06)

    def test_peaks_do_not_follow_samples_and_steps_where_sampled_ones_do(self):
        """At the edge of a reduced structure an impulse acts within a sample."""
        fine, middle, coarse = self.reduced
        for probe in ("edge", "middle"):
            self.assertAlmostEqual(middle.peaks(probe)[0] / fine.peaks(probe)[0], 1, delta=0.02)
            self.assertAlmostEqual(coarse.peaks(probe)[0] / fine.peaks(probe)[0], 1, delta=0.08)
        key = "sampled_peak_acceleration"
        self.assertGreater(fine.peaks("edge", key)[0] / middle.peaks("edge", key)[0], 3)
        for other, factor in ((middle, 4), (coarse, 8)):
            ratio = self.strongest(fine, other)
            self.assertAlmostEqual(ratio["window_force"], 1, delta=0.01)
            self.assertGreater(ratio["peak_force"], factor)

    def test_peaks_do_not_follow_the_time_step(self):
        for probe in ("edge", "middle"):
            self.assertAlmostEqual(self.short.peaks(probe)[0] / self.full.peaks(probe)[0], 1, delta=0.01)
        ratio = self.strongest(self.short, self.full)
        self.assertAlmostEqual(ratio["impulse"], 1, delta=0.005)
        self.assertAlmostEqual(ratio["window_force"], 1, delta=0.005)
        self.assertGreater(ratio["peak_force"], 1.7)

    def strongest(self, one, other):
        """Ratios of what two runs say of their strongest impact."""
        a, b = one.impacts["impulse"].argmax(), other.impacts["impulse"].argmax()
        return {name: one.impacts[name][a] / other.impacts[name][b]
                for name in ("impulse", "window_force", "peak_force")}

    def test_forces_are_those_of_the_history(self):
        """With a sample in every step the recorded force is that of the steps."""
        run = self.reduced[0]
        step = run.summary["time_step"]
        self.assertEqual(run.summary["output_interval"], step)
        impulse = numpy.concatenate(([0], numpy.cumsum(run.data["contact_force"].sum(axis=1)) * step))
        ends = numpy.arange(len(impulse)) * step
        largest = 0
        for before, after in ((1e-3, 0), (0, 1e-3)):
            gained = numpy.interp(ends + after, ends, impulse) - numpy.interp(ends - before, ends, impulse)
            largest = max(largest, gained.max() / 1e-3)
        self.assertAlmostEqual(run.summary["impacts"]["window_force"] / largest, 1, delta=1e-9)
        self.assertAlmostEqual(run.impacts["window_force"].max() / largest, 1, delta=1e-9)

    def test_a_word_says_which_peak_to_take(self):
        said = [line for line in self.reduced[0].summary["warnings"] if line.startswith("probe")]
        self.assertTrue(any("part of a contact" in line and "1/output_interval" in line for line in said), said)
        self.assertTrue(any("edge, middle: sampled accelerations reach" in line and "reduced" in line
                            for line in said), said)

    def test_samples_too_far_apart_lower_the_filter_and_say_so(self):
        _, summary = program.must_run(self, PAIR + REDUCED + ["-output_interval", 2e-3], 2)
        self.assertAlmostEqual(summary["peak_frequency"] * summary["output_interval"], 0.25, delta=1e-12)
        self.assertTrue(any("peak accelerations are those below" in line for line in summary["warnings"]))
        _, summary = program.must_run(self, PAIR + ["-peak_frequency", 33, "-end_time", 0.1], 1)
        self.assertEqual(summary["peak_frequency"], 33)

    def test_continued_in_an_impact_to_the_bit(self):
        strongest = self.coarse.impacts["impulse"].argmax()
        middle = (self.coarse.impacts["start"][strongest] + self.coarse.impacts["end"][strongest]) / 2
        steps = int(middle / self.coarse.summary["time_step"])
        words = ["-output_interval", 2e-4, "-end_time", (steps + 10.5) * self.coarse.summary["time_step"]]
        folder, _ = program.must_run(self, PAIR + words + ["-checkpoint_steps", steps], 2)
        checkpoint = os.path.join(folder, "checkpoint.h5")
        folder, summary = program.must_run(
            self, PAIR + ["-output_interval", 2e-4, "-restart", checkpoint], 2)
        for key in ("peak_acceleration", "sampled_peak_acceleration"):
            self.assertEqual(summary["probes"]["edge"][key], self.coarse.summary["probes"]["edge"][key])
        with open(os.path.join(folder, "impacts.csv")) as one, \
                open(os.path.join(self.coarse.folder, "impacts.csv")) as other:
            self.assertEqual(one.read(), other.read())


class Lowered(unittest.TestCase):
    """A mass on a spring, which strikes nothing."""

    def words(self, step, interval, asked, *more):
        return [*mass(step, 0.01, "-chain_initial_velocity", "1,0,0", *spring("2e5,2e5,2e5")), "-modes", 1,
                "-spectra_frequencies", 10, "-output_interval", interval, "-peak_frequency", asked, *more]

    def test_what_the_samples_do_not_hold_is_told_with_what_to_give(self):
        for step, interval, asked, frequency, give in (
                (1e-3, 1e-3, 400, 250, "give -time_step and -output_interval 0.000625 or less"),
                (5e-4, 1e-3, 400, 250, "give -output_interval 0.000625 or less"),
                (5e-4, 5e-4, 400, 400, ""), (1e-3, 1e-3, 250, 250, "")):
            _, summary = program.must_run(self, self.words(step, interval, asked))
            self.assertEqual(summary["impacts"]["episodes"], 0)
            self.assertAlmostEqual(summary["peak_frequency"], frequency, delta=1e-9)
            said = [line for line in summary["warnings"] if "peak accelerations are those below" in line]
            self.assertEqual(len(said), 1 if give else 0, said)
            for line in said:
                self.assertIn("below 250 Hz, not 400 Hz: samples every 0.001 s hold no more", line)
                self.assertIn(give, line)
        _, summary = program.must_run(self, self.words(1e-3, 1e-3, 400, "-probes", "none"))
        self.assertFalse([line for line in summary["warnings"] if "peak accelerations" in line])


if __name__ == "__main__":
    unittest.main()
