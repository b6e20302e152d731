"""Numbers in another unit than the program's draw one line of doubt each; those of a building draw none."""
import os
import tempfile
import unittest

import program

QUIET = ["-modes", 2, "-end_time", 0.002, "-spectra_frequencies", 10]


class Units(unittest.TestCase):
    def doubts(self, *words, ranks=1):
        """The warnings of a run on the coarse pair, printed and in summary.json alike."""
        with tempfile.TemporaryDirectory() as folder:
            result = program.must_end(self, [*program.COARSE_PAIR, *QUIET, *words, "-output", folder], ranks)
            warnings = program.summary(folder)["warnings"]
        printed = [line[len("warning: "):] for line in result.stdout.splitlines() if line.startswith("warning: ")]
        self.assertEqual(printed, warnings)
        return warnings

    def test_none_about_the_shipped_pair(self):
        of_units = ("material", "section", "structure", "motion")
        self.assertEqual([line for line in self.doubts() if line.startswith(of_units)], [])

    def test_each_wrong_unit_is_one_line(self):
        usual = self.doubts()
        for words, what in ((["-material_concrete_young", 30e3], "material concrete: young 30000 Pa"),
                            (["-material_concrete_density", 2.4], "material concrete: density 2.4 kg/m3"),
                            (["-material_concrete_poisson", 0.49], "material concrete: poisson 0.49"),
                            (["-section_heb200_area", 78.08], "section heb200"),
                            (["-s1_brace1_area", 117], "structure s1, group brace1: area 117 m2"),
                            (["-motion_x_pga", 0.35], "if g was meant, give 3.43"),
                            (["-s1_damping_beta", 0.1], "structure s1: alpha 0.1562 1/s and beta 0.1 s"),
                            (["-s2_damping_alpha", 50], "structure s2: alpha 50 1/s")):
            with self.subTest(what):
                new = [line for line in self.doubts(*words) if line not in usual and "its mesh carries" not in line]
                self.assertTrue(any(what in line for line in new), new)
                self.assertLessEqual(len(new), 2, new)  # a section has two inertias

    def test_file_in_one_unit_said_to_be_another(self):
        handle, path = tempfile.mkstemp(suffix=".txt")
        with os.fdopen(handle, "w") as file:
            file.write("0\n0.34\n-0.2\n0\n" * 20)
        words = ["-motion_x_record", path, "-motion_x_time_step", 0.01, "-motion_x_pga", 0]
        for unit, scale, what in (("m/s2", 1, "in g?"), ("g", 10, "above 3 g")):
            new = self.doubts(*words, "-motion_x_unit", unit, "-motion_x_scale", scale)
            self.assertEqual(len([line for line in new if what in line]), 1, new)
        new = self.doubts(*words, "-motion_x_unit", "g")
        self.assertEqual([line for line in new if "motion" in line and "has its peak" not in line], [])  # the run is short


if __name__ == "__main__":
    unittest.main()
