"""Joints of random width: gaps of the rows of a face, the same on every number of ranks, in every run with the seed.

Two walls of shells face each other; gaps come from the exported rows of the contact. The statistics of the field itself
are those of unit/interactions/gap_field_test.cpp."""
import os
import tempfile
import unittest

import numpy

import program
import two_buildings
from input.corpus.meshes import document


def sheet(path, turn, away):
    """A sheet of 3 x 4 quadrangles with its edge below, its normal (cos turn, sin turn, 0), so far along that."""
    cosine, sine = numpy.cos(turn), numpy.sin(turn)
    nodes = {5 * j + i + 1: (away * cosine - i * sine, away * sine + i * cosine, j) for j in range(4) for i in range(5)}
    cells = [(1 + 4 * j + i, 3, 1, [5 * j + i + k for k in (1, 2, 7, 6)]) for j in range(3) for i in range(4)]
    edge = [(20 + i, 1, 2, (i + 1, i + 2)) for i in range(4)]
    with open(path, "w") as file:
        file.write(document(nodes, cells + edge, {1: (2, "sheet"), 2: (1, "held")}))
    return path


class GapField(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.one = cls().field(1)

    def gaps(self, *words, ranks=program.RANKS, contact="floor1"):
        with tempfile.TemporaryDirectory() as folder:
            program.must_end(self, ["-options_file", str(two_buildings.SCENE), "-modes", 0, "-dry_run",
                                      "-floor1_gap", .05, "-left_damping_reference", 3, "-right_damping_reference", 4,
                                      "-export_matrices", folder, *words], ranks)
            columns = program.read_csv(os.path.join(folder, "left", "gaps.csv"))
        return numpy.array([float(gap) for name, gap in zip(columns["contact"], columns["initial_gap"]) if name == contact])

    def field(self, seed, *words, **more):
        return self.gaps("-floor1_gap_deviation", .008, "-floor1_gap_length", 1.5, "-floor1_gap_seed", seed, *words, **more)

    def test_every_pair_has_a_gap_of_its_own(self):
        uniform, one = self.gaps(), self.one
        numpy.testing.assert_array_equal(uniform, .05)
        self.assertEqual(len(numpy.unique(one)), len(one))
        self.assertLess(abs(one - .05).max(), 5 * .008)
        self.assertGreater(abs(one - .05).max(), .1 * .008)
        self.assertFalse((one == self.field(2)).any())

    def test_ranks_and_other_contacts_do_not_change_it(self):
        one = self.one
        numpy.testing.assert_array_equal(self.field(1, ranks=3), one)
        both = ["-floor2_gap", .05, "-floor2_gap_deviation", .008, "-floor2_gap_length", 1.5]
        numpy.testing.assert_array_equal(self.field(1, *both), one)
        self.assertFalse((self.field(1, *both, contact="floor2")[:len(one)] == one).any())

    def test_it_lies_on_the_gap_that_is_given(self):
        slope = self.gaps("-floor1_gap", ".04,.06") - .05
        numpy.testing.assert_allclose(self.field(1, "-floor1_gap", ".04,.06"), self.one + slope, rtol=1e-14)

    def test_its_length_is_along_the_face_however_that_is_turned(self):
        """Two sheets, upright, that face each other along their normal."""
        def facing(turn):
            with tempfile.TemporaryDirectory() as folder:
                words = ["-structures", "a,b", "-contacts", "joint", "-joint_secondary", "a:sheet", "-joint_primary", "b:sheet",
                         "-joint_gap", .05, "-joint_gap_deviation", .008, "-joint_gap_length", 1.5, "-modes", 0, "-dry_run",
                         "-end_time", 1e-5, "-material_m_young", 3e10, "-material_m_poisson", .2, "-material_m_density", 2000,
                         "-export_matrices", folder]
                for name, away in (("a", 0), ("b", 1)):
                    words += [f"-{name}_mesh", sheet(os.path.join(folder, name + ".msh"), turn, away), f"-{name}_sheet_element",
                              "shell", f"-{name}_sheet_material", "m", f"-{name}_sheet_thickness", .2, f"-{name}_clamp", "held"]
                program.must_end(self, words)
                return numpy.array(program.read_csv(os.path.join(folder, "a", "gaps.csv"))["initial_gap"], float)
        straight = facing(0)
        self.assertGreater(numpy.ptp(straight), .008)
        for turn in (.3, .7, -.7):
            numpy.testing.assert_allclose(facing(turn), straight, rtol=1e-7)

    def test_refused(self):
        scene = ["-options_file", str(two_buildings.SCENE), "-dry_run", "-floor1_gap", .05, "-floor1_gap_deviation", .008]
        program.must_refuse(self, scene, "-floor1_gap_length")
        program.must_refuse(self, [*scene, "-floor1_gap_length", 0], "-floor1_gap_length")
        program.must_refuse(self, [*scene, "-floor1_gap_length", 1, "-floor1_along", "1,0,0"], "-floor1_gap_deviation", "makes it a stop")


if __name__ == "__main__":
    unittest.main()
