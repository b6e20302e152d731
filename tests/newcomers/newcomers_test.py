"""Newcomers' patches: a capability of each kind costs as many files of src as CONTRIBUTING.md says. Each patch applies to
the sources as they are, makes and changes so many files and no more, and with run/test --all it is built in a copy of the
sources and does its work there: no table, help text, reader or writer elsewhere had to learn of it."""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import program

sys.path.insert(0, os.path.join(program.SOURCE, "run"))
from parts.mutants.patches import Mutant  # noqa: E402
from parts.mutants.trial import Copy  # noqa: E402

PROCESSORS = 2  # builds with both of them
TIMEOUT = 7200
FOLDER = Path(__file__).parent
# patch: files of src made, changed
COST = {"option": (0, 1), "ledger_row": (0, 1), "output": (1, 1)}
SCENE = ["-structures", "block", "-block_mesh", "tests/meshes/box.geo", "-block_body_element", "hex8",
         "-block_body_material", "stone", "-material_stone_young", 1e6, "-material_stone_poisson", 0.2,
         "-material_stone_density", 1000, "-block_gravity", "0,0,-9.81", "-end_time", 0.01, "-time_step", 1e-4,
         "-probes", "top", "-top_structure", "block", "-top_at", "0,0,1"]


def patch(kind):
    path = FOLDER / f"{kind}.patch"
    return Mutant(path, "", "", (), tuple(re.findall(r"^\+\+\+ b/(.+)$", path.read_text(), re.MULTILINE)))


class Patches(unittest.TestCase):
    def test_apply_and_touch_so_many_files(self):
        self.assertEqual(sorted(path.stem for path in FOLDER.glob("*.patch")), sorted(COST))
        for kind, (made, changed) in COST.items():
            text = patch(kind).path.read_text()
            self.assertEqual(text.count("--- /dev/null"), made, kind)
            self.assertEqual(len(patch(kind).files), made + changed, kind)
            done = subprocess.run(["git", "apply", "--check", patch(kind).path], cwd=program.SOURCE, capture_output=True,
                                  text=True)
            self.assertEqual(done.returncode, 0, done.stderr)


@program.long
class Built(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        build = Path(program.BUILD).resolve()
        cls.copy = Copy(Path(program.SOURCE), build.with_name(build.name + "-newcomers"), 2)
        cls.copy.configure([], [])

    def run_with(self, kind, arguments):
        """Runs the scene with the program that has the patch."""
        self.copy.apply(patch(kind))
        try:
            self.copy.build(["pounding"])
            words = [self.copy.build_folder / "pounding", *SCENE, *arguments]
            return subprocess.run(list(map(str, words)), cwd=self.copy.folder, env=self.copy.environment(),
                                  capture_output=True, text=True, timeout=600)
        finally:
            self.copy.restore()
            for name in patch(kind).files:
                if not (Path(program.SOURCE) / name).exists():
                    (self.copy.folder / name).unlink()

    def test_option(self):
        refused = self.run_with("option", ["-top_factor", 0])
        self.assertEqual(refused.returncode, 1)
        self.assertIn("-top_factor 0: out of range; expected a number > 0", refused.stderr)

    def test_ledger_row(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_with("ledger_row", ["-output", folder])
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("support_work", program.read_csv(f"{folder}/energy.csv"))
            self.assertEqual(program.summary(folder)["energy"]["of_supports"], 0)

    def test_output(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_with("output", ["-output", folder])
            self.assertEqual(done.returncode, 0, done.stderr)
            columns = program.read_csv(f"{folder}/steps.csv")
            self.assertEqual(float(columns["steps"][-1]), 100)
            self.assertIn("steps.csv", json.dumps(program.summary(folder)["files"]))


if __name__ == "__main__":
    unittest.main()
