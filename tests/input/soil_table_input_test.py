"""What is refused of a file of soil, whoever wrote it: one line, exit status 1, on one and two ranks."""
import os
import tempfile
import unittest

import program
from soil_input_test import BODY, MAT, TURNS
from soil_tables import coupled, write_table

AXES = ["1e9"] * 3 + ["1e11"] * 3


def diagonal(values):
    return [[values[i] if i == j else "0" for j in range(6)] for i in range(6)]


class Refused(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "soil.csv")
        self.head = [["pounding soil", "1"], ["mats", "1"]]
        self.matrices = {"stiffness": diagonal(AXES), "dashpots": diagonal(["2e7"] * 3 + ["0"] * 3), "masses": diagonal(["0"] * 6)}
        self.hidden = [["1", "0", "0", "0", "-2", "0", "1e7", "0", "1e6"]]

    def lines(self):
        rows = list(self.head)
        for name, matrix in self.matrices.items():
            rows += [[name], *matrix]
        return [",".join(row) for row in [*rows, ["hidden"], *self.hidden]]

    def write(self, lines):
        with open(self.path, "w") as file:
            file.write("\n".join(["# soil", *lines]) + "  # the last\n")

    def refused(self, *parts, more=(), on=(1,), lines=None):
        self.write(lines or self.lines())
        for ranks in on:
            program.must_refuse(self, BODY + TURNS + MAT + ["-block_soil_table", self.path, *more, "-dry_run"], *parts,
                                ranks=ranks)

    def taken(self):
        self.write(self.lines())
        return program.must_end(self, BODY + TURNS + MAT + ["-block_soil_table", self.path, "-dry_run"], ranks=2)

    def changed(self, section, row, column, value):
        kept = self.matrices[section][row][column]
        self.matrices[section][row][column] = value
        return kept

    def test_good_ones_are_taken(self):
        """By hand, with a misfit to doubt, without hidden parts, and with a matrix that is singular but for round-off."""
        self.head.append(["misfit", "x ry", "0.12", "0.5", "0.03"])
        result = self.taken()
        self.assertIn("passive springs, dashpots and masses, 1 hidden parts", result.stdout)
        self.assertEqual(result.stdout.count("x, ry: misfit 12 % at most, at 0.5 Hz, 3 % in the mean"), 1, result.stdout)
        self.assertIn("miss the table that they are fitted to along x, ry by up to 12 %, at 0.5 Hz", result.stdout)
        self.hidden = []
        self.matrices["dashpots"][0][4] = self.matrices["dashpots"][4][0] = "-6e7"
        self.matrices["dashpots"][4][4] = "1.7999999999999e8"
        self.assertIn("0 hidden parts", self.taken().stdout)

    def test_a_raw_table(self):
        with open(write_table(coupled)) as file:
            self.refused("line 3", "a table of impedances", f"run/soil {self.path} OUT", lines=file.read().splitlines(), on=(1, 2))

    def test_files(self):
        program.must_refuse(self, BODY + TURNS + MAT + ["-block_soil_table", self.path, "-dry_run"], "no such file")
        self.refused("nothing in it", lines=["# nothing"])
        self.refused("line 2", "'<html>' where 'pounding soil,1' belongs", lines=["<html>"])
        good = self.lines()
        self.refused("line 2", "another version", lines=["pounding soil,2", *good[1:]])
        self.refused("line 5", "6 values where 12 belong", lines=[good[0], "mats,2", *good[2:]])
        self.refused("line 3", "soil of 0 mats", lines=[good[0], "mats,0", *good[2:]])
        self.refused("line 6", "the file ends", lines=good[:4])
        self.refused("line 4", "'masses' where 'stiffness' belongs", lines=[*good[:2], "masses", *good[3:]])
        self.refused("line 4", "'xy' is none of x, y, z", lines=[*good[:2], "misfit,xy,0,1,0", *good[2:]])
        self.refused("line 5", "5 values where 6 belong", lines=[*good[:3], "1,0,0,0,0", *good[4:]])

    def test_numbers(self):
        for value in ("much", "nan", "inf", "1e60"):
            self.changed("stiffness", 2, 2, value)
            self.refused("line 7", f"'{value}' is no number")

    def test_soil_that_gives_energy(self):
        """By a diagonal, by what is beside it, by an eigenvalue, by a hidden part."""
        kept = self.changed("dashpots", 1, 1, "-3e5")
        self.refused("line 13", "would give energy: -300000 at y y of the dashpots", on=(1, 2))
        self.changed("dashpots", 1, 1, kept)
        self.changed("masses", 4, 0, "-5")
        self.refused("line 23", "would give energy: -5 at ry x of the masses")
        self.changed("masses", 4, 0, "0")
        for one, other in ((0, 1), (1, 0)):
            self.changed("dashpots", one, other, "2.1e7")
        self.refused("line 11", "would give energy: the least eigenvalue of the dashpots over the diagonals is -0.05")
        self.setUp()
        for k, name, value in ((6, "dashpot", "-1"), (6, "dashpot", "0"), (7, "spring", "-1e9"), (8, "mass", "-0.5")):
            self.hidden[0][6:] = ["1e7", "0", "1e6"]
            self.hidden[0][k] = value
            self.refused("line 26", f"a hidden {name} of {float(value):g}")
        self.hidden = [["0"] * 6 + ["1e7", "0", "1e6"]]
        self.refused("line 26", "against no motion")

    def test_soil_that_holds_nothing(self):
        for i, j in ((0, 4), (4, 0)):
            self.changed("stiffness", i, j, "1e10")
        self.refused("line 4", "no stiffness against some motion")
        self.setUp()
        self.changed("stiffness", 5, 5, "0")
        self.refused("line 4", "no stiffness against some motion")

    def test_a_matrix_that_is_not_symmetric(self):
        self.changed("stiffness", 0, 4, "1e9")
        self.changed("stiffness", 4, 0, "2e9")
        self.refused("line 9", "not symmetric: 2e+09 at ry x of the stiffness, 1e+09 at x ry")

    def test_beside_a_half_space(self):
        for option, value in (("vs", 300), ("density", 2000), ("poisson", 0.3), ("shape", "disk"), ("size", "3,4"),
                              ("embedment", 2), ("frequency_dependence", "no")):
            self.refused(f"-block_soil_{option}", "-block_soil_table", more=[f"-block_soil_{option}", value])
        program.must_refuse(self, BODY + TURNS + ["-block_soil_table", self.path, "-dry_run"], "-block_soil_table",
                            "goes with -block_soil_mat")


if __name__ == "__main__":
    unittest.main()
