"""Sections and materials by their names: numbers in force, what the user defines wins, slips get the nearest name."""
import os
import re
import shutil
import tempfile
import unittest

import program
import two_buildings

SHORT = ["-end_time", 1e-3, "-modes", 1]
# The scene's own tables of sections and materials left out.
BY_NAME = ["-left_columns_section", "HEB160", "-right_columns_section", "HEB200", "-left_columns_material", "S355",
           "-right_columns_material", "S355", "-left_slabs_material", "C30/37", "-right_slabs_material", "c30"]
AXES = ["-section_HEB160_z_axis", "1,0,0", "-section_HEB200_z_axis", "1,0,0"]


class StandardParts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.mkdtemp(prefix="pounding-")
        for path in two_buildings.FOLDER.iterdir():
            shutil.copy(path, place)
        path = os.path.join(place, two_buildings.SCENE.name)
        with open(path) as file:
            text = file.read()
        bare = re.sub(r"^(material|section):.*\n(  .*\n)+", "", text, flags=re.MULTILINE)
        assert "left_column:" not in bare and "concrete:" not in bare, bare
        with open(path, "w") as file:
            file.write(bare)
        cls.place = place

    def run_scene(self, *words, ranks=1):
        out = tempfile.mkdtemp(prefix="pounding-")
        result = program.run(["-options_file", two_buildings.SCENE.name, *SHORT, *words, "-output", out], ranks,
                             folder=self.place)
        return result, out

    def options(self, *words, ranks=1):
        result, out = self.run_scene(*words, ranks=ranks)
        self.assertEqual(result.returncode, 0, result.stderr)
        return program.summary(out)

    def refused(self, *words, parts):
        result, _ = self.run_scene(*words)
        self.assertEqual(result.returncode, 1, result.stdout[-500:])
        line, = program.error_lines(result)
        for part in parts:
            self.assertIn(part, line)

    def test_numbers_are_in_force_and_give_the_frequencies_of_written_ones(self):
        named = {ranks: self.options(*BY_NAME, *AXES, ranks=ranks) for ranks in (1, 2)}
        options = named[2]["options"]
        for name, value in (("section_HEB160_area", 54.25e-4), ("section_HEB160_inertia_y", 2492e-8),
                            ("section_HEB200_inertia_z", 2003e-8), ("section_HEB200_torsion", 59.28e-8),
                            ("material_S355_young", 210e9), ("material_C30/37_young", 32.84e9),
                            ("material_c30_density", 2500)):
            self.assertAlmostEqual(float(options[name]) / value, 1, delta=1e-3, msg=name)
        words = [word for name, value in options.items() if name.startswith(("section_", "material_"))
                 for word in (f"-{name}", value)]
        written = self.options(*BY_NAME, *words)
        for summary in (named[1], written):
            for structure in ("left", "right"):
                found, expected = (one["structures"][structure]["frequencies"][0]["frequency"]
                                   for one in (summary, named[2]))
                self.assertAlmostEqual(found / expected, 1, delta=1e-9)

    def test_resolved_options_run_again(self):
        result, out = self.run_scene(*BY_NAME, *AXES)
        self.assertEqual(result.returncode, 0, result.stderr)
        again = program.run(["-options_file", os.path.join(out, "resolved.yaml"), "-dry_run"], 2, folder=self.place)
        self.assertEqual(again.returncode, 0, again.stderr)

    def test_one_profile_two_orientations(self):
        summary = self.options(*BY_NAME, "-left_columns_section", "strong", "-right_columns_section", "weak",
                               "-section_strong_profile", "HEB160", "-section_strong_z_axis", "1,0,0",
                               "-section_weak_profile", "he160b", "-section_weak_z_axis", "0,1,0")
        options = summary["options"]
        self.assertEqual(options["section_strong_inertia_y"], options["section_weak_inertia_y"])
        self.assertEqual(options["section_weak_profile"], "he160b")

    def test_what_the_user_defines_wins(self):
        options = self.options(*BY_NAME, *AXES, "-section_HEB160_area", 1e-2, "-material_S355_density", 8000)["options"]
        self.assertEqual(float(options["section_HEB160_area"]), 1e-2)
        self.assertAlmostEqual(float(options["section_HEB160_inertia_y"]), 2492e-8, delta=3e-8)
        self.assertEqual(float(options["material_S355_density"]), 8000)

    def test_slips_get_the_nearest_name(self):
        half = AXES[2:]
        self.refused(*BY_NAME, *half, "-left_columns_section", "HEB165", parts=("HEB165", "did you mean HEB160?"))
        self.refused(*BY_NAME, *half, "-left_columns_section", "HEB165", "-section_HEB165_z_axis", "1,0,0",
                     parts=("neither wholly defined", "did you mean HEB160?"))
        self.refused(*BY_NAME, *half, "-left_columns_section", "own", "-section_own_z_axis", "1,0,0",
                     parts=("missing option -section_own_area",))
        self.refused(*BY_NAME, *AXES, "-left_columns_material", "S353", parts=("S353", "did you mean S355?"))
        self.refused(*BY_NAME, *half, "-left_columns_section", "own", "-section_own_profile", "IPE305",
                     parts=("IPE305", "did you mean IPE300?"))
        self.refused(*BY_NAME, *AXES, "-left_slabs_material", "oak", parts=("'oak' is neither defined",))

    def test_the_orientation_is_asked_for(self):
        self.refused(*BY_NAME, parts=("missing option -section_HEB160_z_axis", "direction of local z"))


if __name__ == "__main__":
    unittest.main()
