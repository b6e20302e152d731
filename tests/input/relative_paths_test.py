"""Paths in an options file: first beside that file, then where the program runs."""
import os
import shutil
import tempfile
import unittest
from pathlib import Path

import program
import two_buildings

SHORT = [word for name, value in {**two_buildings.SHORT, "end_time": 1e-3}.items() for word in (f"-{name}", value)]


class RelativePaths(unittest.TestCase):
    def setUp(self):
        place = tempfile.mkdtemp(prefix="pounding-")
        self.scene, self.here = Path(place, "scene"), Path(place, "here")
        self.here.mkdir()
        shutil.copytree(two_buildings.FOLDER, self.scene)

    def run_scene(self, file, *words, ranks=1):
        return program.run(["-options_file", file, *SHORT, "-output", "out", *words], ranks, folder=self.here)

    def in_force(self, file, *words, ranks=1):
        result = self.run_scene(file, *words, ranks=ranks)
        self.assertEqual(result.returncode, 0, result.stdout[-500:] + result.stderr)
        return program.summary(self.here / "out")

    def test_files_beside_the_scene_are_found_from_another_folder(self):
        summary = self.in_force("../scene/two-buildings.yaml")
        self.assertEqual(summary["options"]["left_mesh"], "../scene/building.geo")
        self.assertEqual(summary["options"]["motion_x_target"], "../scene/ground.csv")
        self.assertTrue((self.here / "out" / "summary.json").is_file(), "results go where the program runs")

    def test_the_scene_s_folder_comes_before_that_of_the_run(self):
        text = (self.scene / "building.geo").read_text()
        (self.here / "building.geo").write_text(text.replace("storeys = 2", "storeys = 3"))
        beside = self.in_force("../scene/two-buildings.yaml")
        self.assertEqual(beside["structures"]["left"]["nodes"], 77)
        # The command line speaks of the folder of the run.
        given = self.in_force("../scene/two-buildings.yaml", "-left_mesh", "building.geo")
        self.assertEqual(given["options"]["left_mesh"], "building.geo")
        self.assertGreater(given["structures"]["left"]["nodes"], 77)

    def test_what_is_not_beside_the_scene_is_looked_for_where_the_program_runs(self):
        shutil.move(self.scene / "building.geo", self.here / "building.geo")
        self.assertEqual(self.in_force("../scene/two-buildings.yaml")["options"]["left_mesh"], "building.geo")

    def test_includes_and_their_own_files(self):
        (self.here / "mine").mkdir()
        (self.here / "mine" / "wide.yaml").write_text("include: ../../scene/two-buildings.yaml\nfloor1_gap: 0.06\n")
        summary = self.in_force("mine/wide.yaml")
        self.assertEqual(summary["options"]["floor1_gap"], "0.06")
        self.assertEqual(summary["options"]["left_mesh"], "../scene/building.geo")
        (self.here / "mine" / "a.yaml").write_text("include: b.yaml\n")
        (self.here / "mine" / "b.yaml").write_text("include: a.yaml\n")
        result = self.run_scene("./mine/a.yaml")
        self.assertEqual(result.returncode, 1)
        self.assertIn("read already", program.error_lines(result)[0])

    def test_what_is_nowhere_is_one_line(self):
        (self.here / "case.yaml").write_text("include: nowhere.yaml\n")
        os.remove(self.scene / "building.geo")
        for file, part in (("case.yaml", "nowhere.yaml: no such file"),
                           ("../scene/two-buildings.yaml", "building.geo: no such file")):
            result = self.run_scene(file)
            self.assertEqual(result.returncode, 1)
            line, = program.error_lines(result)
            self.assertIn(part, line)

    def test_resolved_options_run_again(self):
        self.in_force("../scene/two-buildings.yaml")
        result = self.run_scene("out/resolved.yaml", "-dry_run")
        self.assertEqual(result.returncode, 0, result.stderr)


if __name__ == "__main__":
    unittest.main()
