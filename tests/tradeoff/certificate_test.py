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
from parts.tradeoff import estimate, ladder  # noqa: E402


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


class OwnScene(unittest.TestCase):
    """A second of the two small buildings, with the true errors beside the estimated ones."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="pounding-")
        cls.scene = os.path.join(cls.folder.name, "mine.yaml")
        with open(cls.scene, "w") as file:
            file.write(f"include: {two_buildings.SCENE}\nend_time: 1.2\nprobes: left_roof\n"
                       "left: {damping: {reference: 3}}\nright: {damping: {reference: 4}}\n"
                       "floor1: {gap: 0.01}\nfloor2: {gap: 0.01}\n")
        cls.out = os.path.join(cls.folder.name, "study")
        cls.words = ["tradeoff", "--scene", cls.scene, "--target", "0.9", "--output", cls.out]
        cls.done = program.command(*cls.words, "--check")
        cls.found = cls.certificate()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

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
        done = program.command(*self.words)
        self.assertEqual(done.returncode, 0, done.stderr)
        measured = self.certificate()
        self.assertTrue(measured["measured"])
        self.assertLessEqual(measured["error"]["1-400"], 0.9)
        self.assertIn("told by full order itself", done.stdout)

    def test_mistakes_are_one_line(self):
        for words, part in ((("--target", "0.1"), "--scene"), (("--scene", self.scene, "--target", "0"), "--target"),
                            (("--scene", self.scene, "--check"), "--target"),
                            (("--scene", self.scene, "--target", "0.1", "--finer", "mesh"), "NAME=VALUE")):
            done = program.command("tradeoff", *words)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(part, done.stderr)
        reduced = os.path.join(self.folder.name, "reduced.yaml")
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
