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
# patch: files of src made, changed. Measured numbers: a law of links with its option has a line in each of law_of.cpp and
# law_kinds.cpp beside its option (region.h) and what it cannot be with (region_reader.cpp); a spring with a history is a
# rule and its path; an element is its functions, its type and word, its row, its cost.
COST = {"option": (0, 1), "ledger_row": (0, 1), "output": (1, 1), "law": (1, 4), "spring": (2, 2), "element": (2, 3)}
FEET = ["-block_feet_element", "grounded_spring", "-block_feet_points", "0,0,0; 1,0,0; 0,1,0; 1,1,0",
        "-loops", "block:feet"]
SCENE = ["-structures", "block", "-block_mesh", "tests/meshes/box.geo", "-block_body_element", "hex8",
         "-block_body_material", "stone", "-material_stone_young", 1e6, "-material_stone_poisson", 0.2,
         "-material_stone_density", 1000, "-block_gravity", "0,0,-9.81", "-end_time", 0.01, "-time_step", 1e-4,
         "-probes", "top", "-top_structure", "block", "-top_at", "0,0,1"]


def scene_with(arguments):
    """The scene, in which these options take the place of those of their name."""
    named = dict(zip(SCENE[::2], SCENE[1::2])) | dict(zip(arguments[::2], arguments[1::2]))
    return [word for item in named.items() for word in item]


def frequencies(summary):
    return [mode["frequency"] for mode in summary["structures"]["block"]["frequencies"]]


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
            words = [self.copy.build_folder / "pounding", *scene_with(arguments)]
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

    def test_law(self):
        """Dashpots under a block that falls bear what their valves let them."""
        dashpots = [*FEET, "-block_feet_stiffness", "0,0,1", "-block_feet_dashpot", "0,0,1e5", "-block_feet_dashpot_relief", 10]
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_with("law", [*dashpots, "-output", folder])
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertAlmostEqual(program.summary(folder)["loops"]["block:feet"]["largest_force"], 10, delta=1e-9)

    def test_spring(self):
        """Two cycles to four times the first corner e: each way loses 3/2 k e^2, k the stiffness that goes at it."""
        feet = [*FEET, "-block_feet_stiffness", "0,0,1e5", "-block_feet_yield_force", "0,0,100", "-block_feet_hardening", 0.1,
                "-block_feet_rule", "flag", "-law_cycles", 4]
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_with("spring", [*feet, "-output", folder])
            self.assertEqual(done.returncode, 0, done.stderr)
            laws = program.read_csv(f"{folder}/laws.csv")
            force, stored, lost = (float(laws[name][-1]) for name in ("force", "stored_J", "lost_J"))
            self.assertAlmostEqual(force, 0, delta=1e-9)
            self.assertAlmostEqual(stored, 0, delta=1e-12)
            self.assertAlmostEqual(lost, 4 * 1.5 * 0.9e5 * 1e-6, delta=1e-9)

    def test_element(self):
        """A cube of one brick near a Poisson's ratio of 0.5: turning is that of other bricks, sway does not lock."""
        block = ["-block_clamp", "z_min", "-material_stone_poisson", 0.4999, "-modes", 2]
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_with("element", [*block, "-block_body_element", "hex8_mean", "-output", folder])
            self.assertEqual(done.returncode, 0, done.stderr)
            turns, sways = frequencies(program.summary(folder))
        turns_full, sways_full = frequencies(program.must_run(self, scene_with([*block, "-block_body_element", "hex8_full"]))[1])
        self.assertAlmostEqual(turns, turns_full, delta=1e-9)
        self.assertLess(sways, 0.7 * sways_full)


if __name__ == "__main__":
    unittest.main()
