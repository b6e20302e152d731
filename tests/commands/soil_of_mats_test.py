"""run/soil of several mats: the fit gives no energy, tables go through their file, impedances of MISS3D as text, rectangles on a
half-space beside single mats, far mats and reciprocity, and what is refused of each file."""
import math
import os
import tempfile
import unittest
from pathlib import Path

import numpy

import program
from soil_tables import two_mats, write_table

from pounding.soil import fit, half_space, impedances, miss  # soil_tables puts it on the path

GROUND = half_space.Ground(200.0, 2000.0, 1 / 3, 0.02)
SQUARE, BESIDE = half_space.Mat((0.0, 0.0), (8.0, 8.0)), half_space.Mat((8.6, 0.0), (8.0, 8.0))
MODULUS, HALF = 8e7, 4.0
FREQUENCIES = numpy.linspace(0.5, 20, 40)
YAML = """ground: {vs: 200, density: 2000, poisson: 0.3333333333333333, damping: 0.02}
mats:
- {middle: [0, 0], sides: [8, 8]}
- {middle: [8.6, 0], sides: [8, 8]}
frequencies: {first: 0.5, last: 20, count: 40}
cells: 6
"""


def sizes_at(matrix):
    return abs(matrix) / impedances.sizes_of(matrix)


class HalfSpace(unittest.TestCase):
    def test_single_mats(self):
        """Static stiffness of a square by Pais and Kausel for Poisson's ratio 1/3."""
        table = half_space.impedances([half_space.Mat((3.0, 1.0), (8.0, 8.0))], GROUND, [0.05], 10)
        found = numpy.diag(table.matrix[0]).real / (MODULUS * HALF) / numpy.array([1] * 3 + [HALF**2] * 3)
        ratio = found / (5.52, 5.52, 7.05, 6.00, 6.00, 8.31)
        self.assertLess(abs(ratio[:3] - 1).max(), 0.03)
        self.assertLess(abs(ratio[3:] - 1).max(), 0.05)

    def test_finer_patches_converge(self):
        values = [numpy.diag(half_space.impedances([SQUARE], GROUND, [5.0], cells).matrix[0]) for cells in (4, 8, 12)]
        first, second = (abs(values[k] - values[k + 1]) / abs(values[2]) for k in (0, 1))
        self.assertLess((second / first).max(), 0.5)

    def test_radiation_of_a_wide_mat(self):
        """At high frequencies a mat sends plane waves down: rho V_s A along x, rho V_p A along z."""
        matrix = half_space.impedances([SQUARE], GROUND, [60.0], 16).matrix[0]
        rate = matrix.imag / (2 * math.pi * 60 * 2000 * 200 * 64)
        self.assertAlmostEqual(rate[0, 0], 1, delta=0.1)
        self.assertAlmostEqual(rate[2, 2], 2, delta=0.2)

    def test_far_mats_are_two_mats(self):
        """What is left falls as waves spread, with a damping of 5 % below 1e-3 at 100 widths, and each is as if alone."""
        ground = half_space.Ground(200.0, 2000.0, 1 / 3, 0.05)
        alone = half_space.impedances([SQUARE], ground, [4.0], 3).matrix[0]
        away = [half_space.impedances([SQUARE, half_space.Mat((distance, 0.0), (8.0, 8.0))], ground, [4.0], 3).matrix[0]
                for distance in (100.0, 800.0)]
        far = [sizes_at(one)[:6, 6:].max() for one in away]
        self.assertLess(far[1], 1e-3)
        self.assertLess(far[1], far[0] / 4)
        self.assertLess((abs(away[1][:6, :6] - alone) / impedances.sizes_of(alone)).max(), 1e-5)

    def test_a_quarter_turn_and_a_swap(self):
        """Mats beside each other along y are those along x, turned; the order of mats is that of the rows."""
        along_x = half_space.impedances([SQUARE, BESIDE], GROUND, [6.0], 4).matrix[0]
        along_y = half_space.impedances([SQUARE, half_space.Mat((0.0, 8.6), (8.0, 8.0))], GROUND, [6.0], 4).matrix[0]
        turn = numpy.kron(numpy.eye(4), [[0, -1, 0], [1, 0, 0], [0, 0, 1]])
        size = impedances.sizes_of(along_x)
        self.assertLess((abs(turn @ along_x @ turn.T - along_y) / size).max(), 1e-10)
        swap = numpy.roll(numpy.arange(12), 6)
        swapped = half_space.impedances([BESIDE, SQUARE], GROUND, [6.0], 4).matrix[0]
        self.assertLess((abs(along_x[numpy.ix_(swap, swap)] - swapped) / size).max(), 1e-10)

    def test_rigid_motion_of_both(self):
        """Two halves of a mat, moved as one, are the whole mat."""
        halves = half_space.impedances([half_space.Mat((x, 0.0), (4.0, 8.0)) for x in (-2.0, 2.0)], GROUND, [3.0], 4).matrix[0]
        whole = half_space.impedances([SQUARE], GROUND, [3.0], 8).matrix[0]
        both = numpy.zeros((12, 6))
        for first, x in ((0, -2.0), (6, 2.0)):
            both[first:first + 6] = numpy.eye(6)
            both[first + 1, 5], both[first + 2, 4] = x, -x
        self.assertLess((abs(both.T @ halves @ both - whole) / impedances.sizes_of(whole)).max(), 1e-10)


class Fit(unittest.TestCase):
    def assert_passive(self, soil):
        """At 600 frequencies, from a thousandth of the first to a thousand times the last."""
        whole = soil.at(2 * math.pi * numpy.geomspace(5e-4, 2e4, 600))
        self.assertGreater(numpy.linalg.eigvalsh(whole.imag / impedances.sizes_of(whole))[:, 0].min(), -1e-12)
        for matrix in (soil.stiffness, soil.dashpots, soil.masses):
            self.assertEqual(abs(matrix - matrix.T).max(), 0)

    def test_mats_on_a_half_space(self):
        table = half_space.impedances([SQUARE, BESIDE], GROUND, FREQUENCIES, 6)
        self.assertGreater(numpy.linalg.eigvalsh(table.matrix.imag).min(), 0)
        soil, blocks, left_out = fit.fit(table)
        self.assertEqual([block.names for block in blocks], ["x1 z1 ry1 x2 z2 ry2", "y1 rx1 rz1 y2 rx2 rz2"])
        self.assertLess(left_out, 1e-12)
        self.assertLess(max(block.misfit.max() for block in blocks), 0.06)
        self.assertLess(max(block.misfit.mean() for block in blocks), 0.03)
        self.assertGreater(sizes_at(soil.at(numpy.array([2 * math.pi * 5]))[0])[0, 6], 0.1)
        self.assert_passive(soil)

    def test_tables_go_through_their_file(self):
        whole = two_mats()
        path = write_table(lambda omega: whole.at(numpy.array([omega]))[0], FREQUENCIES)
        self.addCleanup(os.remove, path)
        table = impedances.read(Path(path))
        exact = whole.at(2 * math.pi * FREQUENCIES)
        self.assertLess((abs(table.matrix - exact) / impedances.sizes_of(exact)).max(), 1e-14)
        impedances.write(Path(path), table, "again")
        self.assertTrue(numpy.array_equal(impedances.read(Path(path)).matrix, table.matrix))


class Command(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.out = os.path.join(folder.name, "soil.csv")

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w") as file:
            file.write(text)
        return path

    def refused(self, path, *parts):
        result = program.command("soil", path, self.out)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for part in (path, *parts):
            self.assertIn(part, result.stderr)
        self.assertFalse(os.path.exists(self.out))

    def test_mats_on_a_half_space(self):
        path = self.write("pair.yaml", YAML)
        kept = os.path.join(self.folder, "table.csv")
        result = program.command("soil", path, self.out, "--impedances", kept)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("x1 z1 ry1 x2 z2 ry2", result.stdout)
        with open(self.out) as file:
            self.assertIn("mats,2\n", file.readlines())
        table = impedances.read(Path(kept))
        expected = half_space.impedances([SQUARE, BESIDE], GROUND, FREQUENCIES, 6)
        self.assertLess((abs(table.matrix - expected.matrix) / impedances.sizes_of(expected.matrix)).max(), 1e-12)

    def test_half_spaces_that_cannot_be_meant(self):
        for old, new, *parts in (("[8.6, 0]", "[7, 0]", "mats: 2: middle", "lays it over mat 1"), ("vs: 200", "vs: -1", "vs", "above 0"),
                                 ("damping: 0.02", "damping: 0", "damping", "not above 0.001"), ("cells: 6", "cells: 60", "patches"),
                                 ("sides: [8, 8]}\n-", "sides: [8]}\n-", "mats: 1: sides", "pair"), ("cells", "cell", "cell is unknown"),
                                 ("last: 20", "last: 0.1", "last", "above")):
            self.refused(self.write("pair.yaml", YAML.replace(old, new, 1)), *parts)

    def test_columns_of_several_mats(self):
        header = ",".join(["frequency", *(f"k{name}{name}_{part}" for name in impedances.motions_of(2) for part in ("re", "im"))])
        self.refused(self.write("table.csv", header.replace("kz2z2_im", "kzz_im") + "\n"), "line 1", "'kzz_im'", "kx1x1_re")
        self.refused(self.write("table.csv", header.replace(",kz2z2_im", "") + "\n"), "line 1", "no column 'kz2z2_im'")
        self.refused(self.write("table.csv", header + ",kx1x99_re\n"), "line 1", "99 mats")

    def miss(self, matrices, frequencies, header="CHAMP {} {}"):
        """Text of MISS3D: title, then term by term, rows fastest, of motions exp(-i omega t)."""
        lines = ["IMPEDANCES"]
        for column in range(matrices.shape[1]):
            for row in range(matrices.shape[1]):
                lines.append(header.format(row + 1, column + 1))
                lines += [f" {f:.9E} {value.real:.15E} {-value.imag:.15E} {abs(value):.3E}"
                          for f, value in zip(frequencies, matrices[:, row, column])]
        return "\n".join(lines) + "\n"

    def test_impedances_of_miss(self):
        matrices = two_mats().at(2 * math.pi * FREQUENCIES)
        path = self.write("impe.txt", self.miss(matrices, FREQUENCIES))
        table = miss.read(Path(path))
        self.assertTrue(numpy.allclose(table.frequency, FREQUENCIES, rtol=1e-8))
        self.assertLess((abs(table.matrix - matrices) / impedances.sizes_of(matrices)).max(), 1e-13)
        self.assertEqual(table.mats, 2)
        lines = self.miss(matrices[:, :6, :6], FREQUENCIES).split("\n")
        tall = Path(self.write("one.txt", "\n".join(lines)))
        self.assertEqual(miss.read(tall).mats, 1)
        self.refused(self.write("bad.txt", "\n".join(lines[:9] + [" 4.5 much 0"] + lines[10:])), "line 10", "'4.5 much 0'")
        self.refused(self.write("bad.txt", "\n".join(lines[:-42])), "35 terms")
        self.refused(self.write("bad.txt", "\n".join(lines[:-5])), "terms of 40 frequencies")
        self.refused(self.write("bad.txt", self.miss(matrices[:, :6, :6].conj(), FREQUENCIES)), "line 3", "give energy")


if __name__ == "__main__":
    unittest.main()
