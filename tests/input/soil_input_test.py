"""What is refused of a mat on soil: one line, exit status 1, on one and two ranks."""
import unittest

import program

BODY = ["-structures", "block", "-block_mesh", "tests/meshes/mat.geo", "-block_body_element", "point_mass",
        "-block_body_mass", 2e6, "-block_corners_element", "point_mass", "-block_corners_mass", 1e3,
        "-block_legs_element", "spring", "-block_legs_stiffness", "4e9,4e9,4e9", "-end_time", 0.01]
TURNS = ["-block_body_rotary_inertia", "1e8,1e8,1e8"]
GROUND = ["-block_soil_vs", 300, "-block_soil_density", 2000, "-block_soil_poisson", 0.3]
MAT = ["-block_soil_mat", "mat"]


class Refused(unittest.TestCase):
    def refused(self, words, *parts):
        program.must_refuse(self, BODY + words + ["-dry_run"], *parts)

    def test_what_is_missing(self):
        for name in ("vs", "density", "poisson"):
            at = GROUND.index(f"-block_soil_{name}")
            self.refused(TURNS + MAT + GROUND[:at] + GROUND[at + 2:], f"missing option -block_soil_{name}")
        self.refused(TURNS + GROUND, "-block_soil_vs 300", "goes with -block_soil_mat")
        self.refused(TURNS + GROUND + ["-block_soil_mat", "none"], "goes with -block_soil_mat")

    def test_values(self):
        for option, value in (("vs", 1e300), ("size", "1e300,1e300"), ("embedment", 1e300), ("density", 1e-300), ("vs", 0),
                              ("density", -1), ("poisson", 0.5), ("poisson", -0.1), ("embedment", -1),
                              ("shape", "oval"), ("size", "1,2,3"), ("size", "3"), ("size", "0,4"),
                              ("frequency_dependence", "perhaps")):
            self.refused(TURNS + MAT + GROUND + [f"-block_soil_{option}", value], f"-block_soil_{option} {value}")

    def test_disk(self):
        disk = TURNS + MAT + GROUND + ["-block_soil_shape", "disk"]
        self.refused(disk + ["-block_soil_size", "3,4"], "-block_soil_size 3,4", "one diameter")
        self.refused(disk + ["-block_soil_embedment", 2], "-block_soil_embedment 2", "only rectangles")

    def test_mat(self):
        self.refused(TURNS + GROUND + ["-block_soil_mat", "mta"], "-block_soil_mat mta", "group")
        self.refused(MAT + GROUND, "-block_soil_mat mat", "has rotations")
        self.refused(TURNS + GROUND + ["-block_soil_mat", "corners"], "-block_soil_mat corners", "has rotations")
        self.refused(TURNS + MAT + GROUND + ["-block_clamp", "corners"], "-block_soil_mat mat", "clamped")
        self.refused(TURNS + MAT + GROUND + ["-block_clamp", "body:rz"], "-block_soil_mat mat", "clamped")
        self.refused(TURNS + GROUND + ["-block_soil_mat", "body"], "-block_soil_mat body", "-block_soil_size")

    def test_beside_matrices(self):
        self.refused(TURNS + MAT + GROUND + ["-block_matrices", "somewhere"], "-block_soil_mat mat", "-block_matrices")


if __name__ == "__main__":
    unittest.main()
