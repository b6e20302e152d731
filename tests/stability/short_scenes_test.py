"""Short scenes of every kind of model on one, two and three ranks (with POUNDING_ALL on one to eight), more
ranks than cores: same answers.

Two houses of some twenty nodes that pound, as they are and with each way of treating them: assembled,
shared out whole, braces that buckle, scaled mass, one or both of them reduced, from matrices in files.
Histories agree to 1e-10 of their largest value: sums over ranks differ in their order, nothing else.
"""
import tempfile
import unittest

import program
from houses import Pair, Run, assert_same

RANKS = range(2, 9) if program.ALL else (2, 3)
END = 0.006      # s: the houses touch after 4 ms
SCENES = {
    "as they are": [],
    "assembled": ["-stiffness", "assembled"],
    "shared out whole": ["-partition", "structures"],
    "braces that buckle": ["-left_brace_tension_only", "-right_brace_tension_only"],
    "scaled mass": ["-left_mass_scaling", 4e-5],
    "one reduced": ["-left_model", "modal", "-left_modal_vectors", 12],
    "both reduced": ["-left_model", "modal", "-left_modal_vectors", 12, "-right_model", "modal",
                     "-right_modal_vectors", 12],
}


class ShortScenes(unittest.TestCase):
    def follow(self, more):
        """Runs a scene on one rank and on more, and compares."""
        reference = Run(self, Pair(), 1, end_time=END, more=more)
        self.assertGreater(reference.summary["impacts"]["episodes"], 0)
        for ranks in RANKS:
            with self.subTest(ranks=ranks):
                run = Run(self, Pair(), ranks, end_time=END, more=more)
                assert_same(self, run, reference, 1e-10)
                self.assertEqual(run.summary["ranks"], ranks)
                self.assertEqual(run.summary["steps"], reference.summary["steps"])
                self.assertEqual(run.summary["impacts"]["episodes"], reference.summary["impacts"]["episodes"])

    def test_same_answers_on_one_to_eight_ranks(self):
        for name, more in SCENES.items():
            with self.subTest(scene=name):
                self.follow(more)

    def test_same_answers_from_matrices(self):
        folder = tempfile.mkdtemp(prefix="pounding-matrices-")
        with tempfile.TemporaryDirectory(prefix="pounding-") as scene:
            words = Pair().words(scene, 1.6e-5, END) + ["-dry_run", "-export_matrices", folder, "-output", scene]
            result = program.run(words, 1)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.follow(["-left_matrices", f"{folder}/left", "-right_matrices", f"{folder}/right"])


if __name__ == "__main__":
    unittest.main()
