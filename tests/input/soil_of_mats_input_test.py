"""What is refused of soil that two mats share: one line, exit status 1, on one and two ranks."""
import os
import unittest

import numpy

import program
from decks import probes
from soil_tables import two_mats, write_parts


def pair(table, *more, mats=(1, 2)):
    words = ["-structures", "left,right", "-end_time", 0.01, *probes(a="left:body")]
    for name, mat in zip(("left", "right"), mats):
        words += [f"-{name}_mesh", "tests/meshes/mat.geo", f"-{name}_mesh_set", "legs=0,height=0", f"-{name}_body_element",
                  "point_mass", f"-{name}_body_mass", 1e6, f"-{name}_body_rotary_inertia", "1e8,1e8,1e8", f"-{name}_soil_mat", "body",
                  f"-{name}_soil_table", table, f"-{name}_soil_table_mat", mat]
    return [*words, *more, "-dry_run"]


class Refused(unittest.TestCase):
    def setUp(self):
        self.soil = two_mats()
        self.write()

    def write(self):
        self.table = write_parts(self.soil)
        self.addCleanup(os.remove, self.table)

    def refused(self, *parts, more=(), mats=(1, 2), on=(1,)):
        for ranks in on:
            program.must_refuse(self, pair(self.table, *more, mats=mats), *parts, ranks=ranks)

    def test_a_good_one_is_taken(self):
        for ranks in (1, 2):
            result = program.must_end(self, pair(self.table), ranks=ranks)
            self.assertIn("mat 1 of 2", result.stdout)
            self.assertIn("mat 2 of 2", result.stdout)

    def test_mats_and_structures(self):
        self.refused("-right_soil_table", "its mat 1 is that of left", "-right_soil_table_mat", mats=(1, 1), on=(1, 2))
        self.refused("-right_soil_table", "soil of 2 mats", "-right_soil_table_mat 3", mats=(1, 3))
        self.refused("-left_soil_table_mat", mats=(0, 2))
        self.refused("-left_soil_table", "its mat 2 is that of no structure", more=["-right_soil_table", write_parts(two_mats())])

    def test_what_does_not_go_with_it(self):
        self.refused("-right_soil_factor", "differs from that of left", more=["-right_soil_factor", 1.5])
        self.refused("-left_soil_table", "-export_matrices", more=["-export_matrices", "matrices"])
        self.refused("-left_soil_table_mat", "soil_table", more=["-left_soil_table", "none", "-left_soil_vs", 200, "-left_soil_density",
                                                                  2000, "-left_soil_poisson", 0.3, "-left_soil_size", "4,4"])

    def test_numbers_of_both_mats(self):
        """Soil that gives energy, by a motion of both; that holds nothing when both move alike; no symmetry; names of motions."""
        self.soil.dashpots[0, 6] = self.soil.dashpots[6, 0] = 3e8
        self.write()
        self.refused("would give energy: the least eigenvalue of the dashpots", on=(1, 2))
        self.soil = two_mats()
        self.soil.stiffness[2, :] = self.soil.stiffness[:, 2] = 0
        self.soil.stiffness[8, :] = self.soil.stiffness[:, 8] = 0
        for i, j, value in ((2, 2, 1e9), (8, 8, 1e9), (2, 8, -1e9), (8, 2, -1e9)):
            self.soil.stiffness[i, j] = value
        self.write()
        self.refused("no stiffness against some motion")
        self.soil = two_mats()
        self.soil.masses[4, 7] = 1e5
        self.write()
        self.refused("at y2 ry1 of the masses")
        self.soil = two_mats()
        self.soil.hidden[0].motion = numpy.zeros(12)
        self.write()
        self.refused("against no motion")


if __name__ == "__main__":
    unittest.main()
