"""pounding-spectra on the results of a run: channels, frames, envelopes, and the five treatments."""
import json
import os
import tempfile
import unittest

import h5py
import numpy

from spectra_command import computed, frequencies, impulse_factor, read, spectra

STEP = 1e-4  # of the samples [s]
SOLVER_STEP = 2e-6
IMPACTS = (("floor1", 0.6, 0.602, 0.05), ("floor2", 1.0, 1.003, -0.30), ("floor2", 1.5, 1.504, 0.12))


def make_results(folder):
    """A floor that sways at 3 Hz and is pushed during three contacts; times of samples as a run
    states them: means over the interval that ends half a solver step after the record."""
    time = numpy.arange(20001) * STEP
    offset = SOLVER_STEP / 2 - STEP / 2
    sway = 2 * numpy.sin(6 * numpy.pi * (time + offset))
    ground = 0.5 * numpy.cos(5 * (time + offset))
    pushes = numpy.zeros_like(time)
    for _, start, end, impulse in IMPACTS:
        low, high = numpy.clip(time + SOLVER_STEP / 2 - STEP, start, end), numpy.clip(
            time + SOLVER_STEP / 2, start, end)
        pushes += impulse * (high - low) / (end - start) / STEP
    with h5py.File(os.path.join(folder, "history.h5"), "w") as file:
        file.attrs["schema"] = 1
        file["time"] = time
        file["channels"] = numpy.array(["roof.x", "roof.y", "other.x"], dtype="S16")
        file["acceleration"] = numpy.stack([sway + pushes, ground, 0.5 * sway], 1)
        file["acceleration"].attrs["time_offset"] = offset
        file["ground_acceleration"] = numpy.stack([0 * time, ground, 0 * time], 1)
    with open(os.path.join(folder, "impacts.csv"), "w") as file:
        file.write("# comment\ncontact,start,end,duration,impulse\n")
        file.writelines(f"{name},{start},{end},{end - start},1\n" for name, start, end, _ in IMPACTS)
    with open(os.path.join(folder, "summary.json"), "w") as file:
        json.dump({"time_step": SOLVER_STEP}, file)


def sources(table):
    """Probe and direction of every row."""
    return [f"{probe}.{direction}" for probe, direction in zip(table["probe"], table["direction"])]


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-")
        make_results(cls.folder)
        cls.history = os.path.join(cls.folder, "history.h5")

    def psa(self, treatment, values, *words):
        table = computed(self, self.history, "--channels", "roof.x", "--treatment", treatment,
                         *frequencies(values), *words)
        return table["pseudo_acceleration"]

    def peaks(self, *words):
        path = os.path.join(self.folder, "peaks.csv")
        computed(self, self.history, "--channels", "roof.x", "--peaks", path, *frequencies([1]), *words)
        with open(path) as file:
            return read(file.read())

    def test_all_channels_or_those_asked_for(self):
        table = computed(self, self.history, *frequencies([1, 3]))
        self.assertEqual(sources(table), ["roof.x"] * 2 + ["roof.y"] * 2 + ["other.x"] * 2)
        table = computed(self, self.history, "--channels", "other,roof.y", *frequencies([1]))
        self.assertEqual(sources(table), ["other.x", "roof.y"])

    def test_relative_to_the_ground(self):
        table = computed(self, self.history, "--channels", "roof.y", "--frame", "relative", *frequencies([3]))
        self.assertEqual(table["displacement"][0], 0)

    def test_envelope_is_the_largest_of_the_channels(self):
        values = [1, 3, 8]
        each = computed(self, self.history, *frequencies(values))["pseudo_acceleration"].reshape(3, 3)
        table = computed(self, self.history, "--envelope", *frequencies(values))
        self.assertEqual(sources(table), ["envelope."] * 3)
        self.assertEqual(list(table["pseudo_acceleration"]), list(each.max(axis=0)))

    def test_broadening_holds_the_peak_over_its_band(self):
        grid = ["--channels", "other.x", "--frequencies", "1:9:800log"]
        plain = computed(self, self.history, *grid)
        wide = computed(self, self.history, *grid, "--broaden", 15)
        peak, f = plain["pseudo_acceleration"].max(), plain["frequency"]
        centre = f[plain["pseudo_acceleration"].argmax()]
        held = f[wide["pseudo_acceleration"] > peak * (1 - 1e-12)]
        self.assertAlmostEqual(held.min() / centre, 0.85, delta=0.005)
        self.assertAlmostEqual(held.max() / centre, 1.15, delta=0.005)
        self.assertTrue((wide["pseudo_acceleration"] >= plain["pseudo_acceleration"]).all())

    def test_says_what_was_done(self):
        table = read(spectra(self.history, "--channels", "other.x", *frequencies([2]), "--broaden", 15, "--start",
                             0.25).stdout)
        self.assertEqual([table[name][0] for name in ("interval", "valid_up_to", "start", "broadening")],
                         [1e-4, 450, 0.25, 0.15])
        self.assertEqual(computed(self, self.history, "--channels", "other.x", *frequencies([2]))["period"][0], 0.5)

    def test_regulatory_frequencies(self):
        table = computed(self, self.history, "--channels", "other.x", "--frequencies", "regulatory")
        self.assertEqual((len(table["frequency"]), table["frequency"][0], table["frequency"][-1]), (75, 0.2, 34))

    def test_peaks_stand_where_the_catalogue_says(self):
        table = self.peaks()
        self.assertEqual(list(table["highest"]), [0, 1, 0])
        for i, (_, start, end, impulse) in enumerate(IMPACTS):
            # whole samples; the sway adds 2 m/s2 at most
            self.assertTrue(start - 2 * STEP < table["start"][i] <= start)
            self.assertTrue(end <= table["end"][i] < end + 2 * STEP)
            for edge in (table["start"][i], table["end"][i]):  # where the interval of a sample begins
                number = (edge - SOLVER_STEP / 2) / STEP
                self.assertAlmostEqual(number, round(number), delta=1e-6)
            self.assertAlmostEqual(table["impulse"][i], impulse, delta=2.1 * (end - start + 2 * STEP))

    def test_peaks_of_one_contact(self):
        self.assertEqual(len(self.peaks("--contacts", "floor1")["start"]), 1)

    def test_margin_adds_time_on_both_sides(self):
        plain, wide = self.peaks(), self.peaks("--margin", 10 * STEP)
        for name, change in (("start", -10 * STEP), ("end", 10 * STEP)):
            self.assertLess(abs(wide[name] - plain[name] - change).max(), 1e-9)

    def test_high_frequencies_come_from_the_highest_peak(self):
        values = [60, 150, 300]
        complete, peaks, highest, rest = (self.psa(name, values) for name in (
            "complete", "all_peaks", "highest_peak", "without_peaks"))
        self.assertLess(abs(peaks / complete - 1).max(), 0.05)
        self.assertLess(abs(highest / complete - 1).max(), 0.05)
        self.assertLess((rest / complete).max(), 0.15)

    def test_low_frequencies_come_from_the_rest(self):
        complete, rest, peaks = (self.psa(name, [3]) for name in ("complete", "without_peaks", "all_peaks"))
        self.assertLess(abs(rest / complete - 1).max(), 0.25)
        self.assertLess((peaks / complete).max(), 0.5)

    def test_dirac_has_the_impulse_of_the_highest_peak(self):
        impulse = abs(self.peaks()["impulse"]).max()
        values = numpy.array([10, 100, 400.0])
        exact = impulse * 2 * numpy.pi * values * impulse_factor(0.05)
        # base 2 x 2e-6 s: an impulse
        self.assertLess(abs(self.psa("dirac", values) / exact - 1).max(), 1e-5)
        longer = self.psa("dirac", values, "--dirac-step", 5e-4)
        self.assertAlmostEqual(longer[2] / exact[2], 0.875157, delta=1e-5)

    def test_all_of_them_in_their_order(self):
        table = computed(self, self.history, "--channels", "roof.x", "--treatment", "all", *frequencies([5]))
        self.assertEqual(list(table["treatment"]), ["complete", "all_peaks", "highest_peak", "without_peaks",
                                                    "dirac"])

    def test_writes_the_same_table_to_a_file(self):
        path = os.path.join(self.folder, "table.csv")
        words = [self.history, "--channels", "other.x", *frequencies([2])]
        self.assertEqual(spectra(*words, "--output", path).stdout, "")
        with open(path) as file:
            self.assertEqual(file.read(), spectra(*words).stdout)

    def test_nine_digits_or_as_many_as_asked(self):
        words = [self.history, "--channels", "other.x", *frequencies([1 / 3])]
        exact = read(spectra(*words, "--digits", 17).stdout)
        for digits, more in ((9, ()), (6, ("--digits", 6))):
            header, row = spectra(*words, *more).stdout.splitlines()
            self.assertTrue(header.startswith("probe,direction,treatment,damping,frequency,period,"))
            for name, text in zip(header.split(","), row.split(",")):
                if name not in ("probe", "direction", "treatment"):
                    self.assertEqual(text, f"{exact[name][0]:.{digits}g}", name)
        for wrong in (5, 18, "many"):
            refused = spectra(*words, "--digits", wrong)
            self.assertEqual((refused.returncode, len(refused.stderr.splitlines())), (1, 1))
            self.assertIn("--digits", refused.stderr)

    def test_columns_of_a_record_by_number(self):
        path = os.path.join(self.folder, "three.csv")
        with open(path, "w") as file:
            file.write("time,x,y\n" + "".join(f"{i * 0.01:.2f},{i % 7 - 3},{(i % 5 - 2) * 2}\n" for i in range(400)))
        table = computed(self, path, "--unit", "m/s2", "--columns", "2,3", *frequencies([4]))
        self.assertEqual(sources(table), ["column2.", "column3."])
        last = computed(self, path, "--unit", "m/s2", "--columns", "3", *frequencies([4]))
        self.assertEqual(last["pseudo_acceleration"][0], table["pseudo_acceleration"][1])
        asked = spectra(path, "--unit", "m/s2", *frequencies([4]))
        self.assertEqual(asked.returncode, 1)
        self.assertIn("3 columns (time, x, y)", asked.stderr)


class Refusals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-")
        make_results(cls.folder)
        cls.history = os.path.join(cls.folder, "history.h5")

    def refuse(self, words, *expected):
        result = spectra(*words)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertEqual(result.stdout, "")
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(lines[0].startswith("pounding-spectra: "))
        for word in expected:
            self.assertIn(word, lines[0])

    def test_the_command_line(self):
        self.refuse([], "--help")
        self.refuse(["--dampin", 0.05, self.history], "--dampin", "did you mean damping")
        self.refuse([self.history, "--damping"], "--damping", "needs a value")
        for option, value in (("--damping", "1"), ("--damping", "five"), ("--frequencies", "0,1"),
                              ("--frequencies", "5,3"), ("--frequencies", "1:9:800"), ("--frequencies", "1e160"), ("--frequencies", "1e-160,1"), ("--broaden", "100"),
                              ("--treatment", "peaks"), ("--columns", "0"), ("--unit", "mm"),
                              ("--frame", "floor"), ("--after", "rest"), ("--margin", "-1"),
                              ("--time-step", "0"), ("--dirac-step", "nan")):
            self.refuse([self.history, option, value], option, "expected")
        self.refuse([self.history, "--true=1"], "--true", "no value")
        self.refuse([self.history, "--margin", "1e-3"], "no effect")

    def test_files(self):
        self.refuse([os.path.join(self.folder, "none.h5")], "none.h5", "no such file")
        self.refuse([os.path.join(self.folder, "none.AT2")], "none.AT2")
        self.refuse([os.path.join(self.folder, "summary.json")], "summary.json")
        self.refuse([self.history, "--output", "/nowhere/table.csv"], "/nowhere/table.csv")

    def test_rows_that_may_be_columns_are_doubted(self):
        record = os.path.join(self.folder, "three.txt")
        with open(record, "w") as file:
            file.write("dt = 0.02 s, units: cm/s2\n" + "".join(f"{i % 7}.5 {i % 5}.5 -{i % 3}.5\n" for i in range(40)))
        result = spectra(record, "--frequencies", "2,10", "--treatment", "complete")
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr, "^pounding-spectra: warning: .*rows of 3 values that follow one another, or columns")

    def test_channels(self):
        self.refuse([self.history, "--channels", "roof.z"], "roof.z", "did you mean")
        self.refuse([os.path.join(self.folder, "impacts.csv"), "--channels", "roof"], "record")

    def test_peaks_need_impacts(self):
        words = [self.history, "--treatment", "all_peaks"]
        self.refuse([*words, "--contacts", "attic"], "no impact")
        self.refuse([*words, "--impacts", os.path.join(self.folder, "none.csv")], "none.csv")
        quiet = os.path.join(self.folder, "quiet.csv")
        with open(quiet, "w") as file:
            file.write("contact,start,end\n")
        self.refuse([*words, "--impacts", quiet], "no impact")
        with open(quiet, "w") as file:
            file.write("contact,start,end\nroof,90,91\n")
        self.refuse([*words, "--impacts", quiet], "outside")

    def test_a_broken_history(self):
        broken = os.path.join(self.folder, "broken.h5")
        with open(self.history, "rb") as file, open(broken, "wb") as copy:
            copy.write(file.read()[:5000])
        self.refuse([broken], "broken.h5")

    def test_help(self):
        result = spectra("--help")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for option in ("--treatment", "--broaden", "--frequencies", "--impacts"):
            self.assertIn(option, result.stdout)
        self.assertLess(max(map(len, result.stdout.splitlines())), 100)


if __name__ == "__main__":
    unittest.main()
