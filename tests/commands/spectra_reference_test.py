"""pounding-spectra against closed forms, tables of exact spectra, and other programs' spectra."""
import math
import os
import unittest

import numpy

import program
from references.response_spectra import HALF_SINE
from spectra_command import computed, frequencies, impulse_factor, overshoot, write_record

DAMPINGS = (0.0, 0.02, 0.05, 0.1)
RATIOS = ",".join(map(str, DAMPINGS))
G = 9.80665
RECORDS = os.path.join(program.SHARED, "records", "reference_spectra")


class ClosedForms(unittest.TestCase):
    def test_step(self):
        record = write_record(self, [3.0] * 4000, 1e-3)
        table = computed(self, *record, "--damping", RATIOS, *frequencies([0.7, 5, 60, 300]),
                         "--after", "ignored")
        exact = 3 * numpy.array([overshoot(xi) for xi in table["damping"]])
        self.assertLess(abs(table["pseudo_acceleration"] / exact - 1).max(), 1e-10)

    def test_impulse_of_a_dirac_at_any_step(self):
        # omega dt from 6e-6 to 2.5
        for step in (1e-6, 1e-5, 1e-4, 1e-3):
            record = write_record(self, [0, 1 / step, 0], step)
            table = computed(self, *record, "--damping", RATIOS, *frequencies([1, 10, 100, 400]))
            omega = 2 * math.pi * table["frequency"]
            factor = numpy.array([impulse_factor(xi) for xi in table["damping"]])
            droop = numpy.sinc(table["frequency"] * step)**2  # of the triangle, exact if undamped
            turns = table["frequency"] * step
            error = abs(table["pseudo_acceleration"] / omega / factor / droop - 1)
            self.assertLess(error[(table["damping"] == 0) & (turns < 0.2)].max(), 1e-9)
            # Damped, and where the triangle lasts for most of a cycle, to its square.
            self.assertLess((error / (0.5 * turns**2 + 1e-9)).max(), 1)

    def test_triangle_of_unit_impulse(self):
        exact = {1e-6: (58.225777, 582.25775, 1164.5154, 2329.0299),
                 1e-5: (58.225775, 582.25585, 1164.5002, 2328.9085),
                 1e-4: (58.225585, 582.06624, 1162.9839, 2316.7974),
                 5e-4: (58.220988, 577.48466, 1126.7064, 2038.2668)}
        for step, values in exact.items():
            record = write_record(self, [0, 1 / step, 0], step)
            table = computed(self, *record, *frequencies([10, 100, 200, 400]))
            self.assertLess(abs(table["pseudo_acceleration"] / values - 1).max(), 5e-8)

    def test_half_sine(self):
        duration, count = 0.01, 4000
        values = [math.sin(math.pi * i / count) for i in range(count)] + [0.0]
        record = write_record(self, values, duration / count)
        table = computed(self, *record, "--damping", "0,0.02,0.05",
                         *frequencies([product / duration for product in HALF_SINE]))
        exact = numpy.array(list(HALF_SINE.values())).T.ravel()
        self.assertLess(abs(table["pseudo_acceleration"] / exact - 1).max(), 1e-6)

    # 10 Hz, 1 m/s2 for 2 s from rest, 5 %
    HARMONIC = {0.1: 0.0090023777, 1.0: 0.10191769, 5.0: 0.80915696, 9.0: 5.0753783,
                10.0: 9.9817025, 11.0: 6.0325634, 20.0: 1.620059, 50.0: 1.041775,
                100.0: 1.0427683, 400.0: 1.0013073}

    def test_harmonic(self):
        step = 2e-5
        record = write_record(self, [math.sin(20 * math.pi * i * step) for i in range(100001)], step)
        table = computed(self, *record, *frequencies(self.HARMONIC), "--after", "ignored")
        exact = numpy.array(list(self.HARMONIC.values()))
        self.assertLess(abs(table["pseudo_acceleration"] / exact - 1).max(), 1e-6)

    def test_no_digits_are_lost_where_steps_are_short_or_long(self):
        # The same straight ramps cut into steps of omega dt from 1e-6 to 10 are the same motion.
        corners = numpy.array([0.0, 2.0, -1.0, 3.0, 0.0, 0.0])
        cuts = (1, 100, 10000)
        wanted = [1e-6 / (2 * math.pi * 1e-4), 0.01, 10 / (2 * math.pi), 3.0]  # omega dt from 1e-6 to 19
        found = []
        for cut in cuts:
            values = numpy.interp(numpy.arange(5 * cut + 1) / cut, range(6), corners)
            table = computed(self, *write_record(self, values, 1 / cut), *frequencies(wanted),
                             "--damping", "0,0.05", "--true")
            found.append(table)
        for name in ("displacement", "pseudo_acceleration", "velocity", "absolute_acceleration",
                     "relative_acceleration"):
            for table in found[1:]:
                self.assertLess(abs(table[name] / found[0][name] - 1).max(), 2e-9, name)


def columns_of(name):
    """Rows of numbers of a spectrum of SeismoSignal: period, absolute acceleration, ..."""
    rows = []
    with open(os.path.join(RECORDS, name), errors="replace") as file:
        for line in file:
            try:
                row = [float(word) for word in line.split()]
            except ValueError:
                continue
            if len(row) > 5 and row[0] > 0:
                rows.append(row)
    return numpy.array(rows)[::-1]  # by frequency


@unittest.skipUnless(os.path.isdir(RECORDS), "the reference records are not here")
class OtherPrograms(unittest.TestCase):
    def compare(self, table, name, expected, tolerance):
        self.assertEqual(len(table[name]), len(expected))
        self.assertLess(abs(table[name] / expected - 1).max(), tolerance, name)

    def test_a_near_fault_record_at_three_dampings(self):
        # Tables of five digits of a program that integrates step by step: within 1 %.
        for percent in (2, 5, 10):
            rows = columns_of(f"RSN1044_Damping{percent}.txt")
            self.assertEqual(len(rows), 80)
            table = computed(self, os.path.join(RECORDS, "RSN1044_DirRot2.AT2"), "--true",
                             "--damping", percent / 100, *frequencies(1 / rows[:, 0]))
            self.compare(table, "absolute_acceleration", rows[:, 1] * G, 0.01)
            self.compare(table, "velocity", rows[:, 5] / 100, 0.011)
            self.compare(table, "displacement", rows[:, 9] / 100, 0.01)
            self.compare(table, "pseudo_acceleration", rows[:, -2] * G, 0.01)

    def test_imperial_valley(self):
        rows = columns_of("SeismoSignal_Imperial Valley.txt")
        table = computed(self, os.path.join(RECORDS, "Imperial Valley.dat"), "--unit", "m/s2",
                         "--true", *frequencies(1 / rows[:, 0]))
        self.compare(table, "absolute_acceleration", rows[:, 1], 0.007)
        self.compare(table, "pseudo_acceleration", rows[:, -2], 0.007)

    def test_a_short_record(self):
        with open(os.path.join(RECORDS, "test_motion_true_spectra_acc.csv"), encoding="utf-8-sig") as file:
            rows = [line.split(",") for line in file.read().splitlines()[1:]]
        rows = numpy.array(rows, dtype=float)[::-1]
        table = computed(self, os.path.join(RECORDS, "test_motion_dt0p01.txt"), "--unit", "m/s2",
                         *frequencies(1 / rows[:, 0]))
        slow = rows[:, 0] >= 0.2
        difference = abs(table["pseudo_acceleration"] / (G * rows[:, 1]) - 1)
        self.assertLess(difference[slow].max(), 0.012)
        # Short periods: the other program interpolates the record, of 0.01 s, in its own way.
        self.assertLess(difference.max(), 0.05)


if __name__ == "__main__":
    unittest.main()
