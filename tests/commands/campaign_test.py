"""run/campaign on coarse meshes: the paper's findings hold in a reduced set of its cases, a second
call runs nothing, and the report shows every figure."""
import csv
import json
import os
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import program

sys.path.insert(0, os.path.join(program.SOURCE, "run"))
sys.dont_write_bytecode = True
from parts.campaign import cases, results  # noqa: E402

PROCESSORS = 2  # it starts runs

FIGURES = ("fig4_gaps", "fig5_drift_acceleration", "fig6_spectra", "fig7_treatments", "fig8_treated_spectra",
           "fig9_first_floor", "impact_places")
REDUCED = ("--quick", "--gaps", "2,0", "--motions", "Kobe", "--no-tables")


def campaign(*words):
    return program.command("campaign", *words, timeout=1400)


class Campaign(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-")
        cls.result = campaign(*REDUCED, "--output", cls.folder)
        with open(os.path.join(cls.folder, "findings.json")) as file:
            cls.checks = json.load(file)
        with open(os.path.join(cls.folder, "report.html"), encoding="utf-8") as file:
            cls.page = file.read()

    def found(self, finding, count):
        checks = [check for check in self.checks if check["finding"].startswith(finding)]
        self.assertEqual(len(checks), count, finding)
        for check in checks:
            self.assertTrue(check["found"], check)

    def test_ends_well(self):
        self.assertEqual(self.result.returncode, 0, self.result.stdout + self.result.stderr)
        # without pounding one run serves both gaps
        self.assertIn("7 runs, 0 finished before", self.result.stdout)
        self.assertIn("8 cases, 0 failed", self.result.stdout)
        self.assertRegex(self.result.stdout, r"\d/7  gap2-kobe-a: \d+ at floor1, \d+ at floor2; \d+ s; about .* left")

    def test_second_floor_is_hit_more_often_as_the_gap_shrinks(self):
        self.found("floor 2 is hit, Model A", 2)
        self.found("floor 2 is hit, Model B", 2)
        self.found("more impacts as the gap shrinks", 1)

    def test_the_branch_comes_from_pounding(self):
        self.found("without pounding no branch", 2)

    def test_symmetric_gaps_raise_the_branch(self):
        self.found("symmetric gaps raise the branch", 2)

    def test_the_branch_comes_from_the_peaks_and_mainly_from_the_highest(self):
        self.found("the branch is that of all peaks", 2)
        finding = "the branch is that of the highest peak alone"
        few, many = [check for check in self.checks if check["finding"] == finding]
        self.assertTrue(few["found"], few)
        # Of 40 impacts, one with a smaller impulse may be the sharper one: told, not asserted.
        self.assertIn("gap 0 cm", many["case"])

    def test_a_dirac_departs_at_high_frequencies(self):
        self.found("the Dirac departs upwards", 2)

    def test_slab_mode_shows_in_model_a_only(self):
        self.found("unhit floor 1, Model A: a peak near 200 Hz", 1)
        self.found("unhit floor 1, Model B: no peak near 200 Hz", 1)

    def test_models_agree_while_impacts_are_few(self):
        checks = [check for check in self.checks if check["finding"] == "Models A and B agree"]
        self.assertEqual(len(checks), 2)
        self.assertTrue(checks[0]["found"], checks[0])

    def test_durations_impulses_and_places_of_the_impacts(self):
        with open(os.path.join(self.folder, "gap2-kobe-a", "impacts.csv")) as file:
            hits = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.assertGreater(len(hits), 3)
        ends = set()
        for hit in hits:
            value = {name: float(text) for name, text in hit.items() if name != "contact"}
            self.assertGreater(value["contact_time"], 0)
            self.assertLessEqual(value["contact_time"], value["duration"] * (1 + 1e-12))
            for share in ("left", "bottom"):
                self.assertTrue(0 <= value[share] <= 1 + 1e-12)
            # the mean place lies in the half that took most of the impulse
            if value["left"] in (0, 1):
                self.assertEqual(value["lateral"] < 1.14, value["left"] == 1)
                ends.add(value["left"])
        self.assertTrue(ends, "no eccentric impact")

    def test_report_shows_figures_tables_and_findings(self):
        self.assertEqual(self.page.count("data:image/png;base64,"), len(FIGURES))
        for text in ("Findings of the paper", "NOT found" if not all(c["found"] for c in self.checks) else "found",
                     "Table 3", "Impacts by case and floor", "long period"):
            self.assertIn(text, self.page)
        for name in FIGURES:
            with open(os.path.join(self.folder, name + ".png"), "rb") as file:
                self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")

    def test_histories_are_not_kept(self):
        self.assertFalse(os.path.exists(os.path.join(self.folder, "gap2-kobe-a", "history.h5")))

    def test_goes_on_where_it_stopped(self):
        summary = os.path.join(self.folder, "gap2-kobe-a-apart", "summary.json")
        os.remove(summary)
        again = campaign(*REDUCED, "--output", self.folder)
        self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
        self.assertIn("7 runs, 6 finished before", again.stdout)
        self.assertTrue(os.path.exists(summary))
        # another request is another run
        other = campaign("--quick", "--gaps", "2", "--motions", "Kobe", "--variants", "A-apart", "--no-tables",
                         "--end-time", "0.1", "--output", self.folder)
        self.assertIn("1 runs, 0 finished before", other.stdout)
        self.assertEqual(other.returncode, 0, other.stdout + other.stderr)

    def test_a_multiple_of_a_run_is_what_its_own_run_gives(self):
        own = campaign(*REDUCED[:1], "--gaps", "0", *REDUCED[3:], "--variants", "A-apart", "--output", self.folder)
        self.assertIn("1 runs, 0 finished before", own.stdout)
        every = cases.all_cases(cases.QUICK, True, gaps=[2, 0], motions=["Kobe"], variants=["A-apart"])
        multiple, run = (results.load(every[1], one, Path(self.folder)) for one in every)
        self.assertEqual(multiple.run.gap, 2)
        for name, values in run.spectra.items():  # across the motion there is round-off only; nine digits each
            np.testing.assert_allclose(multiple.spectra[name], values, rtol=2e-8, atol=1e-9 * run.roof.min())
        for name, values in run.series.items():
            np.testing.assert_allclose(multiple.series[name], values, rtol=1e-9, atol=1e-9 * abs(values).max())


class Refusals(unittest.TestCase):
    def test_a_case_that_fails_is_told_and_the_others_are_run(self):
        with tempfile.TemporaryDirectory() as folder:
            result = campaign("--quick", "--gaps", "2", "--motions", "Kobe", "--variants", "A,B", "--no-tables",
                              "--end-time", "0.01", "--options", "-s1_slab_thickness 0.2", "--output", folder)
            # bricks have no thickness to give
            self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
            self.assertIn("2 cases, 1 failed", result.stdout)
            self.assertIn("gap2-kobe-a: pounding: ", result.stdout)

    def test_reduced_structures_share_their_bases(self):
        with tempfile.TemporaryDirectory() as folder:
            words = ["--quick", "--gaps", "2,0", "--motions", "Kobe", "--variants", "A,A-apart", "--no-tables",
                     "--end-time", "0.5", "--fidelity", "modal", "--output", folder]
            result = campaign(*words)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.assertEqual(sorted(os.listdir(os.path.join(folder, "bases"))),
                             ["a-apart-s1.h5", "a-apart-s2.h5", "a-s1.h5", "a-s2.h5"])
            for name in ("gap2-kobe-a", "gap2-kobe-a-apart"):
                with open(os.path.join(folder, name, "log.txt")) as file:
                    self.assertEqual(file.read().count("modal basis from"), 2)
            again = campaign(*words)
            self.assertIn("3 finished before", again.stdout)

    def test_words_that_make_no_sense(self):
        for words, expected in ((["--gaps", "3"], "none of 5, 2, 0"), (["--motions", "Loma"], "none of Cadarache"),
                                (["--variants", "C"], "none of A, B"), (["--jobs", "0"], "not above 0"),
                                (["--end-time", "-1"], "not above 0"), (["--fidelity", "coarse"], "full")):
            result = campaign(*words)
            self.assertNotEqual(result.returncode, 0)
            self.assertIn(expected, result.stderr)

    def test_a_folder_without_records(self):
        with tempfile.TemporaryDirectory() as folder:
            result = campaign("--quick", "--records", folder, "--output", folder)
            self.assertEqual(result.returncode, 1)
            self.assertIn("holds none of the records", result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
