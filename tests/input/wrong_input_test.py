"""Wrong inputs: one line from the program that says what is wrong, exit status 1 on every rank."""
import os
import tempfile
import unittest

import program
from decks import in_modes, material

CASE = program.COARSE_PAIR + ["-end_time", "0.001"]


class WrongInput(unittest.TestCase):
    def refuse(self, arguments, *words, ranks=1):
        """The program refuses the arguments with one line that holds all the words."""
        with tempfile.TemporaryDirectory() as folder:
            output = os.path.join(folder, "results")
            program.must_refuse(self, list(arguments) + ["-output", output], *words, ranks=ranks, timeout=120)
            self.assertFalse(os.path.exists(os.path.join(output, "summary.json")))

    def with_file(self, text, suffix=".txt"):
        handle, path = tempfile.mkstemp(suffix=suffix)
        with os.fdopen(handle, "w") as file:
            file.write(text)
        return path

    def test_missing_options_file(self):
        self.refuse(["-options_file", "nowhere.yaml"], "nowhere.yaml", "no such file")

    def test_broken_yaml(self):
        path = self.with_file("s1: {mesh: a.geo\n  b: [\n", ".yaml")
        self.refuse(["-options_file", path], path, "YAML")

    def test_no_options_at_all(self):
        self.refuse([], "-structures")

    def test_missing_mesh(self):
        self.refuse(CASE + ["-s1_mesh", "meshes/none.geo", "-s1_mesh_set", "none"], "meshes/none.geo",
                    "no such file")

    def test_mesh_that_gmsh_cannot_read(self):
        path = self.with_file("this is no mesh", ".msh")
        self.refuse(CASE + ["-s1_mesh", path, "-s1_mesh_set", "none"], path)

    def test_unknown_mesh_parameter(self):
        self.refuse(CASE + ["-s1_mesh_set", "cels_x=7"], "cels_x")

    def test_unknown_group_in_a_region(self):
        self.refuse(CASE + ["-s1_slob_element", "hex8", "-s1_slob_material", "concrete"], "slob",
                    "which has", "slab")

    def test_unknown_clamp_group(self):
        self.refuse(CASE + ["-s2_clamp", "bottom"], "bottom", "base")
        self.refuse(CASE + ["-s2_clamp", "base:up"], "base:up", "x, y, z, rx, ry, rz")

    def test_wrong_element_for_a_group(self):
        self.refuse(CASE + ["-s1_column_element", "hex8", "-s1_column_section", "none"], "column")

    def test_unknown_option_with_the_nearest_name(self):
        self.refuse(CASE + ["-s1_dampng_beta", "1e-5"], "-s1_dampng_beta", "-s1_damping_beta")

    def test_typo_in_a_value(self):
        self.refuse(CASE + ["-courant", "0,9"], "-courant", "0,9")

    def test_value_out_of_range(self):
        self.refuse(CASE + ["-material_concrete_young", "-30e9"], "-material_concrete_young")

    def test_not_a_number_in_an_option(self):
        self.refuse(CASE + ["-end_time", "nan"], "-end_time", "nan")

    def test_decimal_commas(self):
        for option, value in (("-floor1_gap", "0,05"), ("-floor1_gap", "0,00"), ("-s1_gravity", "0,05,-9,81"),
                              ("-spectra_damping", "0,02"), ("-courant", "0,9")):
            self.refuse(CASE + [option, value], option, f"decimals have a point, is {value[:4].replace(',', '.')}")

    def test_not_a_number_in_the_record(self):
        path = self.with_file("0.0 0.0\n0.01 0.1\n0.02 nan\n0.03 0.0\n")
        self.refuse(CASE + ["-motion_x_record", path, "-motion_x_unit", "g"], path, "3")

    def test_missing_record(self):
        self.refuse(CASE + ["-motion_x_record", "none.AT2"], "none.AT2")

    def test_nothing_that_vibrates(self):
        line = 'Point(1) = {0, 0, 0}; Physical Point("p") = {1};'
        scene = ["-structures", "m", "-m_p_element", "point_mass", "-m_p_mass", "1", "-end_time", "1", "-m_mesh"]
        self.refuse([*scene, self.with_file(line + "\n", ".geo")], "-time_step")
        self.refuse([*scene, self.with_file(line, ".geo")], "line 1", "end the line")

    def test_time_step_above_the_stable_one(self):
        self.refuse(CASE + ["-time_step", "1e-3"], "-time_step", "stable")

    def test_unknown_contact_group(self):
        self.refuse(CASE + ["-floor1_primary", "s2:face9"], "face9", "face1")

    def test_faces_that_look_away(self):
        self.refuse(CASE + ["-floor1_primary", "s1:face1"], "floor1")

    def test_clamped_contact_face(self):
        self.refuse(CASE + ["-s2_clamp", "base,face1"], "floor1", "clamped")

    def test_shell_without_thickness(self):
        self.refuse(CASE + ["-s1_mesh_set", "slab=1,cells_x=7,cells_y=5", "-s1_slab_element", "shell"],
                    "-s1_slab_thickness")

    def test_section_without_orientation(self):
        self.refuse(CASE + ["-s1_beam_section", "bare", "-section_bare_area", "1e-3",
                            "-section_bare_inertia_y", "1e-6", "-section_bare_inertia_z", "1e-6",
                            "-section_bare_torsion", "1e-6"], "-section_bare_z_axis")

    def test_orientation_along_the_beam(self):
        self.refuse(CASE + ["-section_heb120_z_axis", "0,0,1"], "group 'column'", "element")

    def test_option_of_another_element(self):
        self.refuse(CASE + ["-s1_slab_area", "1"], "-s1_slab_area", "hex8")

    def lines(self, second_point):
        """A mesh of one line from the origin to a point, with the group "p" at the origin."""
        return self.with_file(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n0 1 \"p\"\n1 2 \"l\"\n"
            f"$EndPhysicalNames\n$Nodes\n2\n1 0 0 0\n2 {second_point}\n$EndNodes\n"
            "$Elements\n2\n1 15 2 1 1 1\n2 1 2 2 1 1 2\n$EndElements\n", ".msh")

    def test_tetrahedra(self):
        mesh = self.with_file('SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 1, 1, 1};\n'
                              'Physical Volume("body") = {1};\n', ".geo")
        self.refuse(["-structures", "m", "-m_mesh", mesh, "-m_body_element", "hex8", "-m_body_material", "c",
                     *material("c", "1", "0", "1"), "-end_time", "1"], "group 'body'", "Tetrahedron",
                    "hex8")

    def test_bar_of_zero_length(self):
        self.refuse(["-structures", "m", "-m_mesh", self.lines("0 0 0"), "-m_l_element", "bar", "-m_l_material", "s",
                     "-m_l_area", "1", *material("s", "1", "0", "1"), "-end_time", "1"],
                    "element 2 of group 'l'", "two of its nodes")

    def test_spring_to_a_node_without_mass(self):
        self.refuse(["-structures", "m", "-m_mesh", self.lines("1 0 0"), "-m_l_element", "spring",
                     "-m_l_stiffness", "1,1,1", "-m_p_element", "point_mass", "-m_p_mass", "1",
                     "-end_time", "1"], "(1, 0, 0)", "no mass")

    def test_unknown_model(self):
        self.refuse(CASE + ["-s1_model", "reduced"], "-s1_model reduced", "full modal")

    def test_modal_model_without_a_size(self):
        self.refuse(CASE + ["-s1_model", "modal"], "-s1_modal_vectors", "-s1_modal_cutoff")

    def test_modal_model_of_no_vectors(self):
        self.refuse(CASE + [*in_modes("s1", "0")], "-s1_modal_vectors 0", ">= 1")

    def test_modal_model_with_two_sizes(self):
        self.refuse(CASE + [*in_modes("s1", "9"), "-s1_modal_cutoff", "50"],
                    "-s1_modal_cutoff 50", "not both")

    def test_cut_off_below_every_mode(self):
        self.refuse(CASE + ["-s1_model", "modal", "-s1_modal_cutoff", "0.1"], "-s1_modal_cutoff 0.1",
                    "no mode")

    def test_modal_option_of_a_full_model(self):
        self.refuse(CASE + ["-s2_modal_vectors", "9"], "-s2_modal_vectors 9", "-s2_model modal")

    def test_modal_model_that_is_all_clamped(self):
        self.refuse(CASE + [*in_modes("s1", "9"), "-contacts", "none",
                            "-s1_clamp", "base,column,slab,beam,joint_beam,joint_column,brace1,brace2"],
                    "s1", "clamp")

    def test_wall_without_a_distance(self):
        self.refuse(CASE + ["-floor1_primary", "wall", "-floor1_gap", "geometry"], "-floor1_gap", "wall")

    def test_probe_far_from_the_mesh(self):
        self.refuse(CASE + ["-s1_floor1_at", "50,0,0"], "-s1_floor1_at")

    def test_output_that_cannot_be_written(self):
        path = self.with_file("a file, not a folder")
        program.must_refuse(self, CASE + ["-output", path], path, timeout=120)


if __name__ == "__main__":
    unittest.main()
