"""Meshes that hang together otherwise than they look, and groups left out: refused or reported."""
import os
import tempfile
import unittest

import program
import wrong_input_test

TABLE = ["-structures", "t", "-t_mesh", "tests/meshes/table.geo", "-t_clamp", "base",
         "-t_column_element", "beam", "-t_column_material", "steel", "-t_column_section", "tube",
         "-t_slab_element", "shell", "-t_slab_material", "steel", "-t_slab_thickness", "0.05",
         "-material_steel_young", "200e9", "-material_steel_poisson", "0.3",
         "-material_steel_density", "7800", "-section_tube_area", "1e-2",
         "-section_tube_inertia_y", "1e-5", "-section_tube_inertia_z", "1e-5",
         "-section_tube_torsion", "1e-5", "-section_tube_z_axis", "1,0,0", "-end_time", "1e-4",
         "-modes", "3", "-t_gravity", "0,0,-9.81"]


def table(fault, *more):
    return TABLE + ["-t_mesh_set", f"fault={fault}"] + list(more)


def without(arguments, option):
    at = arguments.index(option)
    return arguments[:at] + arguments[at + 2:]


class MeshCase(unittest.TestCase):
    refuse = wrong_input_test.WrongInput.refuse
    with_file = wrong_input_test.WrongInput.with_file

    def connectivity(self, arguments, ranks=2):
        """What the summary says of the mesh, and its doubts but for the one about sudden gravity."""
        _, summary = program.must_run(self, arguments, ranks)
        doubts = [warning for warning in summary["warnings"] if "gravity acts at once" not in warning]
        return summary["structures"]["t"]["connectivity"], doubts


class Pieces(MeshCase):
    def test_sound_table(self):
        for ranks in (1, 2):
            found, warnings = self.connectivity(table(0), ranks)
            self.assertEqual((found["pieces"], found["pieces_not_held"]), (1, 0))
            self.assertEqual(warnings, [])

    def test_head_that_is_a_node_of_its_own(self):
        self.refuse(table(1), "structure t", "1 pairs of nodes", "(0, 2, 3)", "-t_allow_loose")
        found, _ = self.connectivity(table(1, "-t_allow_loose"))
        self.assertEqual((found["pieces"], found["coincident_nodes_apart"]["count"]), (2, 1))

    def test_head_inside_a_cell(self):
        self.refuse(table(2), "1 ends of lines", "(0.4, 1.6, 3)")
        found, _ = self.connectivity(table(2, "-t_allow_loose"))
        self.assertEqual(found["line_ends_in_elements"], {"count": 1, "first": [0.4, 1.6, 3]})

    def test_slab_that_nothing_holds(self):
        self.refuse(table(5), "1 of its 2 pieces", "9 nodes", "(3, 0, 3)")
        found, _ = self.connectivity(table(5, "-t_allow_loose"))
        self.assertEqual(found["not_held"], [{"nodes": 9, "place": [3, 0, 3]}])

    def test_slab_that_flies(self):
        found, _ = self.connectivity(table(5, "-t_initial_velocity", "1,0,0"))
        self.assertEqual(found["pieces_not_held"], 1)

    def test_no_clamp_on_shaking_ground(self):
        record = self.with_file("0 0\n0.01 1\n0.02 0\n")
        shaken = ["-motion_x_record", record, "-motion_x_unit", "m/s2"]
        free = without(table(0), "-t_clamp") + ["-t_ignore", "base"]
        self.refuse(free + shaken, "nothing holds it", "-t_clamp")
        found, warnings = self.connectivity(free)
        self.assertEqual((found["pieces_not_held"], warnings), (1, []))

    def test_clamp_of_a_symmetry_is_a_support(self):
        found, _ = self.connectivity(without(table(0), "-t_clamp") + ["-t_clamp", "base:z"])
        self.assertEqual(found["pieces_not_held"], 0)


class Joints(MeshCase):
    def test_columns_under_solids_are_hinged(self):
        solid = without(table(0), "-t_slab_thickness") + ["-t_slab_element", "hex8"]
        found, _ = self.connectivity(solid + ["-t_mesh_set", "slab=0"])
        self.assertEqual(found["hinges_at_solids"]["count"], 4)
        self.assertEqual(found["single_beams_at_solids"]["count"], 4)

    def test_columns_under_shells_are_not(self):
        found, _ = self.connectivity(table(0))
        self.assertEqual(found["hinges_at_solids"]["count"], 0)

    def test_mechanism(self):
        bars = without(without(table(0), "-t_column_element"), "-t_column_section")
        bars = bars + ["-t_column_element", "bar", "-t_column_area", "1e-2"]
        for ranks in (1, 2):
            _, warnings = self.connectivity(bars, ranks)
            self.assertEqual(len(warnings), 1, warnings)
            self.assertIn("no stiffness", warnings[0])

    def test_mesh_in_millimetres(self):
        _, warnings = self.connectivity(TABLE + ["-t_mesh_set", "unit=1000", "-modes", "0"])
        self.assertIn("millimetres", warnings[0])


class Groups(MeshCase):
    def test_group_that_no_option_uses(self):
        self.refuse(table(6), "group 'brace'", "2 elements (Line 2)", "-t_brace_element", "-t_ignore")
        self.connectivity(table(6, "-t_ignore", "brace"))

    def test_one_column_of_four(self):
        self.refuse(table(4), "group 'fourth'", "3 elements")

    def test_column_in_no_group(self):
        self.refuse(table(3), "no physical group", "3 elements", "ungrouped")
        self.connectivity(table(3, "-t_ignore", "ungrouped"))

    def test_unknown_group_to_ignore(self):
        self.refuse(table(0, "-t_ignore", "stairs"), "-t_ignore", "'stairs'")

    def test_faces_may_go_without_a_use(self):
        block = ["-structures", "t", "-t_mesh", "tests/meshes/box.geo", "-t_clamp", "z_min",
                 "-t_body_element", "hex8", "-t_body_material", "m", "-material_m_young", "1e9",
                 "-material_m_poisson", "0", "-material_m_density", "1e3", "-end_time", "1e-4"]
        found, _ = self.connectivity(block)
        self.assertEqual({group["group"] for group in found["groups_without_use"]},
                         {"x_min", "x_max", "y_min", "y_max", "z_max"})

    def two_bars(self, second_tag, second_nodes):
        mesh = self.with_file(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n0 1 \"p\"\n1 2 \"l\"\n"
            "$EndPhysicalNames\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 2 0 0\n$EndNodes\n$Elements\n3\n"
            f"1 15 2 1 1 1\n2 1 2 2 1 1 2\n{second_tag} 1 2 2 1 {second_nodes}\n$EndElements\n", ".msh")
        return ["-structures", "t", "-t_mesh", mesh, "-t_clamp", "p", "-t_l_element", "bar",
                "-t_l_area", "1", "-t_l_material", "s", "-material_s_young", "1",
                "-material_s_poisson", "0", "-material_s_density", "1", "-end_time", "1", "-modes", "0"]

    def test_element_twice(self):
        self.refuse(self.two_bars(3, "2 1"), "element 3 of group 'l'", "element 2", "twice")
        self.refuse(self.two_bars(2, "2 3"), "-t_mesh", "element 2 is listed twice")


class Gmsh(MeshCase):
    """Failures of Gmsh, and what its language can do, stay out of the program."""

    def geometry(self, text):
        return TABLE + ["-t_mesh", self.with_file(text, ".geo")]

    def marked(self, text):
        """The text with a path for FILE that a command in it would create, and that path."""
        path = os.path.join(tempfile.mkdtemp(), "made")
        return text.replace("FILE", path), path

    def refuse_command(self, text, *words, suffix=".geo"):
        text, path = self.marked(text)
        self.refuse(TABLE + ["-t_mesh", self.with_file(text, suffix)], *words, ranks=(2,))
        self.assertFalse(os.path.exists(path))

    def test_box_of_no_length(self):
        self.refuse(TABLE + ["-t_mesh", "tests/meshes/box.geo", "-t_mesh_set", "lx=0"], "-t_mesh",
                    "Gmsh")

    def test_nodes_that_are_missing(self):
        mesh = self.with_file("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n"
                              "$Elements\n1\n1 1 2 1 1 1 7\n$EndElements\n", ".msh")
        self.refuse(TABLE + ["-t_mesh", mesh], mesh, "Gmsh")

    def test_recursion(self):
        self.refuse(self.geometry('Macro Again\n Call Again;\nReturn\nCall Again;\n')
                    + ["-mesh_time_limit", "10"], "Gmsh")

    def test_loop_without_end(self):
        self.refuse(self.geometry("x = 0;\nFor i In {1:1e15}\n x = x + 1;\nEndFor\n")
                    + ["-mesh_time_limit", "5"], "5 s", "-mesh_time_limit")

    def test_commands(self):
        for text in ('SystemCall "touch FILE";', 'System "touch FILE";',
                     'NonBlockingSystemCall "touch FILE";', 'Printf("x") > "FILE";',
                     'Printf("x", 1 > 2) >> "FILE";', 'CreateDir "FILE";',
                     'Point(1) = {0, 0, 0}; Save "FILE";', 'Print "FILE";'):
            self.refuse_command("x = 1; // \"\n" + text, " line 2", "-allow_geo_commands")

    def test_commands_behind_texts_that_look_like_comments(self):
        self.refuse_command('x = "//"; SystemCall "touch FILE";', "SystemCall")
        self.refuse_command('x = "' + 1100 * "x" + '"; // "\nSystemCall "touch FILE";', "longer")

    def test_commands_in_other_files(self):
        inner, path = self.marked('SystemCall "touch FILE";\n')
        inner = self.with_file(inner, ".geo")
        for keyword in ("Include", "Merge"):
            self.refuse_command(f'{keyword} "{inner}";\n', inner)
        self.refuse_command(f'x = "{inner}";\nInclude Str(x);\n', "computed")
        self.assertFalse(os.path.exists(path))

    def test_commands_under_other_names(self):
        self.refuse_command('SystemCall "touch FILE";\n', "$MeshFormat", suffix=".msh")
        for suffix in (".txt", ".off", ".geo.gz", ""):
            self.refuse_command('SystemCall "touch FILE";\n', "ending", suffix=suffix)

    def test_commands_in_an_options_file(self):
        text, path = self.marked('SystemCall "touch FILE";\n')
        mesh = self.with_file("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", ".msh")
        with open(mesh + ".opt", "w") as file:
            file.write(text)
        self.addCleanup(os.remove, mesh + ".opt")
        self.refuse(TABLE + ["-t_mesh", mesh], ".opt")
        self.assertFalse(os.path.exists(path))

    def test_commands_that_are_allowed(self):
        text, path = self.marked('SystemCall "touch FILE";\n')
        with open(os.path.join(program.SOURCE, "tests/meshes/table.geo")) as file:
            self.connectivity(self.geometry(text + file.read()) + ["-allow_geo_commands"])
        self.assertTrue(os.path.exists(path))

    def test_quotes_in_parameters(self):
        for value in ('a"; SystemCall "x', "a'b", "a\\b", "a\nb"):
            self.refuse(TABLE + ["-t_mesh_set", f"slab={value}"], "-t_mesh_set", ranks=(2,))
        self.refuse(TABLE + ["-t_mesh_set", "slab;x=1"], "-t_mesh_set", ranks=(2,))


if __name__ == "__main__":
    unittest.main()
