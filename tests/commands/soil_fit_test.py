"""run/soil: soil fitted to tables of impedances gives no energy whatever the table is, meets what soil can meet, and tables that
cannot be meant are refused with their line."""
import math
import os
import tempfile
import unittest
from pathlib import Path

import numpy

import program
from soil_tables import MOTIONS, cell, coupled, write_table

from pounding.soil import fit, impedances  # soil_tables puts it on the path

DIAGONALS = [f"k{motion}{motion}_{part}" for motion in MOTIONS for part in ("re", "im")]
NAMES = ["frequency", *DIAGONALS]
ROWS = [[f] + [1e9, 2e7 * f] * 3 + [1e11, 1e9 * f] * 3 for f in (0.5, 1, 2, 4, 8, 16)]


def diagonal(cells):
    return lambda omega: numpy.diag([cell(omega, *one) for one in cells])


def half_space(generator):
    """Springs, dashpots and internal masses as a half-space has them: K (1 - share x / (turn + x))."""
    cells = []
    for _ in range(6):
        stiffness, time = 10**generator.uniform(8, 11), generator.uniform(0.02, 0.08)
        inner = generator.uniform(0.2, 1) * stiffness * time
        cells.append((stiffness, stiffness * generator.uniform(0, 0.1), inner, inner * time, 1e-4 * stiffness * (time > 0.05)))
    return diagonal(cells)


class Fit(unittest.TestCase):
    def fitted(self, impedance, frequencies):
        path = write_table(impedance, frequencies)
        self.addCleanup(os.remove, path)
        return fit.fit(impedances.read(Path(path)))

    def assert_passive(self, soil):
        """Every number is one that only takes energy, and so is the whole far below and far above the table."""
        for matrix in (soil.stiffness, soil.dashpots, soil.masses):
            size = numpy.sqrt(numpy.diag(matrix))
            size[size == 0] = 1
            self.assertGreater(numpy.linalg.eigvalsh(matrix / numpy.outer(size, size))[0], -1e-12)
        for part in soil.hidden:
            self.assertGreater(part.dashpot, 0)
            self.assertTrue(0 <= part.spring < math.inf and 0 <= part.mass < math.inf)
        whole = soil.at(2 * math.pi * numpy.logspace(-4, 4, 601))
        self.assertGreater(numpy.linalg.eigvalsh(whole.imag / impedances.sizes_of(whole))[:, 0].min(), -1e-12)

    def test_half_spaces_come_back(self):
        generator = numpy.random.default_rng(3)
        for _ in range(4):
            impedance = half_space(generator)
            soil, blocks, left_out = self.fitted(impedance, numpy.arange(1, 81) * 0.25)
            self.assertEqual([block.names for block in blocks], list(MOTIONS))
            self.assertLess(max(block.misfit.max() for block in blocks), 1e-3)
            self.assertEqual(left_out, 0)
            self.assertLess(abs(numpy.diag(soil.stiffness) / numpy.diag(impedance(0).real) - 1).max(), 1e-3)
            self.assert_passive(soil)

    def test_coupled_motions_come_back_coupled(self):
        soil, blocks, _ = self.fitted(coupled, numpy.arange(1, 81) * 0.25)
        self.assertEqual([block.names for block in blocks], ["x ry", "y rx", "z", "rz"])
        self.assertLess(max(block.misfit.max() for block in blocks), 1e-4)
        self.assertLess(abs(soil.stiffness[0, 4] / coupled(0)[0, 4].real - 1), 1e-3)
        self.assertGreater(min(block.margin for block in blocks), 0.1)
        self.assert_passive(soil)

    def random_soil(self, generator, count, whole=False):
        parts = [(numpy.eye(6)[c], (1e9, 1e7 * generator.uniform(0.1, 1))) for c in range(6)]
        for k in range(count):
            motion = generator.uniform(-1, 1, 6)
            if not whole:
                motion *= [k % 2 == 0, k % 2 == 1, 0, k % 2 == 1, k % 2 == 0, 0]
            numbers = generator.uniform(0.1, 1, 5) * [1e8, 1e6, 4e7, 3e5 * (k % 3 != 2), 1e9 * (k % 3 != 1)]
            parts.append((motion, (*numbers[:4], 0, numbers[4])))
        return lambda omega: sum(cell(omega, *numbers) * numpy.outer(motion, motion) for motion, numbers in parts)

    def test_random_passive_soil_is_met_and_passive(self):
        """Up to six hidden parts beside springs and dashpots, in random motions; one of all six at once."""
        generator = numpy.random.default_rng(3)
        for count in range(1, 7):
            soil, blocks, _ = self.fitted(self.random_soil(generator, count), numpy.arange(1, 61) * 0.3)
            self.assertLess(max(block.misfit.mean() for block in blocks), 1e-3, count)
            self.assert_passive(soil)
        soil, blocks, _ = self.fitted(self.random_soil(numpy.random.default_rng(0), 4, whole=True), numpy.arange(1, 41) * 0.5)
        self.assertEqual([block.names for block in blocks], ["x y z rx ry rz"])
        self.assertLess(blocks[0].misfit.max(), 0.02)
        self.assertLess(blocks[0].misfit.mean(), 0.006)
        self.assert_passive(soil)

    def test_whatever_the_table_is_the_fit_is_passive(self):
        """Tables that no soil has, which nothing passive meets."""
        for seed in range(6):
            generator = numpy.random.default_rng(seed)

            def noise(_, generator=generator):
                matrix = 1e9 * (generator.normal(size=(6, 6)) + 1j * generator.normal(size=(6, 6)))
                matrix *= numpy.eye(6) + 0.5 * numpy.eye(6, k=-4)
                return matrix + numpy.tril(matrix, -1).T
            table = impedances.Impedances(numpy.arange(1, 13) * 0.5, numpy.array([noise(0) for _ in range(12)]))
            soil, blocks, _ = fit.fit(table)
            self.assertGreater(max(block.misfit.max() for block in blocks), 0.1)
            self.assert_passive(soil)

    def test_static_stiffness_of_hysteretic_soil_is_kept(self):
        """A loss that does not depend on the frequency is met as far as passive soil can."""
        plain = half_space(numpy.random.default_rng(1))
        loss = 0.1j * numpy.diag(numpy.diag(plain(0.5 * math.pi).real))
        soil, blocks, _ = self.fitted(lambda omega: plain(omega) + loss, numpy.arange(1, 81) * 0.25)
        self.assertLess(abs(numpy.diag(soil.stiffness) / numpy.diag(plain(0).real) - 1).max(), 0.05)
        self.assertLess(max(block.misfit.mean() for block in blocks), 0.03)
        self.assert_passive(soil)


class Command(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "table.csv")
        self.out = os.path.join(folder.name, "soil.csv")

    def write(self, names=None, rows=None):
        with open(self.path, "w") as file:
            file.write(",".join(names or NAMES) + "\n")
            for row in rows or ROWS:
                file.write(",".join(str(value) for value in row) + "\n")

    def refused(self, *parts):
        result = program.command("soil", self.path, self.out)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for part in (self.path, *parts):
            self.assertIn(part, result.stderr)
        self.assertFalse(os.path.exists(self.out))

    def refused_with(self, row, column, value, *parts):
        rows = [list(values) for values in ROWS]
        rows[row][NAMES.index(column)] = value
        self.write(rows=rows)
        self.refused(*parts)

    def test_misfits_are_printed_and_doubted(self):
        self.write(rows=[[f] + [1e9, 1e8 * (1.5 + math.cos(9 * f))] * 3 + [1e11, 1e9 * f] * 3 for f in numpy.arange(0.5, 8, 0.5)])
        result = program.command("soil", self.path, self.out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        rows = result.stdout.splitlines()
        self.assertEqual(rows[0].split(), ["frequency,", "Hz", *(word for name in MOTIONS for word in (f"{name},", "%"))])
        self.assertEqual([float(row.split()[0]) for row in rows[1:16]], list(numpy.arange(0.5, 8, 0.5)))
        worst = max(float(row.split()[1]) for row in rows[1:16])
        self.assertGreater(worst, 10)
        self.assertEqual(result.stdout.count("warning: springs, dashpots and masses miss the table along"), 3)
        self.assertIn(f"miss the table along x by up to {worst:.3g} %", result.stdout)
        with open(self.out) as file:
            self.assertEqual(file.readline(), "pounding soil,1\n")
        self.assertEqual(program.command("soil", self.path, self.path).returncode, 2)

    def test_files(self):
        self.refused("No such file")
        self.write(names=["# nothing"], rows=[["# none"]])
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
            self.refused_with(2, "kzz_re", value, "line 4", f"'{value}' is no number")
        self.refused_with(3, "frequency", 2, "line 5", "does not increase")
        self.refused_with(0, "frequency", -1, "line 2", "Hz")

    def test_soil_that_cannot_be(self):
        self.refused_with(0, "kzz_re", -1e9, "line 2", "no stiffness", "lowest frequency")
        self.refused_with(4, "kxx_im", -1e8, "line 6", "give energy", "exp(-i omega t)")
        self.write(names=[*NAMES, "kxry_re", "kxry_im", "kryx_re", "kryx_im"], rows=[row + [1e9, 0, 2e9, 0] for row in ROWS])
        self.refused("line 2", "not symmetric", "kryx", "kxry")
        self.write(names=[*NAMES, "kxry_re", "kxry_im"], rows=[row + [2e10, 0] for row in ROWS])
        self.refused("line 2", "no stiffness")


if __name__ == "__main__":
    unittest.main()
