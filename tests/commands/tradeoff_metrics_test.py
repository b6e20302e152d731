"""The distance between two spectra that run/tradeoff reports, against figures of an independent implementation.

The spectrum has a resonance at 3.7 Hz and rises towards 400 Hz; five others are made from it: the same one, 5 %
above, 1 % higher in frequency, halved around 200 Hz, and tilted about 20 Hz.
"""
import os
import sys
import unittest

import numpy as np

import program

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
sys.dont_write_bytecode = True
from pounding.commands import tradeoff  # noqa: E402
from pounding.tradeoff import metrics  # noqa: E402

FREQUENCY = np.geomspace(1, 400, 261)
REFERENCE = 1 + FREQUENCY / 80 + 10 / (1 + (np.log(FREQUENCY / 3.7) / 0.1)**2)
FOUND = {
    "same": REFERENCE,
    "5 % above": 1.05 * REFERENCE,
    "1 % higher": np.interp(FREQUENCY / 1.01, FREQUENCY, REFERENCE),
    "halved around 200 Hz": np.where(abs(FREQUENCY / 200 - 1) < 0.1, 0.5, 1) * REFERENCE,
    "tilted": (FREQUENCY / 20)**0.05 * REFERENCE,
}
# rms, largest, where [Hz], mean, class
EXPECTED = {
    "same": (0, 0, 1, 0, "A"),
    "5 % above": (0.04879016416943205, 0.04879016416943205, None, 0.04879016416943205, "B"),
    "1 % higher": (0.019957396741934783, 0.08788500266035458, 4.078338842768383, -0.002607950547142739, "B"),
    "halved around 200 Hz": (0.1289614898580163, 0.6931471805599453, None, -0.023993556250151902, "D"),
    "tilted": (0.0864806209985634, 0.14978661367769963, None, 0, "C"),
}
BANDS = ["1-400", "1-10", "10-50", "50-150", "150-400"]


class LogRatio(unittest.TestCase):
    def test_five_spectra(self):
        for name, (rms, largest, where, mean, letter) in EXPECTED.items():
            with self.subTest(name):
                figures = metrics.log_ratio(FREQUENCY, FOUND[name], REFERENCE)
                self.assertAlmostEqual(figures["rms"], rms, delta=1e-12)
                self.assertAlmostEqual(figures["max"], largest, delta=1e-12)
                self.assertAlmostEqual(figures["bias"], mean, delta=1e-12)
                if where is not None:
                    self.assertAlmostEqual(figures["at"], where, delta=1e-9)
                self.assertEqual(metrics.class_of(figures["rms"], figures["max"]), letter)

    def test_largest_below_the_reference_counts_by_its_size(self):
        figures = metrics.log_ratio(FREQUENCY, FOUND["halved around 200 Hz"], REFERENCE)
        self.assertGreater(figures["max"], 0)
        self.assertLess(abs(figures["at"] - 200), 20)

    def test_bands_hold_their_own_frequencies_only(self):
        probe = {"roof": (FREQUENCY, REFERENCE)}
        figures = metrics.compare({"roof": (FREQUENCY, FOUND["halved around 200 Hz"])}, probe)["roof"]
        self.assertEqual(list(figures), BANDS)
        for band in BANDS[1:4]:
            self.assertEqual((figures[band]["rms"], figures[band]["max"]), (0, 0), band)
        # Nine frequencies are halved; a frequency stands for an interval, one at either end for half of it.
        intervals = np.count_nonzero(FREQUENCY >= 150) - 1
        self.assertAlmostEqual(figures["150-400"]["rms"], np.log(2) * np.sqrt(9 / intervals), delta=1e-12)
        self.assertAlmostEqual(figures["1-400"]["rms"], np.log(2) * np.sqrt(9 / 260), delta=1e-12)

    def test_frequencies_weigh_by_their_interval(self):
        crowded = np.concatenate([np.geomspace(1, 20, 500), np.geomspace(20, 400, 30)[1:]])
        figures = metrics.log_ratio(crowded, np.where(crowded < 20, 2.0, 1.0), np.ones_like(crowded))
        self.assertAlmostEqual(figures["bias"], np.log(2) / 2, delta=2e-3)

    def test_ends_of_a_band_belong_to_it(self):
        spectrum = np.where((FREQUENCY > 1.001) & (FREQUENCY < 399), 1.0, 3.0)
        figures = metrics.log_ratio(FREQUENCY, spectrum, np.ones_like(spectrum))
        self.assertAlmostEqual(figures["rms"], np.log(3) * np.sqrt(1 / 260), delta=1e-12)


class Classes(unittest.TestCase):
    def test_both_bounds_count(self):
        for rms, largest, letter in ((0.01, 0.05, "A"), (0.0101, 0.05, "B"), (0.01, 0.051, "B"), (0.05, 0.2, "B"),
                                     (0.05, 0.21, "C"), (0.15, 0.5, "C"), (0.151, 0.5, "D"), (0.01, 0.51, "D")):
            self.assertEqual(metrics.class_of(rms, largest), letter, (rms, largest))


class Certificates(unittest.TestCase):
    def test_a_setting_that_changed_nothing_has_no_ratio(self):
        """As scaled mass where no element needs it: its true error is zero, the one told is not."""
        parts = {f"{kind} {part}": None for kind in ("told", "true") for part in tradeoff.PARTS}
        rows = [{"scene": "pair", "setting": "mass-2", "estimate": .02, "rms": rms, "certificate": .5, "why": "", **parts} for rms in (0., .04)]
        same, other = tradeoff.certificate_table(rows).splitlines()[-2:]
        self.assertIn("| 2.0 / 0 | — |", same)
        self.assertIn("| 2.0 / 4.0 | 0.5", other)


if __name__ == "__main__":
    unittest.main()
