"""What is refused of a table of impedances: one line, exit status 1, on one and two ranks."""
import os
import tempfile
import unittest

import program
from soil_input_test import BODY, MAT, TURNS

DIAGONALS = [f"k{motion}{motion}_{part}" for motion in ("x", "y", "z", "rx", "ry", "rz") for part in ("re", "im")]
NAMES = ["frequency", *DIAGONALS]
ROWS = [[f] + [1e9, 2e7 * f] * 3 + [1e11, 1e9 * f] * 3 for f in (0.5, 1, 2, 4, 8, 16)]


class Refused(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "soil.csv")

    def write(self, names=None, rows=None):
        with open(self.path, "w") as file:
            file.write(",".join(names or NAMES) + "\n")
            for row in rows or ROWS:
                file.write(",".join(str(value) for value in row) + "\n")

    def refused(self, *parts, more=()):
        program.must_refuse(self, BODY + TURNS + MAT + ["-block_soil_table", self.path, *more, "-dry_run"], *parts)

    def changed(self, row, column, value):
        rows = [list(values) for values in ROWS]
        rows[row][NAMES.index(column)] = value
        self.write(rows=rows)

    def test_a_good_one_is_taken(self):
        self.write()
        result = program.must_end(self, BODY + TURNS + MAT + ["-block_soil_table", self.path, "-dry_run"])
        self.assertIn("passive springs, dashpots and masses fitted to it", result.stdout)
        self.assertIn("misfit", result.stdout)

    def test_files(self):
        self.refused("no such file")
        with open(self.path, "w") as file:
            file.write("# nothing\n")
        self.refused("no line with names of columns")
        self.write(rows=ROWS[:3])
        self.refused("3 frequencies")

    def test_columns(self):
        self.write(names=["omega", *DIAGONALS])
        self.refused("line 1", "'omega'")
        self.write(names=["frequency", *DIAGONALS[:-1]], rows=[row[:-1] for row in ROWS])
        self.refused("no column 'krzrz_im'")
        self.write(names=[*NAMES, "kxry_re"], rows=[row + [1] for row in ROWS])
        self.refused("no column 'kxry_im'")
        self.write(names=[*NAMES, "kxx_re"], rows=[row + [1] for row in ROWS])
        self.refused("two columns are called 'kxx_re'")
        self.write(rows=[row[:-1] for row in ROWS])
        self.refused("line 2", "12 values for 13 columns")

    def test_numbers(self):
        for value in ("much", "nan", "inf", "1e60"):
            self.changed(2, "kzz_re", value)
            self.refused("line 4", f"'{value}' is no number")
        self.changed(3, "frequency", 2)
        self.refused("line 5", "does not increase")
        self.changed(0, "frequency", -1)
        self.refused("line 2", "Hz")

    def test_soil_that_cannot_be(self):
        self.changed(0, "kzz_re", -1e9)
        self.refused("line 2", "no stiffness", "lowest frequency")
        self.changed(4, "kxx_im", -1e8)
        self.refused("line 6", "give energy", "exp(-i omega t)")
        self.write(names=[*NAMES, "kxry_re", "kxry_im", "kryx_re", "kryx_im"],
                   rows=[row + [1e9, 0, 2e9, 0] for row in ROWS])
        self.refused("line 2", "not symmetric", "kryx", "kxry")
        self.write(names=[*NAMES, "kxry_re", "kxry_im"], rows=[row + [2e10, 0] for row in ROWS])
        self.refused("line 2", "no stiffness")

    def test_beside_a_half_space(self):
        self.write()
        for option, value in (("vs", 300), ("density", 2000), ("poisson", 0.3), ("shape", "disk"), ("size", "3,4"),
                              ("embedment", 2), ("frequency_dependence", "no")):
            self.refused(f"-block_soil_{option}", "-block_soil_table", more=[f"-block_soil_{option}", value])
        program.must_refuse(self, BODY + TURNS + ["-block_soil_table", self.path, "-dry_run"], "-block_soil_table",
                            "goes with -block_soil_mat")


if __name__ == "__main__":
    unittest.main()
