"""What run/campaign asks of the program, takes from its results, and calls found or not found."""
import os
import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

import program

sys.path.insert(0, os.path.join(program.SOURCE, "run"))
sys.dont_write_bytecode = True
from parts.campaign import cases, findings, harvest, paper, records, results  # noqa: E402
from parts.campaign.results import Campaign, CaseResult  # noqa: E402

from pounding import UserError

FREQUENCY = np.geomspace(0.5, 400, 200)


def words_of(case):
    return dict(zip(case.words[::2], case.words[1::2]))


class Cases(unittest.TestCase):
    def test_twelve_cases_in_four_variants(self):
        every = cases.all_cases()
        self.assertEqual(len(every), 48)
        self.assertEqual(len({case.name for case in every}), 48)
        for name in {word for case in every for word in case.words if word.startswith("petsc-options/")}:
            self.assertTrue((Path(program.SOURCE) / name).is_file(), name)

    def test_gaps_of_the_paper(self):
        for case in cases.all_cases(motions=["Kobe"]):
            words = words_of(case)
            if case.variant == "A-apart":
                self.assertEqual(words["-contacts"], "none")
                continue
            lower, upper = ([float(value) for value in words[f"-{floor}_gap"].split(",")] for floor in
                            ("floor1", "floor2"))
            if case.variant == "A-symmetric":
                self.assertEqual((lower, upper), ([case.gap / 100], [case.gap / 100]))
            elif case.gap == 2:
                np.testing.assert_allclose(lower + upper, [0.021, 0.019, 0.025, 0.020], rtol=1e-12)

    def test_gaps_are_those_of_the_scenes_that_ship(self):
        for case in cases.all_cases(motions=["El Centro"], variants=["A", "B"]):
            prefix = "b-" if case.variant == "B" else ""
            path = Path(program.SOURCE) / f"petsc-options/azalee/{prefix}gap{case.gap}.yaml"
            text = path.read_text()
            for floor in ("floor1", "floor2"):
                stated = text.split(f'{floor}: {{gap: "')[1].split('"')[0]
                asked = words_of(case)[f"-{floor}_gap"]
                np.testing.assert_allclose(*[[float(v) for v in pair.split(",")] for pair in (asked, stated)])
            self.assertIn(f"pga: {case.pga:.10g},", text)

    def test_without_pounding_one_run_serves_all_gaps(self):
        every = cases.all_cases()
        runs = {case: cases.run_for(case, every) for case in every}
        self.assertEqual(len(set(runs.values())), 40)
        for case, run in runs.items():
            self.assertEqual((run.motion, run.variant), (case.motion, case.variant))
            self.assertTrue(case == run or not case.pounds)

    def test_extra_options_come_last_and_win(self):
        case = cases.make_case(2, "Kobe", "A", cases.QUICK, True, "full", ["-courant", "0.5"])
        self.assertEqual(case.words[-2:], ("-courant", "0.5"))


class Records(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="pounding-"))
        time = np.arange(3001) * 0.01
        burst = np.exp(-((time - 20) / 2) ** 2)
        self.values = [0.3 * burst * np.sin(9 * time), 0.2 * burst * np.sin(7 * time), 0.1 * burst]
        for name, values, count in zip(records.FILES["Kobe"], self.values, (3001, 2990, 3001)):
            path = self.folder / name
            path.parent.mkdir(exist_ok=True)
            rows = [" ".join(f"{v:.8E}" for v in values[i:min(i + 5, count)]) for i in range(0, count, 5)]
            path.write_text(f"A\nB\nC\nNPTS=  {count}, DT=  .0100 SEC,   \n" + "\n".join(rows) + "\n")

    def test_three_components_in_one_table_scaled_alike(self):
        record = records.load(self.folder, "Kobe", 60, self.folder / "kobe.csv")
        table = np.genfromtxt(record.table, delimiter=",", names=True)
        self.assertEqual(len(table), 2990)  # of the shortest component
        np.testing.assert_allclose(table["y"], 9.80665 * self.values[1][:2990], rtol=1e-6, atol=1e-9)
        words = record.words(2.0)
        words = dict(zip(words[::2], words[1::2]))
        self.assertEqual(words["-motion_z_column"], "4")
        self.assertEqual(words["-motion_x_scale"], words["-motion_z_scale"])
        self.assertAlmostEqual(float(words["-motion_x_scale"]) * abs(table["x"]).max(), 2.0, places=6)
        self.assertEqual(words["-motion_x_record"], str(record.table))

    def test_a_short_run_takes_the_strong_phase(self):
        record = records.load(self.folder, "Kobe", 4, self.folder / "kobe.csv")
        table = np.genfromtxt(record.table, delimiter=",", names=True)
        self.assertEqual((len(table), table["time"][0]), (401, 0))
        self.assertEqual(table["x"][0], 0)  # it sets in gently
        self.assertAlmostEqual(abs(table["x"]).max(), 9.80665 * abs(self.values[0]).max(), delta=1e-5)

    def test_what_is_no_record_is_refused(self):
        (self.folder / records.FILES["Kobe"][0]).write_text("nothing\n")
        with self.assertRaises(UserError):
            records.load(self.folder, "Kobe", 4, self.folder / "kobe.csv")


class Harvest(unittest.TestCase):
    def test_long_series_keep_their_peaks_and_the_interval_asked_for(self):
        time = np.arange(200000) * 1e-4
        values = np.sin(time)
        values[[12345, 150000]] = 9, -7
        kept_time, kept = harvest.extremes(time, values, [(5.0, 5.1)])
        self.assertLess(len(kept), 2 * harvest.BINS + 1100)
        self.assertEqual((kept.max(), kept.min()), (9, -7))
        self.assertEqual(((kept_time >= 5.0) & (kept_time < 5.1)).sum(), 1000)


def result(gap, variant, level=50.0, floor1=0, floor2=10, mode=1.0, wall_time=60.0):
    """A made-up result: a spectrum of `level` above 50 Hz, a peak of `mode` at 200 Hz on floor 1."""
    case = cases.make_case(gap, "Kobe", variant, cases.FULL, False, "full", [])
    roof = np.where(FREQUENCY < 50, 10.0, level)
    bump = 1 + (mode - 1) * np.exp(-(np.log(FREQUENCY / 200) / 0.05) ** 2)
    hits = [{"contact": floor, "impulse": 2.0, "contact_time": 3e-3, "left": 1.0, "bottom": 0.75}
            for floor, count in (("floor1", floor1), ("floor2", floor2)) for _ in range(count)]
    treated = {"complete": roof, "all_peaks": 1.05 * roof, "highest_peak": 0.95 * roof,
               "without_peaks": 0.1 * roof, "dirac": 0.95 * roof * np.maximum(1, FREQUENCY / 200)}
    summary = {"wall_time": wall_time, "end_time": 25.0}
    return CaseResult(case, case, summary, hits, FREQUENCY, {"s2_floor2.x": roof, "s1_floor1.x": 3 * bump},
                      treated if case.pounds else {}, [], {})


class Findings(unittest.TestCase):
    def verdicts(self, results):
        return {name: found == of for name, found, of in findings.totals(findings.check_all(Campaign(results)))}

    def test_all_are_found_where_they_hold(self):
        good = [result(gap, variant, **more) for gap, hits in ((5, 3), (2, 8), (0, 40)) for variant, more in (
            ("A", {"floor2": hits, "mode": 2.0, "wall_time": 200.0}), ("B", {"floor2": hits}),
            ("A-symmetric", {"level": 90.0}), ("A-apart", {"level": 4.0}))]
        verdicts = self.verdicts(good)
        self.assertEqual(len(verdicts), 13)
        self.assertTrue(all(verdicts.values()), verdicts)

    def test_none_is_found_where_they_do_not(self):
        bad = []
        for gap in (5, 2, 0):
            one = result(gap, "A", floor2=0, floor1=0)
            flat = one.treated["complete"]
            bad.append(replace(one, treated={**one.treated, "all_peaks": 2 * flat, "highest_peak": flat / 2,
                                             "dirac": flat / 2}))
            bad += [replace(result(gap, "B", floor2=0, mode=2.0, wall_time=300.0),
                            spectra={"s2_floor2.x": 2 * flat, "s1_floor1.x": result(gap, "B", mode=2.0)
                                     .spectra["s1_floor1.x"]}),
                    result(gap, "A-symmetric", level=40.0), result(gap, "A-apart", level=45.0)]
        verdicts = self.verdicts(bad)
        found = [name for name, verdict in verdicts.items() if verdict]
        self.assertEqual(found, ["floor 1 is hit in a few cases only"])
        hit = [result(gap, "A", floor1=2) for gap in (5, 2, 0)]
        self.assertFalse(self.verdicts(hit)["floor 1 is hit in a few cases only"])

    def test_departure_of_the_dirac(self):
        self.assertAlmostEqual(findings.departure(result(2, "A")), 220, delta=8)  # 1.1 x 200 Hz

    def test_impact_table(self):
        row = results.floor_row(result(2, "A", floor2=10), "floor2")
        self.assertEqual(row[2:], [10, 3.0, 3.0, 20.0, 2.0, 100.0, 75.0, 0])
        self.assertEqual(results.floor_row(result(2, "A"), "floor1")[2:4], [0, None])
        self.assertEqual(len(results.impact_rows([result(2, "A"), result(2, "A-apart")])), 2)


class Paper(unittest.TestCase):
    def test_table_3(self):
        self.assertEqual([list(paper.PGA[gap].values()) for gap in paper.GAPS],
                         [[0.45, 0.35, 0.20, 0.20], [0.20, 0.15, 0.10, 0.20], [0.15, 0.15, 0.10, 0.15]])


if __name__ == "__main__":
    unittest.main()
