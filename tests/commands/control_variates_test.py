"""Numbers at full order with reduced runs as control variates: closed problem, plan, and a study that finds its samples."""
import json
import os
import sys
import unittest

import h5py
import numpy as np
import program
from scipy import stats
from study_command import STUDY, StudyCommand

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
sys.dont_write_bytecode = True
from pounding.fragility import control_variates as control, outcomes  # noqa: E402

PROCESSORS = 2  # it starts runs
DEVIATION, RATIO, BOTH, TIMES = 0.4, 20, 30, 3000 if os.environ.get("POUNDING_ALL") else 1000


def drawn(generator, count, rho):
    """Lognormal values of two models whose logarithms are correlated by rho; those of the cheap one are a tenth too large."""
    full = generator.standard_normal(count)
    cheap = rho * full + np.sqrt(1 - rho**2) * generator.standard_normal(count)
    return np.exp(DEVIATION * full), 1.1 * np.exp(DEVIATION * cheap)


class ClosedProblem(unittest.TestCase):
    TRUE = {"mean": np.exp(DEVIATION**2 / 2), "probability": stats.norm.sf(np.log(1.3) / DEVIATION),
            "quantile": np.exp(DEVIATION * stats.norm.ppf(0.84))}

    def found(self, rho, pilot):
        generator, values = np.random.default_rng(3), {name: [] for name in self.TRUE}
        more = int(BOTH * np.sqrt(RATIO * rho**2 / (1 - rho**2))) - BOTH
        for _ in range(TIMES):
            draws = control.Draws(*drawn(generator, BOTH, rho), drawn(generator, more, rho)[1], drawn(generator, 10, rho) if pilot else None, RATIO)
            above = control.Draws(*((values > limit).astype(float) for values, limit in ((draws.full, 1.3), (draws.cheap, 1.43), (draws.more, 1.43))),
                                  pilot and tuple((values > limit).astype(float) for values, limit in zip(draws.pilot, (1.3, 1.43))), RATIO)
            for name, one in (("mean", control.mean(draws)), ("probability", control.probability(above)),
                              ("quantile", control.quantile(draws, 0.84))):
                values[name].append([one.value, one.low, one.high, one.gain])
        return {name: np.array(rows, float).T for name, rows in values.items()}, BOTH + (BOTH + more) / RATIO

    def test_intervals_hold_as_often_as_they_say_and_means_have_no_bias(self):
        for pilot in (True, False):
            found, equal = self.found(0.95, pilot)
            for name, (value, low, high, gain) in found.items():
                with self.subTest(name, pilot=pilot):
                    held = np.mean(~((low > self.TRUE[name]) | (high < self.TRUE[name])))
                    self.assertTrue(0.93 <= held <= 0.975, held)
                    if name == "quantile":  # of 30 values: no bias is asked of it
                        continue
                    self.assertLess(abs(value.mean() - self.TRUE[name]), 3.5 * value.std() / TIMES**0.5)
                    alone = {"mean": self.TRUE["mean"] ** 2 * np.expm1(DEVIATION**2),
                             "probability": self.TRUE["probability"] * (1 - self.TRUE["probability"])}[name]
                    self.assertLess(abs(np.median(gain) / (alone / equal / value.var()) - 1), 0.2)
            self.assertGreater(np.median(found["mean"][3]), 2.9)  # 3.1 of logarithms that are correlated by .95

    def test_indicators_of_normals(self):
        for rho, expected in ((0.95, 0.77), (0.98, 0.855), (0.99, 0.9), (0.0, 0.0)):
            self.assertAlmostEqual(float(control.exceeding_together(0.84, np.array(rho))), expected, delta=3e-3)
        self.assertAlmostEqual(float(control.exceeding_together(0.5, np.array(0.5))), 1 / 3, delta=1e-12)  # 2 asin(rho) / pi

    def test_plan_is_the_cheapest_pair_of_whole_numbers(self):
        cov, rho = np.array([0.4, 0.3]), np.array([0.95, 0.8])

        def reached(m, total):
            return (stats.t.ppf(0.975, max(m - 2, 1)) * cov * np.sqrt((1 - rho**2) / m + rho**2 / total)).max()

        found = control.plan(cov, rho, 20, 0.1, 400)
        pairs = [(m + total / 20, m, total) for m in range(4, 60) for total in range(m + 2, 400) if reached(m, total) <= 0.1]
        self.assertEqual((found.both, found.cheap), min(pairs)[1:])
        self.assertAlmostEqual(found.reached, reached(found.both, found.cheap))
        self.assertLessEqual(found.reached, 0.1)
        short = control.plan(cov, rho, 20, 0.1, 40)
        self.assertEqual(short.cheap, 40)
        self.assertAlmostEqual(short.reached, reached(short.both, 40))
        self.assertGreater(short.reached, 0.1)


class BothOrders(StudyCommand):
    ASKED = {"soils": None, "states": None, "samples": 20, "show": {"frequencies": "2,10"}, "full_order": {"accuracy": 0.7, "pilot": 4},
             "options": {**STUDY["options"], "end_time": 0.3},
             "motions": {"correlation": 0.9, "x": {**STUDY["motions"]["x"], "seeds": list(range(1, 21))}}}

    def test_numbers_are_those_of_the_formula(self):
        done = self.fragility(**self.ASKED)
        out = self.place / "out"
        [plan] = out.glob("runs/*/*-plan.json")
        numbers = json.loads(plan.read_text())
        self.assertEqual(numbers["pilot"], 4)
        self.assertIn(f"{numbers['both']} samples at both orders", done.stdout)
        members = program.rows_of(out / "members.csv")
        self.assertEqual(len(members), 2 * numbers["count"])
        rows = {row["quantity"]: row for row in program.rows_of(out / "both_orders.csv") if row["gap [m]"] != "apart"}
        row = rows["mean of left_roof x, 2 Hz [m/s2]"]
        files = list(out.glob("runs/*/ensemble-*/ensemble.h5"))
        dear, cheap = (self.spectra_of([file for file in files if (plan.parent in file.parents) is is_dear], members)
                       for is_dear in (True, False))
        first, end = numbers["pilot"], numbers["pilot"] + numbers["both"]
        y, x = np.array([dear[k] for k in range(end)]), np.array([cheap[k] for k in range(numbers["count"])])
        a = np.cov(x[:first], y[:first])[0, 1] / np.var(x[:first], ddof=1) * (len(x) - end) / (len(x) - first)
        value = y[first:end].mean() - a * (x[first:end].mean() - x[end:].mean())
        self.assertAlmostEqual(float(row["value"]) / value, 1, delta=1e-6)
        self.assertAlmostEqual(float(row["full order alone"]) / y[first:end].mean(), 1, delta=1e-6)
        table = [one for one in program.rows_of(out / "spectra" / "full-order_gap-0.01_pga-4.csv")
                 if one["channel"] == "left_roof x" and one["frequency"] == "2"]
        self.assertAlmostEqual(float(table[0]["mean"]) / value, 1, delta=1e-5)
        if not os.environ.get("POUNDING_ALL"):
            return
        before = (out / "both_orders.csv").read_bytes()
        self.assertNotIn("runs at full order", self.fragility("--collect", **self.ASKED).stdout)
        self.assertEqual((out / "both_orders.csv").read_bytes(), before)

    @staticmethod
    def spectra_of(files, members):
        """Of each sample, by number, the spectrum at 2 Hz in the joint, from files of members; rows are told apart by their texts."""
        found = {}
        seeds = list(dict.fromkeys(row["sample"] for row in members))
        for path in files:
            columns, rows = outcomes.read_rows(path)
            import h5py
            with h5py.File(path, "r") as file:
                for values, index in rows.items():
                    texts = dict(zip(columns, values))
                    if float(texts["floor1_gap"]) < 0.02:
                        place = list(file["spectra/frequency"][()]).index(2)
                        found[seeds.index(str(int(texts["motion_x_seed"]) - 1))] = file["spectra/pseudo_acceleration"][index, 0, 0, place]
        return found

    def test_wrong_use_is_told_in_one_line(self):
        for full, words in (({"accuracy": 0.1, "share": 0.1}, "accuracy: 0.1 goes without share"),
                            ({"samples": 8, "pilot": 4}, "pilot: 4 goes with accuracy"),
                            ({"samples": 3}, "samples: 3 is not a whole number from 8 on"),
                            ({"samples": 19}, "full_order: samples: 19 leave of the study's 20 no two"),
                            ({"accuracy": 0.1, "pilot": 18}, "accuracy: needs 24 samples or more"),
                            ({"accuracy": 5}, "accuracy: 5 is not below 1")):
            with self.subTest(words):
                self.must_be_refused(words, **{**self.ASKED, "full_order": full})
        self.must_be_refused("accuracy: chooses the samples of one soil and state", **{**self.ASKED, "soils": {"best": {}}})


if __name__ == "__main__":
    unittest.main()
