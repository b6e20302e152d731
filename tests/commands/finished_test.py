"""Kept runs: whatever file changes that a run read, or is lost or cut of what it left, it is run again."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import program
import two_buildings
from two_buildings import pounding

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
from pounding import UserError, finished  # noqa: E402
from pounding.fragility import design, study  # noqa: E402
from pounding.fragility import runs as members  # noqa: E402

PROCESSORS = 2  # it starts runs

class Kept(unittest.TestCase):
    """One member of a sweep whose inputs are named in every way there is."""

    @classmethod
    def setUpClass(cls):
        cls.place = Path(tempfile.mkdtemp(prefix="pounding-")).resolve()
        for path in two_buildings.FOLDER.iterdir():
            shutil.copy(path, cls.place)
        (cls.place / "outer.geo").write_text('Include StrCat("build", "ing.geo");\n')
        short = {"modes": 0, "left_damping_reference": 3, "right_damping_reference": 4}
        pounding.run("two-buildings.yaml", "first", 1, cls.place, end_time=1e-3, export_matrices="matrices", **short)
        (cls.place / "deep").mkdir()
        for name, text in (("scene.yaml", "{include: deep/inline.yaml, end_time: 0.01, modes: 0}"),
                           ("deep/inline.yaml", '"include": "quoted.yaml"'),
                           ("deep/quoted.yaml", "include: ../two-buildings.yaml\nleft: {mesh: ../outer.geo}\n"
                            "motion: {y: {record: ../record.txt, unit: m/s2, time_step: 0.01}}"),
                           ("more.yaml", "probes: left_roof\nright: {matrices: matrices/right}")):
            (cls.place / name).write_text(text + "\n")
        (cls.place / "record.txt").write_text("".join(f"{0.01 * i:.2f} {(-1) ** i}\n" for i in range(20)))
        cls.line = [os.path.join(program.SOURCE, "run", "sweep"), "scene.yaml", "--out", "out", "--set",
                    "floor1_gap=0.03", "--options", "-options_file more.yaml -left_damping_reference 3 "
                    "-right_damping_reference 4"]
        cls.done = cls.sweep()
        cls.member = cls.place / "out" / "floor1_gap=0.03"
        cls.words = json.loads((cls.member / "request.json").read_text())["words"] if cls.done.returncode == 0 else []

    @classmethod
    def sweep(cls):
        return subprocess.run(cls.line, cwd=cls.place, capture_output=True, text=True, timeout=300, check=False,
                              env={**os.environ, "POUNDING_BUILD": os.path.abspath(program.BUILD)})

    def current(self):
        return finished.is_finished(self.words, self.member, self.place)

    def setUp(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout + self.done.stderr)
        self.assertTrue(self.current())

    def test_every_file_that_was_read_counts(self):
        for name in ("scene.yaml", "deep/inline.yaml", "deep/quoted.yaml", "two-buildings.yaml", "more.yaml",
                     "outer.geo", "building.geo", "ground.csv", "record.txt", "matrices/right/stiffness.mtx",
                     "matrices/right/mass.mtx", "matrices/right/dofs.csv"):
            with self.subTest(name):
                path = self.place / name
                before = path.read_bytes()
                path.write_bytes(before + b"\n")
                self.assertFalse(self.current())
                path.unlink()
                self.assertFalse(self.current())
                path.write_bytes(before)
                self.assertTrue(self.current())

    def test_a_matrix_that_is_added_counts(self):
        path = self.place / "matrices" / "right" / "damping.mtx"
        path.write_text("")
        self.assertFalse(self.current())
        path.unlink()
        self.assertTrue(self.current())

    def test_other_words_are_another_run(self):
        self.assertFalse(finished.is_finished([*self.words, "-end_time", "1"], self.member, self.place))

    def test_what_is_lost_or_cut_is_run_again(self):
        for name in ("history.h5", "spectra.csv", "impacts.csv", "energy.csv", "resolved.yaml", "summary.json"):
            with self.subTest(name):
                path = self.member / name
                before = path.read_bytes()
                path.write_bytes(before[:len(before) // 2])
                self.assertFalse(self.current())
                path.unlink()
                self.assertFalse(self.current())
                path.write_bytes(before)
                self.assertTrue(self.current())
        (self.member / "mine.txt").write_text("a user's")
        (self.member / "spectra.csv").unlink()
        again = self.sweep()
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("1 runs, 0 finished before", again.stdout)
        self.assertTrue((self.member / "spectra.csv").is_file() and (self.member / "mine.txt").is_file())


class Members(unittest.TestCase):
    """Those of run/fragility, kept under the files that the first one read."""

    def test_other_files_are_other_members_and_the_old_ones_stay(self):
        with tempfile.TemporaryDirectory(prefix="pounding-") as place:
            mesh = Path(place) / "inner.geo"
            mesh.write_text("one")
            (Path(place) / "study.yaml").write_text(
                f"scene: {two_buildings.SCENE}\nmotions: {{x: {{target: {two_buildings.FOLDER / 'ground.csv'}, seeds: [1, 2]}}}}\n"
                "levels: [2]\ngaps: [0.01]\njoints: {floor1: {}}\n")
            scouts = []

            def scout(runner, reduced, base):
                scouts.append(base)
                return members.Scouted({str(mesh): finished.digest(mesh)}, ["left_roof"], ["floor1", "floor2"])

            def base(only_look=False):
                found = study.read(Path(place) / "study.yaml")
                return members.Runner(found, design.build(found), Path(place) / "out", 1, 1, "auto", only_look).bases["reduced"]

            with unittest.mock.patch.object(members.Runner, "_scout", scout):
                with self.assertRaisesRegex(UserError, "nothing is there yet"):
                    base(only_look=True)
                first = base()
                self.assertEqual(base(), first)
                mesh.write_text("two")
                second = base()
                self.assertNotEqual(second, first)
                mesh.write_text("one")
                self.assertEqual(base(), first)
                self.assertEqual(scouts, [first, second])


if __name__ == "__main__":
    unittest.main()
