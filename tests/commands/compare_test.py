"""run/compare on runs of two small buildings: tables that are those of the runs' own files, and refusals."""
import re
import shutil
import tempfile
import unittest
from pathlib import Path

import numpy as np

import program
import two_buildings


PROBES = "left_floor,left_roof"


class Compare(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = Path(tempfile.mkdtemp(prefix="pounding-"))
        cls.wide = two_buildings.run(cls.place / "wide", gap=0.06, probes=PROBES)
        cls.narrow = two_buildings.run(cls.place / "narrow", gap=0.01, probes=PROBES)
        cls.done = cls.compare("wide", "narrow")
        cls.out = cls.place / "wide-narrow"

    @classmethod
    def compare(cls, *names, out=None):
        folders = [cls.place / name for name in names]
        return program.command("compare", *folders, "--out", out or cls.place / "-".join(names))

    def refused(self, *names, parts, out=None):
        result = self.compare(*names, out=out)
        self.assertEqual(result.returncode, 1, result.stdout)
        line, = result.stderr.splitlines()
        for part in ("run/compare: ", *parts):
            self.assertIn(part, line)

    def test_spectra_and_ratios_are_those_of_the_runs(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        rows = program.rows_of(self.out / "spectra.csv")
        self.assertEqual(list(rows[0]), ["probe", "direction", "damping", "frequency", "PSA wide [m/s2]",
                                         "PSA narrow [m/s2]", "narrow / wide"])
        for probe in ("left_floor", "left_roof"):
            own = [row for row in rows if row["probe"] == probe and row["direction"] == "x"]
            frequency, wide = self.wide.spectrum(probe, "x")
            _, narrow = self.narrow.spectrum(probe, "x")
            for name, values, tolerance in (("frequency", frequency, 1e-5), ("PSA wide [m/s2]", wide, 1e-6),
                                            ("PSA narrow [m/s2]", narrow, 1e-6), ("narrow / wide", narrow / wide, 1e-5)):
                np.testing.assert_allclose([float(row[name]) for row in own], values, rtol=tolerance)
            self.assertFalse([row for row in rows if row["direction"] == "y"], "the ground moves along x only")
        self.assertGreater(max(float(row["narrow / wide"] or 0) for row in rows), 3)

    def test_impacts_are_those_of_the_catalogues(self):
        rows = {(row["contact"], row["run"]): row for row in program.rows_of(self.out / "impacts.csv")}
        own = self.narrow.impacts
        self.assertGreater(len(own["impulse"]), 0)
        for contact in ("floor1", "floor2", "all contacts"):
            mine = own["impulse"][(own["contact"] == contact) | (contact == "all contacts")]
            row = rows[contact, "narrow"]
            self.assertEqual(int(row["impacts"]), len(mine))
            self.assertAlmostEqual(float(row["total impulse [N s]"]), mine.sum(), delta=1e-6 * mine.sum())
            self.assertAlmostEqual(float(row["strongest impulse [N s]"]), max(mine, default=0), delta=1e-3)
            self.assertEqual(int(rows[contact, "wide"]["impacts"]), 0)

    def test_no_ratio_where_there_is_no_motion(self):
        peaks = {(row["probe"], row["direction"], row["peak"]): row for row in program.rows_of(self.out / "peaks.csv")}
        across = peaks["left_roof", "z", "acceleration [m/s2]"]
        self.assertEqual((float(across["wide"]), across["narrow / wide"]), (0.0, ""))
        along = peaks["left_roof", "x", "acceleration [m/s2]"]
        found = [run.summary["probes"]["left_roof"]["peak_acceleration"][0] for run in (self.wide, self.narrow)]
        self.assertAlmostEqual(float(along["narrow / wide"]), found[1] / found[0], delta=1e-6)

    def test_only_the_options_that_differ(self):
        rows = program.rows_of(self.out / "options.csv")
        self.assertEqual({row["option"]: (row["wide"], row["narrow"]) for row in rows},
                         {"floor1_gap": ("0.06", "0.01"), "floor2_gap": ("0.06", "0.01")})

    def test_page_holds_everything(self):
        page = (self.out / "comparison.html").read_text()
        self.assertEqual(page.count("<figure>"), 2)
        self.assertEqual(re.findall(r"""(?:src|href)\s*=\s*["'](?!data:|#)""", page), [])
        for word in ("floor2_gap", "Impacts", "Peaks", "left_roof"):
            self.assertIn(word, page)
        self.assertIn("floor2_gap", self.done.stdout)
        count = len(self.narrow.impacts["impulse"])
        opening = (f"The joint closes in 1 of 2 runs (wide: floor2 of 60 mm stays open with a margin of "
                   f"{self.wide.closing_factors()['floor2']:.3g} on the motion; narrow: floor2 of 10 mm closes, with {count} impacts "
                   "in all and no margin); one motion in one joint each gives no confidence.")
        self.assertTrue(self.done.stdout.startswith(opening), self.done.stdout[:300])
        second = f"narrow beside wide: {count} impacts in place of 0; the floor spectra (5 %) grow"
        self.assertLess(page.index(opening), page.index(second))
        self.assertLess(page.index(second), page.index("<nav>"))
        self.assertLess(page.index("<nav>"), page.index("<table"))
        rows = program.rows_of(self.out / "floor_spectra.csv")
        self.assertTrue(rows)
        for row in rows:
            self.assertEqual(float(row["PSA envelope [m/s2]"]), max(float(row[f"PSA {run} [m/s2]"]) for run in ("wide", "narrow")))

    def test_three_runs_and_another_number_of_ranks(self):
        two_buildings.run(self.place / "alone", 2, gap=0.01, probes="left_roof")
        result = self.compare("narrow", "alone", "wide")
        self.assertEqual(result.returncode, 0, result.stderr)
        folder = self.place / "narrow-alone-wide"
        rows = program.rows_of(folder / "spectra.csv")
        ratios = [float(row["alone / narrow"]) for row in rows if row["alone / narrow"]]
        self.assertLess(max(abs(ratio - 1) for ratio in ratios), 1e-4)
        self.assertEqual([row["alone"] for row in program.rows_of(folder / "options.csv")
                          if row["option"] == "(number of ranks)"], ["2"])

    def test_probes_that_are_not_common_are_told(self):
        two_buildings.run(self.place / "roofs", gap=0.01, probes="left_roof,right_roof")
        two_buildings.run(self.place / "floor", end_time=0.1, gap=0.01, probes="left_floor")
        result = self.compare("narrow", "roofs")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("probes of narrow that are not in every run, left out: left_floor; common are left_roof",
                      result.stdout)
        self.refused("roofs", "floor", parts=("no probe that all runs have", "floor has left_floor"))

    def test_unlike_spectra_are_refused(self):
        two_buildings.run(self.place / "coarse", end_time=0.1, spectra_frequencies="1:100:20log")
        two_buildings.run(self.place / "damped", end_time=0.1, spectra_damping=0.02)
        self.refused("wide", "coarse", parts=("unlike frequencies", "20 from 1 to 100 Hz", "-spectra_frequencies"))
        self.refused("wide", "damped", parts=("no damping ratio", "damped has 2 %"))

    def test_folders_that_are_no_two_runs_are_refused(self):
        self.refused("wide", "nowhere", parts=("nowhere is not a folder",))
        (self.place / "empty").mkdir()
        self.refused("wide", "empty", parts=("empty holds no results",))
        self.refused("wide", "wide", parts=("the same folder twice",))
        shutil.copytree(self.place / "wide", self.place / "killed")
        (self.place / "killed" / "summary.json").unlink()
        self.refused("wide", "killed", parts=("killed", "did not reach its end"))
        self.refused("wide", "narrow", parts=("is one of the runs",), out=self.place / "wide")
        self.assertEqual(self.compare("wide").returncode, 2)


if __name__ == "__main__":
    unittest.main()
