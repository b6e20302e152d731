"""run/tradeoff --scene on a scene of one's own: its errors are those of its spectra, with estimates beside them."""
import csv
import math
import os
import tempfile
import unittest

import program
import two_buildings
from two_buildings import pounding

PROCESSORS = 2  # it starts runs


class SceneStudy(unittest.TestCase):
    """A second of the two small buildings: full order, half the step, and 50 modes."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-")
        cls.scene = two_buildings.own_scene(cls.folder, "modes: 0\n")
        cls.out = os.path.join(cls.folder, "study")
        cls.words = ["tradeoff", "--scene", cls.scene, "--only", "modal-50", "--estimate", 0.2, "--splits", 0, "--ranks", 1, "--output", cls.out]
        cls.done = program.command(*cls.words)

    def rows(self):
        with open(os.path.join(self.out, "tradeoff.csv"), newline="") as file:
            return {row["setting"]: row for row in csv.DictReader(file)}

    def test_errors_are_those_of_the_spectra(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        rows = self.rows()
        self.assertEqual(list(rows), ["full", "noise-step", "modal-50"])
        self.assertEqual(float(rows["full"]["rms"]), 0)
        runs = {name: pounding.load(os.path.join(self.out, "scene", name)) for name in rows}
        squares = []
        for way in "xyz":
            frequency, full = runs["full"].spectrum("left_roof", way)
            reduced = runs["modal-50"].spectrum("left_roof", way)[1]
            largest = max(runs["full"].spectrum("left_roof", axis)[1].max() for axis in "xyz")
            if full.max() > 1e-3 * largest and full.min() > 1e-9 * largest:  # a direction in which the roof moves
                logs = [math.log(a / b) for f, a, b in zip(frequency, reduced, full) if 1 <= f <= 400]
                squares.append(sum(value**2 for value in logs) / len(logs))
        self.assertAlmostEqual(float(rows["modal-50"]["rms"]) / math.sqrt(sum(squares) / len(squares)), 1, delta=1e-3)
        self.assertLess(float(rows["noise-step"]["rms"]), float(rows["modal-50"]["rms"]))
        told = runs["modal-50"].summary["fidelity"]["rms"]["1-400"]
        self.assertAlmostEqual(float(rows["modal-50"]["estimate"]) / told, 1, delta=1e-3)
        self.assertEqual(rows["full"]["estimate"], "")

    def test_the_options_that_it_recommends_can_be_pasted(self):
        line = next(line.split(": ", 1)[1] for line in self.done.stdout.splitlines() if line.startswith("    modal-50: "))
        self.assertEqual(line, "-left_model modal -right_model modal -left_modal_vectors 50 -right_modal_vectors 50 "
                         "-gap_interval 0.01")

    def test_names_are_looked_at_before_anything_runs(self):
        out = os.path.join(self.folder, "nothing")
        done = program.command("tradeoff", "--scene", self.scene, "--only", "modal-51", "--output", out)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("--only modal-51: none of courant-0.99, ", done.stderr)
        self.assertFalse(os.path.exists(out))

    def test_finished_runs_are_kept(self):
        path = os.path.join(self.out, "scene", "full", "summary.json")
        before = os.stat(path).st_mtime_ns
        cut = os.path.join(self.out, "scene", "noise-step")
        with open(os.path.join(cut, "notes.txt"), "w") as file:
            file.write("a user's")
        os.truncate(os.path.join(cut, "spectra.csv"), 1000)
        again = program.must_do(self, *self.words)
        self.assertEqual(os.stat(path).st_mtime_ns, before)
        self.assertTrue(os.path.exists(os.path.join(cut, "notes.txt")))
        self.assertGreater(os.path.getsize(os.path.join(cut, "spectra.csv")), 1000)  # run again, whole

    def test_mistakes_are_one_line(self):
        for words, part in ((("--scene", "nothing.yaml"), "no such file"), (("--scene", self.scene, "--gap", "gap2"), "--gap"),
                            (("--only", "modal-51"), "none of"), (("--estimate", "1"), "--scene"),
                            (("--splits", "2"), "--splits: for --scene"), (("--scene", self.scene, "--splits", "3"), "choose from 0, 2"),
                            (("--scene", self.scene, "--accuracy", "-1"), "--accuracy"),
                            (("--scene", self.scene, "--accuracy", "5"), "0.05 for 5 %"),
                            (("--scene", self.scene, self.scene), "two of one name")):
            done = program.command("tradeoff", *words)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(part, done.stderr)


if __name__ == "__main__":
    unittest.main()
