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

DEVIATION, RATIO, BOTH, TIMES = 0.4, 20, 30, 3000 if os.environ.get("POUNDING_ALL") else 1000


def drawn(generator, counts, rhos):
    """Lognormal values of models, so many draws of each, those of one before among them; logarithms of the cheap ones are correlated with
    those of the first by rhos, and their values are a tenth too large."""
    full = generator.standard_normal(counts[-1])
    values = [np.exp(DEVIATION * full[:counts[0]])]
    for count, rho in zip(counts[1:], rhos):
        values.append(1.1 * np.exp(DEVIATION * (rho * full + np.sqrt(1 - rho**2) * generator.standard_normal(counts[-1]))[:count]))
    return values


class ClosedProblem(unittest.TestCase):
    TRUE = {"mean": np.exp(DEVIATION**2 / 2), "probability": stats.norm.sf(np.log(1.3) / DEVIATION),
            "quantile": np.exp(DEVIATION * stats.norm.ppf(0.84))}

    def found(self, counts, rhos, costs, pilot):
        generator, values = np.random.default_rng(3), {name: [] for name in self.TRUE}
        for _ in range(TIMES):
            draws = control.Draws(drawn(generator, counts, rhos), drawn(generator, [10] * len(counts), rhos) if pilot else None, costs)
            above = control.Draws(*([(one > limit).astype(float) for one, limit in zip(some, [1.3] + [1.43] * len(rhos))] if some else None
                                    for some in (draws.values, draws.pilot)), costs)
            for name, one in (("mean", control.mean(draws)), ("probability", control.probability(above)),
                              ("quantile", control.quantile(draws, 0.84))):
                values[name].append([one.value, one.low, one.high, one.gain])
        return {name: np.array(rows, float).T for name, rows in values.items()}, draws.equal

    def check(self, counts, rhos, costs, least, pilots):
        """Intervals hold as often as they say, means have no bias, gains are true, that of the mean at least so much; slopes by a pilot or not."""
        for pilot in pilots:
            found, equal = self.found(counts, rhos, costs, pilot)
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
            self.assertGreater(np.median(found["mean"][3]), least)

    def test_two_models(self):
        rho = 0.95
        self.check([BOTH, int(BOTH * np.sqrt(RATIO * rho**2 / (1 - rho**2)))], [rho], [RATIO, 1], 2.9, (True, False))  # 3.1 of their logarithms

    def test_a_model_between_gains_more(self):
        self.check([BOTH, 120, 600], [0.99, 0.9], [20, 2, 0.2], 4.5, (True, False)[:1 + bool(os.environ.get("POUNDING_ALL"))])

    def test_draws_that_all_hit(self):
        """Models that never differ may do so as often as eight draws allow: 1 - .025^(1/8), as for counts."""
        found = control.probability(control.Draws([np.ones((8, 1)), np.ones((40, 1))], None, [20, 1]))
        self.assertAlmostEqual(found.low[0], 0.025 ** (1 / 8), delta=1e-12)
        self.assertEqual(found.high[0], 1)

    def test_indicators_of_normals(self):
        for rho, expected in ((0.95, 0.77), (0.98, 0.855), (0.99, 0.9), (0.0, 0.0)):
            self.assertAlmostEqual(float(control.exceeding_together(0.84, np.array(rho))), expected, delta=3e-3)
        self.assertAlmostEqual(float(control.exceeding_together(0.5, np.array(0.5))), 1 / 3, delta=1e-12)  # 2 asin(rho) / pi

    def test_plan_is_the_cheapest_pair_of_whole_numbers(self):
        cov, rho = np.array([0.4, 0.3]), np.array([0.95, 0.8])

        def reached(m, total):
            return (stats.t.ppf(0.975, max(m - 2, 1)) * cov * np.sqrt((1 - rho**2) / m + rho**2 / total)).max()

        found = control.plan(cov, rho, [20, 1], 0.1, 400)
        pairs = [(m + total / 20, m, total) for m in range(4, 60) for total in range(m + 2, 400) if reached(m, total) <= 0.1]
        self.assertEqual(tuple(found.counts), min(pairs)[1:])
        self.assertAlmostEqual(found.reached, reached(*found.counts))
        self.assertLessEqual(found.reached, 0.1)
        short = control.plan(cov, rho, [20, 1], 0.1, 40)
        self.assertEqual(short.counts[1], 40)
        self.assertAlmostEqual(short.reached, reached(*short.counts))
        self.assertGreater(short.reached, 0.1)

    def test_plan_takes_a_model_between_where_it_pays(self):
        cov, rho = np.array([0.4]), np.array([[0.99], [0.9]])
        costs = np.array([20, 2, 0.2])
        found = control.plan(cov, rho, costs, 0.05, 2000)
        m, between, total = found.counts
        variance = 1 / m - (1 / m - 1 / between) * 0.99**2 - (1 / between - 1 / total) * 0.9**2
        self.assertAlmostEqual(found.reached, stats.t.ppf(0.975, m - 2) * 0.4 * np.sqrt(variance))
        self.assertLessEqual(found.reached, 0.05)
        without = [control.plan(cov, rho[one:one + 1], costs[[0, one + 1]], 0.05, 2000).counts @ costs[[0, one + 1]] for one in (0, 1)]
        self.assertLess(found.counts @ costs, 0.9 * min(without))
        self.assertEqual(control.plan(cov, rho[[1, 1]], costs, 0.05, 2000).counts[1], 0)  # as good as the cheapest, ten times its price


class BothOrders(StudyCommand):
    ASKED = {"soils": None, "states": None, "samples": 20, "show": {"frequencies": "2,10"}, "full_order": {"accuracy": 0.7, "pilot": 4},
             "options": {**STUDY["options"], "end_time": 0.3},
             "motions": {"correlation": 0.9, "x": {**STUDY["motions"]["x"], "seeds": list(range(1, 21))}}}
    STATES = {"sound": {}, "cracked": {"left": {"columns": {"stiffness_factor": 0.5}}}}

    def test_each_state_has_numbers_of_its_own_and_the_largest_are_shown(self):
        """Numbers are those of the formula, by three orders where that pays (measured costs decide); envelope and submittal have the largest."""
        asked = {**self.ASKED, "states": self.STATES, "submittal": {},
                 "full_order": {"accuracy": 0.7, "pilot": 4, "between": {"m12": {"left": {"modal_vectors": 12}}}}}
        done = self.fragility(**asked)
        out = self.place / "out"
        self.assertEqual(done.stdout.count("pilot of 4 samples at 3 orders"), 2)
        alone = {state: self.check_condition(out / "conditions" / state, done.stdout) for state in self.STATES}
        for row in program.rows_of(out / "both_orders.csv"):
            if row["gap [m]"] == "apart" and row["quantity"].startswith("joint"):
                with self.subTest(row["quantity"]):
                    largest = max(alone, key=lambda state: float(alone[state][row["quantity"]]["value"]))
                    self.assertEqual((row["state"], row["value"]), (largest, alone[largest][row["quantity"]]["value"]))
        self.assertIn("At full order, with the reduced runs as controls, that joint must be as wide as", (out / "submittal.html").read_text())
        if os.environ.get("POUNDING_ALL"):
            before = (out / "both_orders.csv").read_bytes()
            self.assertNotIn("runs at full order", self.fragility("--collect", **asked).stdout)
            self.assertEqual((out / "both_orders.csv").read_bytes(), before)

    def check_condition(self, out, said):
        """Rows of both_orders.csv by their quantity, those apart before others."""
        [plan] = out.glob("runs/*/*-plan.json")
        numbers = json.loads(plan.read_text())
        costs = json.loads((plan.parent / "costs.json").read_text())
        self.assertEqual(sorted(costs), ["full", "m12", "reduced"])
        first, counts = numbers["pilot"], numbers["counts"]
        self.assertEqual(first, 4)
        self.assertIn(f"{counts['full']} samples at full order", said)
        members = program.rows_of(out / "members.csv")
        self.assertEqual(len(members), 2 * (first + counts["reduced"]))
        found = {order: np.array(list(dict(sorted(self.spectra_of(out, order, members).items())).values())) for order in costs}
        y, m = found["full"][:first + counts["full"]], counts["full"]
        value = y[first:].mean()
        for order, count in list(counts.items())[1:]:
            x = found[order][:first + count]
            a = np.cov(x[:first], y[:first])[0, 1] / np.var(x[:first], ddof=1) * (count - m) / count
            value -= a * (x[first:first + m].mean() - x[first + m:].mean())
            m = count
        rows = sorted(program.rows_of(out / "both_orders.csv"), key=lambda row: row["gap [m]"] == "apart")
        row = next(row for row in rows if row["quantity"] == "mean of left_roof x, 2 Hz [m/s2]")
        self.assertAlmostEqual(float(row["value"]) / value, 1, delta=1e-6)
        self.assertAlmostEqual(float(row["full order alone"]) / y[first:].mean(), 1, delta=1e-6)
        table = [one for one in program.rows_of(out / "spectra" / "full-order_gap-0.01_pga-4.csv")
                 if one["channel"] == "left_roof x" and one["frequency"] == "2"]
        self.assertAlmostEqual(float(table[0]["mean"]) / value, 1, delta=1e-5)
        return {row["quantity"]: row for row in rows}

    @staticmethod
    def spectra_of(out, order, members):
        """Of each sample, by number, the spectrum at 2 Hz in the joint, from files of members of an order; rows are told apart by their texts."""
        found = {}
        seeds = list(dict.fromkeys(row["sample"] for row in members))
        for scene in out.glob("runs/*/scene.yaml"):
            words = scene.read_text()
            if order != ("full" if "modal" not in words else "m12" if "left-m12.basis" in words else "reduced"):
                continue
            for path in scene.parent.glob("ensemble-*/ensemble.h5"):
                columns, rows = outcomes.read_rows(path)
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
                            ({"accuracy": 5}, "accuracy: 5 is not below 1"),
                            ({"samples": 8, "between": {"m4": {}}}, "between: {'m4': {}} goes with accuracy"),
                            ({"accuracy": 0.1, "between": {"full": {}}}, "has the name 'full'"),
                            ({"accuracy": 0.1, "between": ["m4"]}, "is no list of named options")):
            with self.subTest(words):
                self.must_be_refused(words, **{**self.ASKED, "full_order": full})


if __name__ == "__main__":
    unittest.main()
