"""Mutants are fit to be tried: each patch applies to the sources as they are, changes its own room, and names tests
that exist; every room of src has one. A find, a pass and neither, as run/mutants tells them apart; it is too long to
run here."""
import fnmatch
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import program
from promises_test import cpp_tests, python_tests

SOURCE = Path(program.SOURCE)
TESTS = SOURCE / "tests"
sys.path.insert(0, str(SOURCE / "run"))
sys.dont_write_bytecode = True
import parts  # noqa: E402,F401  (puts python on the path)
from parts.mutants import patches, trial  # noqa: E402

SHOWING_ELSEWHERE = ("ranks", "restart", "batch", "modes", "importer")


class Patches(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mutants = patches.read_all(TESTS / "mutants")

    def test_every_room_has_one_and_some_show_elsewhere_alone(self):
        rooms = {path.name for path in (SOURCE / "src").iterdir() if path.is_dir()}
        own = {mutant.room for mutant in self.mutants if not mutant.name.startswith(SHOWING_ELSEWHERE)}
        self.assertEqual(own, rooms)
        for place in SHOWING_ELSEWHERE:
            self.assertTrue(any(mutant.name.startswith(place + "_") for mutant in self.mutants), place)

    def test_each_applies_to_the_sources(self):
        alone = {**os.environ, "GIT_CEILING_DIRECTORIES": str(SOURCE.parent)}
        for mutant in self.mutants:
            with self.subTest(mutant.name):
                done = subprocess.run(["git", "apply", "--check", mutant.path], cwd=SOURCE, env=alone,
                                      capture_output=True, text=True, check=False)
                self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_each_is_one_fault_of_its_room(self):
        for mutant in self.mutants:
            with self.subTest(mutant.name):
                self.assertRegex(mutant.fault, r"^[A-Z].*\.$")
                folder = mutant.room if "/" in mutant.room else "src/" + mutant.room
                self.assertEqual(len(mutant.files), 1)
                self.assertTrue(mutant.files[0].startswith(folder + "/"), mutant.files[0])

    def test_each_names_up_to_three_tests_that_exist(self):
        own = {kind: set().union(*(cpp_tests(path.read_text()) for path in (TESTS / kind).rglob("*_test.cpp")))
               for kind in patches.PROGRAMS}
        for mutant in self.mutants:
            self.assertTrue(1 <= len(mutant.tests) <= 3, mutant.name)
            for test in mutant.tests:
                with self.subTest(mutant.name, test=test):
                    kind, _, choice = test.partition(":")
                    if kind in own:
                        self.assertTrue(fnmatch.filter(own[kind], choice))
                        continue
                    files = list(TESTS.glob(f"*/{kind}.py"))
                    self.assertEqual(len(files), 1)
                    names = python_tests(files[0].read_text())
                    self.assertTrue(not choice or any(f"{name}.".startswith(f"{choice}.") for name in names))


class Outcomes(unittest.TestCase):
    """Of files of tests that end in every way; of a patch that does not fit."""

    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory(prefix="pounding-mutants-")
        cls.addClassCleanup(cls.place.cleanup)
        source = Path(cls.place.name, "source")
        (source / "tests" / "some").mkdir(parents=True)
        (source / "run").mkdir()
        (source / "run" / "environment").touch()
        (source / "code.txt").write_text("one\ntwo\nthree\n")
        tests = {"passes": "pass", "fails": "self.fail()", "is_skipped": "self.skipTest('not here')",
                 "one_is_skipped": "pass\n    def test_other(self): self.skipTest('not here')",
                 "ends": "import os; os._exit(1)"}
        for name, body in tests.items():
            (source / "tests" / "some" / f"{name}_test.py").write_text(
                f"import unittest\nclass A(unittest.TestCase):\n    def test_it(self): {body}\nunittest.main()\n")
        (source / "tests" / "some" / "misses_test.py").write_text("import no_such_module\n")
        subprocess.run(["git", "init", "-q", source], check=True)
        cls.copy = trial.Copy(source, Path(cls.place.name, "copy"), 1)

    def mutant(self, line):
        path = Path(self.place.name, "a.patch")
        path.write_text("room: a\nfault: b\ntests: c\n\n--- a/code.txt\n+++ b/code.txt\n@@ -1,3 +1,3 @@\n one\n"
                        f"-{line}\n+2\n three\n")
        return patches.read(path)

    def test_a_failure_is_a_find(self):
        self.assertEqual(self.copy.run("fails_test"), trial.FOUND)
        self.assertEqual(self.copy.run("passes_test"), trial.PASSED)
        self.assertEqual(self.copy.run("one_is_skipped_test"), trial.PASSED)

    def test_what_cannot_run_is_none(self):
        for name in ("is_skipped_test", "ends_test", "misses_test"):
            with self.subTest(name), self.assertRaisesRegex(trial.TrialError, f"^{name} cannot run"):
                self.copy.run(name)
        with self.assertRaisesRegex(trial.TrialError, "no such test"):
            self.copy.run("none_test")

    def test_a_patch_is_put_in_and_taken_out(self):
        code = self.copy.folder / "code.txt"
        self.copy.apply(self.mutant("two"))
        self.assertEqual(code.read_text(), "one\n2\nthree\n")
        self.copy.restore()
        self.assertEqual(code.read_text(), "one\ntwo\nthree\n")
        with self.assertRaisesRegex(trial.TrialError, "^no longer applies"):
            self.copy.apply(self.mutant("zwei"))

    def test_a_folder_of_others_is_left_alone(self):
        with self.assertRaisesRegex(trial.TrialError, "holds other files"):
            trial.Copy(self.copy.source, self.copy.source, 1)


if __name__ == "__main__":
    unittest.main()
