"""Equipment on floors: its capacity beside a spectrum that is widened by hand, rules by capacities made for them, and the
report that says which items fail because of the joint.

Two small buildings for 1.2 s at a gap of 10 mm, where they hit, and without contacts."""
import csv
import html
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy
import scipy.signal

import program
import two_buildings

WIDTH, G = .15, 9.80665


def widened(frequency, values, part):
    """The largest value from f / (1 + part) to f / (1 - part), between the points linear in logarithms."""
    fine = numpy.unique(numpy.concatenate([frequency, frequency / (1 + part), frequency / (1 - part)]))
    fine = fine[(fine >= frequency[0]) & (fine <= frequency[-1])]
    between = numpy.exp(numpy.interp(numpy.log(fine), numpy.log(frequency), numpy.log(values)))
    return numpy.array([between[(fine >= f / (1 + part) * (1 - 1e-12)) & (fine <= f / (1 - part) * (1 + 1e-12))].max()
                        for f in frequency])


class Equipment(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = Path(tempfile.mkdtemp(prefix="pounding-equipment-"))
        flat = cls.file("flat", [(.1, 50.0), (1000, 50.0)])
        cls.hit = cls.run_with("hit", {"flat": {"capacity": flat}}, gap=.01)
        cls.frequency, values = cls.hit.spectrum("left_roof", "x", .05)
        cls.required = widened(cls.frequency, values, WIDTH)

    @classmethod
    def file(cls, name, rows):
        path = cls.place / f"{name}.csv"
        path.write_text("frequency,acceleration\n" + "".join(f"{float(f)!r},{float(a)!r}\n" for f, a in rows))
        return str(path)

    @classmethod
    def run_with(cls, name, items, ranks=1, **options):
        """A run with items of equipment at the left roof, by name and their options."""
        options["equipment"] = ",".join(items)
        for item, own in items.items():
            for key, value in {"probe": "left_roof", "direction": "x", "capacity_unit": "m/s2", **own}.items():
                options[f"{item}_{key}"] = value
        return two_buildings.run(cls.place / name, ranks, **options)

    def test_required_is_the_widened_spectrum(self):
        table = self.hit.equipment
        numpy.testing.assert_allclose(table["frequency"], self.frequency, rtol=1e-8)
        numpy.testing.assert_allclose(table["required"], self.required, rtol=1e-7)
        numpy.testing.assert_allclose(table["capacity"], 50, rtol=1e-8)
        one = self.hit.verdicts["flat"]
        self.assertAlmostEqual(one["ratio"] * self.required.max() / 50, 1, delta=1e-7)
        at_zero = one["directions"]["x"]
        self.assertEqual(at_zero["required_at_zero_period"], self.hit.summary["probes"]["left_roof"]["peak_acceleration"][0])
        self.assertAlmostEqual(at_zero["capacity_at_zero_period"], 50, delta=1e-6)
        high = self.required[(self.frequency >= 20) & (self.frequency <= 40)].max()
        self.assertAlmostEqual(one["high_band_ratio"] * high / 50, 1, delta=1e-7)

    def test_zero_period_of_a_capacity_that_ends_below_it(self):
        """The floor has its peak, the capacity no such value; inside a cabinet there is no floor's peak. Spectra whose
        frequencies are so far apart that a peak hides between them are doubted."""
        items = {"low": {"capacity": self.file("low", [(1, 40), (5, 40)])},
                 "inside": {"capacity": self.file("inside", [(1, 40), (50, 40)]), "cabinet_frequency": 12,
                            "cabinet_damping": .03}}
        run = self.run_with("low", items, gap=.01, spectra_frequencies="1,2,4.5,5,50")
        low, inside = (run.verdicts[name]["directions"]["x"] for name in items)
        self.assertEqual(low["required_at_zero_period"], run.summary["probes"]["left_roof"]["peak_acceleration"][0])
        self.assertIsNone(low["capacity_at_zero_period"])
        self.assertIsNone(inside["required_at_zero_period"])
        self.assertAlmostEqual(inside["capacity_at_zero_period"], 40, delta=1e-6)
        doubts = [line for line in run.summary["warnings"] if "has no frequency between" in line]
        self.assertEqual([line.split(":")[0] for line in doubts], ["equipment low", "equipment inside"])
        self.assertIn("between 2 and 4.5 Hz", doubts[0])
        self.assertFalse(any("has no frequency between" in line for line in self.hit.summary["warnings"]))

    def test_spectra_have_the_corners_of_capacities(self):
        """Those between the ends of spectra_frequencies; the others stay as they are."""
        corners = {"notched": {"capacity": self.file("notched", [(.2, 50), (9.9, 50), (10.01, .002), (10.2, 50), (900, 50)])}}
        run = self.run_with("corners", corners, gap=.01)
        frequency, values = run.spectrum("left_roof", "x", .05)
        numpy.testing.assert_allclose(sorted({*frequency} - {*self.frequency}), [9.9, 10.01, 10.2], rtol=1e-8)
        old = numpy.isin(frequency, self.frequency)
        numpy.testing.assert_allclose(values[old], self.hit.spectrum("left_roof", "x", .05)[1], rtol=1e-8)
        at = run.equipment["frequency"] == 10.01
        self.assertAlmostEqual(run.equipment["capacity"][at][0], .002, delta=1e-12)
        one = run.verdicts["notched"]
        self.assertEqual(one["frequency"], 10.01)  # no other frequency has so little of it
        self.assertAlmostEqual(one["ratio"] * run.equipment["required"][at][0] / .002, 1, delta=1e-9)
        self.assertEqual(set(self.hit.summary["equipment"]["flat"]) & {"passes", "ratio"}, set())
        self.assertFalse((run.folder / "equipment.csv").exists())

    def test_in_a_cabinet(self):
        """The spectrum of an oscillator on the recorded floor, by another integration of the same samples."""
        item = {"flat": {"capacity": self.file("flat", [(.1, 50.0), (1000, 50.0)]), "cabinet_frequency": 12,
                         "cabinet_damping": .03}}
        run = self.run_with("cabinet", item, gap=.01)
        time, floor = run.series("acceleration", "left_roof", "x")
        omega, step = 2 * numpy.pi * 12, time[1] - time[0]
        system = scipy.signal.cont2discrete((numpy.array([[0, 1], [-omega**2, -.06 * omega]]), numpy.array([[0.0], [-1]]),
                                             numpy.array([[-omega**2, -.06 * omega]]), numpy.zeros((1, 1))), step, "foh")
        history = scipy.signal.dlsim(system, floor)[1].ravel()
        path = self.place / "inside.csv"
        numpy.savetxt(path, numpy.column_stack([time - time[0], history]), delimiter=",", header="time,acceleration", comments="")
        words = [os.path.join(program.BUILD, "pounding-spectra"), "--columns", "2", "--unit", "m/s2", "--after", "ignored",
                 "--frequencies", ",".join(f"{one:.9g}" for one in self.frequency), str(path)]
        found = subprocess.run(words, capture_output=True, text=True, check=True, cwd=program.SOURCE).stdout
        rows = list(csv.DictReader(line for line in found.splitlines() if not line.startswith("#")))
        values = numpy.array([float(row["pseudo_acceleration"]) for row in rows])
        numpy.testing.assert_allclose(run.equipment["required"], widened(self.frequency, values, WIDTH), rtol=1e-5)
        self.assertNotIn("flat cabinet", run.spectrum_probes)
        at_twelve = numpy.interp(12, self.frequency, run.equipment["required"])
        self.assertGreater(at_twelve, 3 * numpy.interp(12, self.frequency, self.required))  # it resonates

    def test_rules(self):
        """Capacities that are the required spectrum times a factor, with what each rule is about."""
        def capacity(name, factor, unit=1.0):
            return self.file(name, zip(self.frequency, factor * self.required / unit))

        near, octaves = numpy.argmin(abs(self.frequency - 10)), abs(numpy.log2(self.frequency / 10))
        dip = numpy.where(numpy.arange(len(self.frequency)) == near, 1.05, 1.2)
        items = {"enough": {"capacity": capacity("enough", 1.1001)},
                 "short": {"capacity": capacity("short", 1.0999)},
                 "bare": {"capacity": capacity("bare", 1.0001), "margin": 0},
                 "in_g": {"capacity": capacity("in_g", 1.1001, G), "capacity_unit": "g"},
                 "dipped": {"capacity": capacity("dipped", dip), "dip": .1},
                 "strict": {"capacity": capacity("strict", dip)},
                 "deep": {"capacity": capacity("deep", numpy.where(dip < 1.1, .95, 1.2)), "dip": .1},
                 "wide": {"capacity": capacity("wide", numpy.where(octaves < .4, 1.05, 1.2)), "dip": .1},
                 "beside": {"capacity": capacity("beside", numpy.where(self.frequency > 40, .5, 1.2)), "band": "1,33"},
                 "all": {"capacity": self.file("weak", [(f, 1e-3) for f in self.frequency[[20, -20]]]), "direction": "all"}}
        expected = {"enough": True, "short": False, "bare": True, "in_g": True, "dipped": True, "strict": False,
                    "deep": False, "wide": False, "beside": True, "all": False}
        found = [self.run_with(f"rules{ranks}", items, ranks, gap=.01).verdicts for ranks in (1, 2)]
        self.assertEqual({name: one["passes"] for name, one in found[0].items()}, expected)
        self.assertEqual(list(found[0]["all"]["directions"]), ["x", "y", "z"])
        self.assertAlmostEqual(found[0]["strict"]["ratio"], 1.05, delta=1e-6)
        self.assertAlmostEqual(found[0]["strict"]["frequency"] / self.frequency[near], 1, delta=1e-6)
        self.assertAlmostEqual(found[0]["beside"]["ratio"], 1.2, delta=1e-6)
        for name, one in found[0].items():
            self.assertEqual(one["passes"], found[1][name]["passes"])
            if one["ratio"] is not None:
                self.assertAlmostEqual(found[1][name]["ratio"] / one["ratio"], 1, delta=1e-6)

    def test_the_report_opens_with_what_fails_because_of_the_joint(self):
        alone = self.run_with("plain", {"flat": {"capacity": self.file("flat", [(.1, 50.0), (1000, 50.0)])}}, contacts="none")
        without = widened(*alone.spectrum("left_roof", "x", .05), WIDTH)
        self.assertLess(1.5 * without.max(), self.required.max())  # or nothing here hangs on the joint
        level = 1.1 * without.max() * 1.01
        items = {"relay": {"capacity": self.file("relay", [(.1, level), (1000, level)])},
                 "glass": {"capacity": self.file("glass", [(.1, level / 10), (1000, level / 10)])},
                 "anvil": {"capacity": self.file("anvil", [(.1, 1e4), (1000, 1e4)])}}
        run = self.run_with("joint", items, gap=.01)
        self.run_with("joint-without", items, contacts="none")
        done = program.must_do(self, "plot", run.folder)
        page = (run.folder / "report.html").read_text(encoding="utf-8")
        answer = html.unescape(re.sub("<[^>]*>", " ", re.search(r'<div class="answer.*?</div>', page, re.DOTALL)[0]))
        self.assertTrue(answer.strip().startswith("Because of the joint 1 of 3 items of equipment fails: relay (capacity over "
                                                  "required "), answer[:200])
        self.assertIn("1 of 3 items of equipment fails with and without pounding: glass", answer)
        for name in items:
            self.assertTrue((run.folder / f"equipment_{name}.png").exists(), name)
            self.assertTrue(f"Equipment: {name}" in page, name)
        both = program.must_do(self, "compare", run.folder, self.place / "joint-without", "--out", self.place / "both")
        self.assertRegex(both.stdout, r"relay.*NO.*yes")

    def test_refused(self):
        flat = self.file("flat", [(.1, 50.0), (1000, 50.0)])
        for more, words in (({"probe": "left_rof"}, ("-probes has no such name", "did you mean left_roof")),
                            ({"capacity": "nowhere.csv"}, ("nowhere.csv",)),
                            ({"capacity": self.file("turned", [(1, 2), (3, -4)])}, ("turned.csv:3", "not a frequency")),
                            ({"capacity": self.file("other", [(1000, 2), (3000, 4)])}, ("none of spectra_frequencies",)),
                            ({"damping": .02}, ("add it to -spectra_damping",)),
                            ({"band": "33,1"}, ("the first is the lower one",)),
                            ({"capacity": self.file("short", [(5, 2), (30, 4)]), "band": "1,33"}, ("has 5 to 30 Hz",))):
            with self.subTest(more):
                words_of = ["-options_file", str(two_buildings.SCENE), "-equipment", "relay"]
                for key, value in {"probe": "left_roof", "capacity": flat, "capacity_unit": "g", **more}.items():
                    words_of += [f"-relay_{key}", value]
                program.must_refuse(self, words_of, *words)


if __name__ == "__main__":
    unittest.main()
