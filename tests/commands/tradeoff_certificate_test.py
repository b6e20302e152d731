"""run/tradeoff --scene --target: what it says of its own error holds, on ladders that are made up and on a scene."""
import csv
import json
import os
import sys
import tempfile
import unittest

import numpy as np

import program
import two_buildings
from two_buildings import pounding

sys.path.insert(0, os.path.join(program.SOURCE, "run"))
from parts.tradeoff import certificate, climb, estimate, ladder  # noqa: E402


def made_up_ladder(random, rungs, shrink, noise):
    """Errors of rungs as vectors, each a random direction of its own and `shrink` times the one before, with noise of
    this rms on all of them: distances of the first `rungs`, and their true errors."""
    errors = [0.3 * shrink**k * random.standard_normal(200) for k in range(rungs)]
    errors = [error + noise * random.standard_normal(200) for error in errors]
    rms = lambda values: float(np.sqrt((values**2).mean()))  # noqa: E731
    return [[rms(a - b) for b in errors] for a in errors], [rms(error) for error in errors]


class Estimates(unittest.TestCase):
    """Told from neighbours alone, of ladders whose truth is known."""

    def test_within_a_factor_of_two(self):
        random = np.random.default_rng(1)
        ratios = []
        for _ in range(200):
            noise = 10**random.uniform(-4, -2)
            distances, true = made_up_ladder(random, random.integers(3, 7), random.uniform(0.2, 0.8), noise)
            told = estimate.estimates(distances, noise)
            ratios.append([one.error / error for one, error in zip(told, true)])
        confirmed = np.concatenate([one[:-1] for one in ratios])
        self.assertGreater(np.mean((confirmed >= 0.5) & (confirmed <= 2)), 0.9)
        self.assertGreater(min(map(min, ratios)), 1 / 3)

    def test_a_lucky_step_makes_no_answer_exact(self):
        """The last two rungs agree by chance: the finest is still held to lack something, no less than the floor."""
        told = estimate.estimates([[0, 0.2, 0.2], [0.2, 0, 0.01], [0.2, 0.01, 0]], 0.02)
        self.assertGreaterEqual(told[2].error, 0.02)
        self.assertTrue(told[2].at_floor)
        self.assertGreaterEqual(estimate.estimates([[0, 0.2, 0.2], [0.2, 0, 0.01], [0.2, 0.01, 0]], 0)[2].error, 0.01)

    def test_full_order_lacks_nothing(self):
        told = estimate.estimates([[0, 0.2, 0.3], [0.2, 0, 0.1], [0.3, 0.1, 0]], 0.001, full=True)
        self.assertEqual([one.error for one in told], [0.3, 0.1, 0])

    def test_a_ladder_that_does_not_shrink_is_told(self):
        self.assertFalse(estimate.shrank([[0, 0.1, 0.3], [0.1, 0, 0.2], [0.3, 0.2, 0]]))
        self.assertTrue(estimate.shrank([[0, 0.2, 0.3], [0.2, 0, 0.1], [0.3, 0.1, 0]]))
        self.assertFalse(estimate.shrank([[0, 0.2], [0.2, 0]]))


class Disturbances(unittest.TestCase):
    def test_shaking_and_gaps(self):
        options = {"motion_x_target": "ground.csv", "motion_x_pga": "4", "motion_y_record": "a.AT2",
                   "motion_y_pga": "0", "motion_y_scale": "2", "motion_z_record": "none", "contacts": "roof,low",
                   "roof_gap": "0.02,0.03", "low_gap": "geometry"}
        found = {name: dict(changes) for name, _, changes in ladder.disturbances(options)}
        self.assertEqual(found["shaking"], {"motion_x_pga": "4.004", "motion_y_scale": "2.002"})
        self.assertEqual(found["gaps"], {"roof_gap": "0.02001,0.03001"})


class MadeUpRun:
    """What a run of a made-up ladder left: its spectra are one number, the error."""

    def __init__(self, cost, step, error):
        self.cost, self.error = cost, error
        self.summary = {"time_step": step, "end_time": 10.0, "impacts": {"episodes": 1}}

    def per_second(self):
        return self.cost


class MadeUpClimb:
    """A ladder whose costs [s/s], steps [s] and errors are given: {rung: (cost, step, error)}. With a step `factor`
    times as long a rung costs so much less and has `spoilt` times the factor more error."""

    def __init__(self, ladder_of, spoilt):
        self.ladder_of, self.spoilt, self.runs = ladder_of, spoilt, []

    def facts(self):
        cost, step, _ = self.ladder_of["full"]
        return climb.Facts(("left", "right"), 10000, step, cost, {}, "key")

    def run(self, setting, _window, must=False):
        name, _, factor = setting.name.partition("-step-")
        if name.removesuffix("-half-step") not in self.ladder_of:
            return None
        cost, step, error = self.ladder_of[name.removesuffix("-half-step")]
        self.runs.append(setting.name)
        if not factor:
            return MadeUpRun(cost, step, error)
        longer = float(factor) * self.ladder_of["full"][1]
        return MadeUpRun(cost * step / longer, longer, np.hypot(error, self.spoilt * float(factor)))

    def place(self, setting, _window):
        return setting.name

    def compare_moving(self, _outcome):
        pass

    def distance(self, one, other):
        return dict.fromkeys(climb.BAND_NAMES, float(np.sqrt(abs(one.error**2 - other.error**2))))

    def distances(self, climbed):
        pairs = [[self.distance(one.outcome, other.outcome) for other in climbed] for one in climbed]
        return {band: [[pair[band] for pair in row] for row in pairs] for band in climb.BAND_NAMES}

    def noise_floor(self, *_words):
        return {"0.1 % more shaking": dict.fromkeys(climb.BAND_NAMES, 0.001)}


class Choice(unittest.TestCase):
    """The fastest setting within the target, on ladders whose truth is known, with full order and without."""

    STEP = 1e-4
    LADDER = {"modal-25": (0.1, STEP, 0.5), "modal-50": (0.2, STEP, 0.3), "modal-100": (0.4, STEP, 0.04),
              "modal-200": (0.8, STEP, 0.01), "modal-400": (1.6, STEP, 0.002), "modal-800": (3.2, STEP, 0.001),
              "full": (10.0, STEP, 0.0)}

    def certified(self, target, spoilt=1.0, budget=1e9, **changes):
        made_up = MadeUpClimb({**self.LADDER, **changes}, spoilt)
        return certificate.certify(made_up, target, 5.0, budget), made_up

    def test_a_rung_in_the_middle_where_full_order_fits_the_budget(self):
        found, made_up = self.certified(0.05)
        self.assertEqual(found.setting.name, "modal-100")
        self.assertTrue(found.full and found.reached)
        self.assertAlmostEqual(found.beside_full_order(), 0.04)
        self.assertNotIn("modal-800", made_up.runs)

    def test_a_finer_rung_wins_by_the_longer_step_that_its_error_leaves_room_for(self):
        tight = {"modal-100": (0.4, self.STEP, 0.048)}
        found, _ = self.certified(0.05, spoilt=0.005, **tight)  # eight times the step spoils by 4 %
        self.assertEqual(found.setting.name, "modal-200-step-8")
        self.assertAlmostEqual(found.outcome.cost, 0.1)
        self.assertAlmostEqual(found.beside_full_order(), np.hypot(0.01, 0.04))

    def test_none_of_the_rungs_is_faster_than_a_cheap_full_order(self):
        found, made_up = self.certified(0.05, full=(0.3, self.STEP, 0.0))
        self.assertEqual(found.setting.name, "full")
        self.assertIn("modal-100", made_up.runs)  # it might have been faster with a longer step
        found, made_up = self.certified(0.05, full=(0.005, self.STEP, 0.0))
        self.assertEqual(found.setting.name, "full")
        self.assertNotIn("modal-50", made_up.runs)

    def test_full_order_with_a_longer_step_counts_too(self):
        found, _ = self.certified(0.05, spoilt=0.005, **{f"modal-{n}": (5.0 * n, self.STEP, 0.5) for n in
                                                         (25, 50, 100, 200, 400, 800)})
        self.assertEqual(found.setting.name, "full-step-8")
        self.assertTrue(found.reached)

    def test_without_full_order(self):
        found, made_up = self.certified(0.05, budget=0)
        self.assertEqual(found.setting.name, "modal-100")
        self.assertFalse(found.full)
        self.assertNotIn("full", made_up.runs[1:])
        found, _ = self.certified(0.0001, budget=0)
        self.assertFalse(found.reached)


class OwnScene(unittest.TestCase):
    """A second of the two small buildings, with the true errors beside the estimated ones."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-")
        cls.scene = two_buildings.own_scene(cls.folder)
        cls.out = os.path.join(cls.folder, "study")
        cls.words = ["tradeoff", "--scene", cls.scene, "--target", "0.9", "--output", cls.out]
        cls.done = program.command(*cls.words, "--check")
        cls.found = cls.certificate()

    @classmethod
    def certificate(cls):
        try:
            with open(os.path.join(cls.out, "certificate.json")) as file:
                return json.load(file)
        except FileNotFoundError:
            return {}

    def rows(self):
        with open(os.path.join(self.out, "ladder.csv"), newline="") as file:
            return list(csv.DictReader(file))

    def test_the_estimate_holds(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr + self.done.stdout)
        self.assertTrue(self.found["reached"])
        self.assertFalse(self.found["measured"])
        self.assertTrue(self.found["confirmed"])
        ratios = [float(row["error 1-400"]) / float(row["true 1-400"]) for row in self.rows()]
        self.assertGreater(min(ratios), 1 / 3)
        for ratio in ratios[:-1]:  # all but the finest rung, which no other one confirms
            self.assertGreater(ratio, 0.5)
            self.assertLess(ratio, 2)

    def test_the_true_error_is_that_of_the_spectra(self):
        row = self.rows()[0]
        runs = [pounding.load(os.path.join(self.out, "whole", name)) for name in (row["rung"], "full")] \
            if self.found["window"] == self.found["end_time"] else None
        self.assertIsNotNone(runs, "the scene ends soon after its strongest impact: the window is all of it")
        squares = []
        for way in "xyz":
            (frequency, one), (_, full) = (run.spectrum("left_roof", way) for run in runs)
            if full.max() > 1e-3 * max(runs[1].spectrum("left_roof", axis)[1].max() for axis in "xyz"):
                squares.append(np.mean(np.log(one / full)[(frequency >= 1) & (frequency <= 400.1)]**2))
        self.assertAlmostEqual(float(row["true 1-400"]) / np.sqrt(np.mean(squares)), 1, delta=0.01)

    def test_the_program_takes_it(self):
        words = ["-options_file", self.scene, "-fidelity_table", os.path.join(self.out, "fidelity.csv"),
                 "-fidelity_target", 0.9, "-end_time", 0.01]
        summary = program.must_run(self, words, 2)[1]
        within = [row["rung"].removeprefix("modal-") for row in self.rows() if float(row["error 1-400"]) <= 0.9]
        self.assertIn(summary["options"]["left_modal_vectors"], within)  # the fastest of them: their times are close

    def test_with_full_order_it_is_measured(self):
        done = program.must_do(self, *self.words)
        measured = self.certificate()
        self.assertTrue(measured["measured"])
        self.assertLessEqual(measured["error"]["1-400"], 0.9)
        self.assertIn("told by full order itself", done.stdout)
        within = [float(row["seconds per second"]) for row in self.rows() if float(row["error 1-400"]) <= 0.9]
        self.assertGreater(len(within), 1)  # rungs beside full order
        self.assertLessEqual(measured["seconds_per_second"], min(within) * (1 + 1e-9))

    def test_mistakes_are_one_line(self):
        for words, part in ((("--target", "0.1"), "--scene"), (("--scene", self.scene, "--target", "0"), "--target"),
                            (("--scene", self.scene, "--check"), "--target"),
                            (("--scene", self.scene, "--target", "0.1", "--finer", "mesh"), "NAME=VALUE")):
            done = program.command("tradeoff", *words)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(part, done.stderr)
        reduced = os.path.join(self.folder, "reduced.yaml")
        with open(reduced, "w") as file:
            file.write(f"include: {self.scene}\nleft: {{model: modal, modal_vectors: 10}}\n")
        done = program.command("tradeoff", "--scene", reduced, "--target", "0.1", "--output", self.out + "-reduced")
        self.assertEqual(done.returncode, 1)
        self.assertIn("reduced already", done.stderr)
        done = program.command("tradeoff", "--scene", self.scene, "--target", "0.1", "--output", self.out + "-none",
                               "--finer", "left_mesh_set=nonsense=")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
