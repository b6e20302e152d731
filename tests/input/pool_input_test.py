"""What is refused of a pool: one line, exit status 1."""
import unittest

import program

BASIN = ["-structures", "t", "-t_body_element", "shell", "-t_body_material", "concrete", "-t_body_thickness", .2,
         "-material_concrete_young", 3e10, "-material_concrete_poisson", .2, "-material_concrete_density", 2400, "-t_clamp", "floor",
         "-t_ignore", "walls,high_x,low_x,tank", "-end_time", .01, "-dry_run"]
POOL = ["-pools", "tank", "-tank_structure", "t", "-tank_faces", "body", "-tank_level", 2.5]


class Refused(unittest.TestCase):
    def refused(self, words, *parts, mesh="h=3", ranks=1):
        program.must_refuse(self, [*BASIN, "-t_mesh", "tests/meshes/basin.geo", "-t_mesh_set", mesh, *POOL, *words], *parts, ranks=ranks)

    def test_options(self):
        for option, value in (("structure", "u"), ("faces", "none"), ("faces", "body,body"), ("level", "high"), ("density", 0), ("density", -1),
                              ("modes", 0), ("modes", 10), ("damping", 1), ("gravity", 0), ("freeboard", -1)):
            self.refused([f"-tank_{option}", value], f"-tank_{option} {value}")
        self.refused(["-tank_depth", 2], "-tank_depth")
        self.refused(["-t_matrices", "somewhere"], "-tank_structure t", "-t_matrices")
        switched = ["-t_model", "switched", "-t_modal_vectors", 5]
        self.refused([*switched, "-t_damping_alpha", 1], "-tank_structure t", "alpha", "-t_model switched")
        self.refused([*switched, "-t_damping_ratio", .05, "-t_damping_frequencies", "5,50"], "-tank_structure t", "alpha")

    def test_faces(self):
        for ranks in (1, 2):
            self.refused(["-tank_faces", "basin"], "-tank_faces", "'basin'", "walls", ranks=ranks)
            self.refused(["-tank_faces", "walls"], "-tank_faces", "the floor has none", ranks=ranks)
        self.refused(["-tank_faces", "floor"], "-tank_faces", "the wall at x = 0 m has none", "open")
        self.refused(["-tank_faces", "tank"], "-tank_faces", "the wall at y = 0 m has none", "open", mesh="h=3,open=1")
        self.refused(["-tank_faces", "body,high_x"], "-tank_faces", "the wall at x = 6 m has 24 m2, and as a rectangle it has 12 m2")
        self.refused([], "-tank_faces", "no rectangle", mesh="h=3,tilt=.2")
        self.refused([], "-tank_faces", "the wall at x = 0 m", "as a rectangle", mesh="h=3,lower=.1")

    def test_level(self):
        self.refused(["-tank_level", 3.2], "-tank_level", "z = 3 m")
        self.refused(["-tank_level", 0], "-tank_level", "z = 0 m", "leave the pool out")
        self.refused(["-tank_level", .5], "-tank_level", "too few rows of nodes", mesh="h=3,nz=3")

    def test_water_options(self):
        """Beside cells a pool has neither faces nor waves, and its structure nothing that leaves their mass out."""
        for option, value in (("faces", "body"), ("level", 2.5), ("modes", 2), ("damping", .01), ("gravity", 9.8), ("freeboard", 1)):
            self.refused_water([f"-tank_{option}", value], f"-tank_{option} {value}", "-tank_water")
        self.refused_water(["-tank_density", 0], "-tank_density 0")
        for words, other in ((["-t_mass_scaling", 1e-3], "-t_mass_scaling"),
                             (["-t_time_step_target", 1e-3], "-t_time_step_target"),
                             (["-t_model", "switched", "-t_modal_vectors", 5, "-t_switched_part", .01], "-t_model switched"),
                             (["-t_model", "modal", "-t_modal_vectors", 5, "-t_damping_alpha", 1], "-t_damping_alpha"),
                             (["-t_model", "modal", "-t_modal_vectors", 5, "-t_initial_velocity", "1,0,0"], "-t_model modal"),
                             (["-supports", "s", "-s_groups", "t:floor", "-s_delay", .1, "-motion_x_record", program.write_samples([0, 1, 0], .01),
                               "-motion_x_time_step", .01, "-motion_x_unit", "m/s2"], "-supports s")):
            self.refused_water(words, "-tank_water water", other)
        self.refused_water(["-export_matrices", "somewhere"], "-export_matrices", "-tank_water")
        self.refused_water(["-t_clamp", "none", "-t_rigid", "high_x"], "-tank_water", "moves with high_x", ranks=2)

    def test_cells(self):
        self.refused_water(["-tank_water", "none"], "-tank_water", "'none'", "walls")
        self.refused_water(["-tank_water", "walls"], "-tank_water walls", "no volume cells", ranks=2)
        self.refused_water([], "-tank_water water", "its face around (", "line it with elements", mesh="water=1,half=1")
        self.refused_water(["-t_water_element", "hex8", "-t_water_material", "concrete"], "-tank_water water", "name each cell once")
        self.refused_water(["-pools", "tank,other", "-other_structure", "t", "-other_water", "water"], "-other_water water", "name each cell once")

    def refused_water(self, words, *parts, mesh="water=1", ranks=1):
        program.must_refuse(self, [*BASIN, "-t_mesh", "tests/meshes/basin.geo", "-t_mesh_set", mesh, "-pools", "tank", "-tank_structure", "t",
                                   "-tank_water", "water", *words], *parts, ranks=ranks)


if __name__ == "__main__":
    unittest.main()
