"""What is refused of ties: one line with the place, exit status 1, on one and two ranks."""
import unittest

import program

BLOCKS = ["-structures", "t", "-t_mesh", "tests/meshes/tied_blocks.geo", "-t_first_element", "hex8",
          "-t_first_material", "c", "-t_second_element", "hex8", "-t_second_material", "c", "-material_c_young", 30e9,
          "-material_c_poisson", 0.2, "-material_c_density", 2400, "-end_time", 1e-4]
HELD = ["-t_clamp", "x_min"]


class Refused(unittest.TestCase):
    def refused(self, words, *parts, parameters="m2=3"):
        program.must_refuse(self, BLOCKS + ["-t_mesh_set", parameters] + words + ["-dry_run"], *parts)

    def test_groups(self):
        self.refused(HELD + ["-t_tie", "edge"], "-t_tie", "does not name two groups")
        self.refused(HELD + ["-t_tie", "edge:edge"], "-t_tie", "does not name two groups")
        self.refused(HELD + ["-t_tie", "edge:fcae"], "-t_tie", "group 'fcae' is not in")
        self.refused(HELD + ["-t_tie", "egde:face"], "-t_tie", "group 'egde' is not in")
        self.refused(HELD + ["-t_tie", "edge:face,edge:face"], "-t_tie", "appears twice")
        self.refused(HELD + ["-t_tie", "edge:face", "-t_join", "edge:face"], "is given here, or in another")
        self.refused(HELD + ["-t_tie", "edge:corner"], "-t_tie edge:corner", "no faces or lines")
        self.refused(HELD + ["-t_tie", "edge:first"], "-t_tie edge:first", "no faces or lines")

    def test_nothing_near(self):
        self.refused(HELD + ["-t_tie", "edge:face"], "its node at (2.1, 0, 0) lies 1.1 m", "longest edge, 0.5 m",
                     parameters="m2=3,gap=1.1")
        self.refused(HELD + ["-t_tie", "x_max:face"], "lies 1 m from the nearest facet of 'face'")

    def test_chains(self):
        self.refused(HELD + ["-t_tie", "edge:face,face:edge"], "its node at (1, 0, 0) would follow the node at",
                     "turn one of the ties round")
        self.refused(HELD + ["-t_tie", "edge:face,corner:face"], "-t_tie corner:face", "follows another tie already")
        self.refused(HELD + ["-t_tie", "face:x_max"], "lies 1 m")
        self.refused(HELD + ["-t_tie", "corner:edge"], "its node at (1, 1, 0)", "mesh joins them already")

    def test_clamped(self):
        self.refused(["-t_clamp", "edge", "-t_tie", "edge:face"], "in components that would follow 'face'")
        self.refused(["-t_clamp", "x_min,edge:y", "-t_tie", "edge:face"], "in components that would follow 'face'")

    def test_in_rigid_groups(self):
        self.refused(HELD + ["-t_rigid", "edge", "-t_tie", "edge:face"], "is in rigid group edge")
        self.refused(HELD + ["-t_rigid", "face", "-t_tie", "edge:face"], "would follow rigid group face")

    def test_lines_without_rotations(self):
        plates = ["-t_second_element", "shell", "-t_second_thickness", 0.2]
        self.refused(HELD + plates + ["-t_tie", "corner:rim"], "turns, but the line of 'rim'",
                     parameters="m2=3,plates=2,level=0,rims=1")
        self.refused(HELD + ["-t_tie", "corner:rim"], "lies beside its line", parameters="m2=3,gap=0.1,rims=1")

    def test_matrices(self):
        self.refused(HELD + ["-t_tie", "edge:face", "-t_matrices", "somewhere"], "-t_tie", "not with -t_matrices")
        self.refused(HELD + ["-t_tie", "edge:face", "-export_matrices", "somewhere"], "has tie edge:face",
                     "of which no matrix tells")

    def test_clamps_of_both_are_taken(self):
        """Symmetry planes that hold both sides: what is clamped follows what is clamped."""
        result = program.must_end(self, BLOCKS + ["-t_mesh_set", "m2=3", "-t_clamp", "x_min:x,y_min:y,z_min:z",
                                  "-t_tie", "edge:face", "-dry_run"])


if __name__ == "__main__":
    unittest.main()
