"""run/verification: what an assertion compares reaches the table, and a failing one the exit status."""
import json
import os
import tempfile
import unittest
import unittest.mock

import program

PROCESSORS = 2  # it starts tests

PROBLEM = '''"""A made-up problem."""
import unittest


class Problem(unittest.TestCase):
    def test_of_closeness(self):
        self.assertAlmostEqual(1.0, 1.25, delta={delta}, msg="height")
        self.assertAlmostEqual(1.0, 1.0, delta=1e-9, msg="width")

    def test_of_order(self):
        self.assertLess(0.03, 0.04, "loss")

    def test_without_figures(self):
        self.assertEqual(2, 2)


if __name__ == "__main__":
    unittest.main()
'''


class Verification(unittest.TestCase):
    def setUp(self):
        place = tempfile.mkdtemp()
        self.problems, self.output = (os.path.join(place, name) for name in ("problems", "output"))
        os.mkdir(self.problems)

    def write(self, name, text):
        with open(os.path.join(self.problems, name + "_test.py"), "w") as file:
            file.write(text)

    def verify(self, *words):
        return program.command("verification", "--problems", self.problems, "--output", self.output, *words)

    def rows(self):
        with open(os.path.join(self.output, "verification.md")) as file:
            return [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in file][2:]

    def test_nearest_to_its_tolerance_is_listed(self):
        self.write("good", PROBLEM.format(delta=0.5))
        result = self.verify()
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("good: 3 tests, passed", result.stdout)
        self.assertEqual(self.rows(), [["good", "of closeness", "2", "0.25", "0.5", "height"],
                                       ["good", "of order", "1", "0.03", "0.04", "loss"]])

    def test_ranks_reach_the_tests(self):
        text = PROBLEM.format(delta=0.5).replace("assertEqual(2, 2)", "assertEqual(program.RANKS, 3)")
        self.write("good", text.replace("import unittest", "import unittest\n\nimport program"))
        self.assertEqual(self.verify("--ranks", "3").returncode, 0)
        with unittest.mock.patch.dict(os.environ):
            os.environ.pop("POUNDING_RANKS", None)
            self.assertEqual(self.verify().returncode, 1)

    def test_failing_assertion_fails(self):
        self.write("bad", PROBLEM.format(delta=0.1))
        self.write("good", PROBLEM.format(delta=0.5))
        result = self.verify()
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn("bad: 3 tests, FAILED", result.stdout)
        self.assertIn("run/verification: failed: bad", result.stderr)
        self.assertIn("1.0 != 1.25 within 0.1 delta", result.stderr)
        self.assertIn(["bad", "of closeness", "1", "0.25", "0.1", "height"], self.rows())
        with open(os.path.join(self.output, "bad.json")) as file:
            self.assertFalse(json.load(file)["passed"])

    def test_failure_without_a_figure_fails(self):
        self.write("bad", PROBLEM.format(delta=0.5).replace("assertEqual(2, 2)", "assertEqual(2, 3)"))
        self.assertEqual(self.verify().returncode, 1)
        self.write("bad", PROBLEM.format(delta=0.5).replace("self.assertEqual(2, 2)", "raise OSError('gone')"))
        self.assertEqual(self.verify().returncode, 1)

    def test_problem_that_cannot_be_read_fails(self):
        self.write("broken", "import nothing_of_that_name\n")
        result = self.verify()
        self.assertEqual(result.returncode, 1)
        self.assertIn("broken_test.py did not run", result.stderr)

    def test_only_what_is_there(self):
        self.write("good", PROBLEM.format(delta=0.5))
        self.write("bad", PROBLEM.format(delta=0.1))
        self.assertEqual(self.verify("--only", "good").returncode, 0)
        result = self.verify("--only", "weather")
        self.assertEqual(result.returncode, 2)
        self.assertIn("bad, good", result.stderr)


if __name__ == "__main__":
    unittest.main()
