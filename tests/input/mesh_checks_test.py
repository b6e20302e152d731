"""Meshes that hang together otherwise than they look, and groups left out: refused or reported."""
import ctypes
import os
import resource
import signal
import struct
import subprocess
import sys
import tempfile
import unittest

import program
from decks import material, probes, section
import wrong_input_test

TABLE = ["-structures", "t", "-t_mesh", "tests/meshes/table.geo", "-t_clamp", "base", "-t_column_element", "beam",
         "-t_column_material", "steel", "-t_column_section", "tube", "-t_slab_element", "shell",
         "-t_slab_material", "steel", "-t_slab_thickness", "0.05", *material("steel", "200e9", "0.3", "7800"),
         *section("tube", "1e-2", "1e-5", "1e-5", "1e-5", "1,0,0"), "-end_time", "1e-4", "-modes", "3",
         "-t_gravity", "0,0,-9.81"]


def table(fault, *more):
    return TABLE + ["-t_mesh_set", f"fault={fault}"] + list(more)


def without(arguments, option):
    at = arguments.index(option)
    return arguments[:at] + arguments[at + 2:]


class MeshCase(unittest.TestCase):
    refuse = wrong_input_test.WrongInput.refuse
    with_file = wrong_input_test.WrongInput.with_file

    def connectivity(self, arguments, ranks=1):
        """What the summary says of the mesh, and its doubts but for the one about sudden gravity."""
        _, summary = program.must_run(self, arguments, ranks)
        doubts = [warning for warning in summary["warnings"] if "gravity acts at once" not in warning]
        return summary["structures"]["t"]["connectivity"], doubts


class Pieces(MeshCase):
    def test_sound_table(self):
        found, warnings = self.connectivity(table(0))
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
        _, warnings = self.connectivity(bars)
        self.assertEqual(len(warnings), 1, warnings)
        self.assertIn("no stiffness", warnings[0])

    def test_mesh_in_millimetres(self):
        _, warnings = self.connectivity(TABLE + ["-t_mesh_set", "unit=1000", "-modes", "0"])
        self.assertIn("millimetres", warnings[0])


class Uses(MeshCase):
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
        block = ["-structures", "t", "-t_mesh", "tests/meshes/box.geo", "-t_clamp", "z_min", "-t_body_element", "hex8",
                 "-t_body_material", "m", *material("m", "1e9", "0", "1e3"), "-end_time", "1e-4"]
        found, _ = self.connectivity(block)
        self.assertEqual({group["group"] for group in found["groups_without_use"]},
                         {"x_min", "x_max", "y_min", "y_max", "z_max"})

    def two_bars(self, second_tag, second_nodes):
        mesh = self.with_file(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n0 1 \"p\"\n1 2 \"l\"\n"
            "$EndPhysicalNames\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 2 0 0\n$EndNodes\n$Elements\n3\n"
            f"1 15 2 1 1 1\n2 1 2 2 1 1 2\n{second_tag} 1 2 2 1 {second_nodes}\n$EndElements\n", ".msh")
        return ["-structures", "t", "-t_mesh", mesh, "-t_clamp", "p", "-t_l_element", "bar", "-t_l_area", "1",
                "-t_l_material", "s", *material("s", "1", "0", "1"), "-end_time", "1", "-modes", "0"]

    def test_element_twice(self):
        self.refuse(self.two_bars(3, "2 1"), "element 3 of group 'l'", "element 2", "twice")
        self.refuse(self.two_bars(2, "2 3"), "-t_mesh", "element 2 is listed twice")

    def test_quadrangles_and_triangles_of_a_group_count_together(self):
        """Two squares side by side in one group: four quadrangles in the first, triangles in the second."""
        mesh = self.with_file("""
            Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {2, 0, 0};
            Point(4) = {2, 1, 0}; Point(5) = {1, 1, 0}; Point(6) = {0, 1, 0};
            Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
            Line(7) = {2, 5}; Curve Loop(1) = {1, 7, 5, 6}; Curve Loop(2) = {2, 3, 4, -7};
            Plane Surface(1) = {1}; Plane Surface(2) = {2};
            Transfinite Curve {1:7} = 3; Transfinite Surface {1:2}; Recombine Surface {1};
            Physical Surface("slab") = {1, 2}; Physical Curve("edge") = {6};
            """, ".geo")
        words = ["-structures", "t", "-t_mesh", mesh, "-t_clamp", "edge", "-t_slab_element", "shell", "-t_slab_material",
                 "C30/37", "-t_slab_thickness", "0.2", "-t_initial_velocity", "0,0,1", "-end_time", "1e-4", "-modes", "0"]
        _, summary = program.must_run(self, words)
        structure = summary["structures"]["t"]
        self.assertEqual((structure["groups"], structure["elements"]), ({"slab": 12}, 12))
        printed = program.run([*words, "-dry_run"]).stdout
        self.assertRegex(printed, r"\n  slab +4 shell4\n  slab +8 shell3\n")


CUBE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


class Groups(MeshCase):
    """Groups by whatever a format has for them; a cube of 1 m on its lower face."""

    def cube(self, mesh, body, base, *more):
        return ["-structures", "t", "-t_mesh", mesh, "-t_clamp", base, f"-t_{body}_element", "hex8",
                f"-t_{body}_material", "C30", "-modes", "3", "-end_time", "1e-4", *more]

    def hold(self, arguments):
        _, summary = program.must_run(self, arguments)
        structure = summary["structures"]["t"]
        self.assertAlmostEqual(structure["mass"], 2500, delta=1e-9)
        self.assertEqual((structure["nodes"], structure["dofs"]), (8, 12))

    def msh(self, names, elements):
        """A file of format 2.2: names (dimension, number, name), elements (type, group, entity, nodes)."""
        return self.with_file("\n".join(
            ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)),
             *(f'{dimension} {number} "{name}"' for dimension, number, name in names), "$EndPhysicalNames",
             "$Nodes", "9", *(f"{n + 1} {x} {y} {z}" for n, (x, y, z) in enumerate((*CUBE, (2, 0, 0)))), "$EndNodes",
             "$Elements", str(len(elements)),
             *(f"{e + 1} {kind} 2 {group} {entity} " + " ".join(map(str, nodes))
               for e, (kind, group, entity, nodes) in enumerate(elements)), "$EndElements", ""]), ".msh")

    def test_formats_that_run_import_reads_say_so(self):
        for ending in (".inp", ".unv", ".med", ".cdb", ".k"):
            mesh = self.with_file("*NODE\n1, 0, 0, 0\n", ending)
            self.refuse(self.cube(mesh, "body", "base"), "-t_mesh", f"'{ending}'", "run/import",
                            "docs/manual/import.md")

    NAMES = ((3, 1, "tower"), (2, 2, "tower"), (2, 3, "base"))
    BRICK = (5, 1, 1, range(1, 9))
    BASE = (3, 3, 3, (1, 2, 3, 4))

    def test_one_name_of_a_volume_and_its_skin(self):
        """The skin marks places, as a skin of another name does: a probe stands on its nodes."""
        skin = [(3, 2, 1, (5, 6, 7, 8)), (3, 2, 2, (1, 2, 6, 5))]
        mesh = self.msh(self.NAMES, [self.BRICK, self.BASE, *skin])
        self.hold(self.cube(mesh, "tower", "base"))
        self.hold(self.cube(mesh, "tower", "base", *probes(top="t:tower")))

    def test_one_name_of_a_volume_and_of_what_is_not_its_skin(self):
        """It would be left out, be it that something else names the group."""
        mesh = self.msh(self.NAMES, [self.BRICK, self.BASE, (2, 2, 1, (2, 3, 9))])
        for more in ([], [*probes(top="t:tower")]):
            self.refuse(self.cube(mesh, "tower", "base", *more), "group 'tower'", "1 element (Triangle 3)", "beside those that become")
        program.must_run(self, self.cube(mesh, "tower", "base", "-t_ignore", "tower"))

    def test_one_name_of_a_face_under_springs_and_the_volume_on_it(self):
        names = ((3, 1, "tower"), (2, 2, "bed"), (3, 3, "bed"))
        springs = ["-t_bed_element", "grounded_spring", "-t_bed_stiffness_per_area", "1e8,1e8,1e8"]
        mesh = self.msh(names, [self.BRICK, (3, 2, 3, (1, 2, 3, 4))])
        arguments = self.cube(mesh, "tower", "none", *springs)
        _, summary = program.must_run(self, arguments)
        self.assertAlmostEqual(summary["structures"]["t"]["mass"], 2500, delta=1e-9)
        mesh = self.msh(names, [self.BRICK, (3, 2, 3, (1, 2, 3, 4)), (4, 3, 4, (2, 3, 9, 6))])
        self.refuse(self.cube(mesh, "tower", "none", *springs), "group 'bed'", "(Tetrahedron 4)")

    def test_nastran_by_properties(self):
        grid = "".join(f"GRID    {n + 1:8d}{'':8s}{x:8.1f}{y:8.1f}{z:8.1f}\n" for n, (x, y, z) in enumerate(CUBE))
        text = ("BEGIN BULK\n" + grid + "CHEXA          7      11       1       2       3       4       5       6+H\n"
                "+H             7       8\nCQUAD4         8      12       1       4       3       2\nENDDATA\n")
        for suffix in (".bdf", ".nas"):
            self.hold(self.cube(self.with_file(text, suffix), "11", "12"))

    def test_medit_by_references(self):
        vertices = "".join(f"{x} {y} {z} 0\n" for x, y, z in CUBE)
        self.hold(self.cube(self.with_file(
            f"MeshVersionFormatted 2\nDimension 3\nVertices\n8\n{vertices}Quadrilaterals\n1\n1 4 3 2 12\n"
            "Hexahedra\n1\n1 2 3 4 5 6 7 8 11\nEnd\n", ".mesh"), "11", "12"))


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
        self.refuse(TABLE + ["-t_mesh", self.with_file(text + "\n", suffix)], *words)
        self.assertFalse(os.path.exists(path))

    def answer(self, text, memory=resource.RLIM_INFINITY):
        """What pounding-mesh answers of a geometry: Gmsh's error and the deed at which it was stopped; None for both
        where it ended without an answer, and "killed" for the deed where the kernel ended it. `memory`: that it may have [bytes]."""
        def prepare():
            os.dup2(writing, 3)
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))

        reading, writing = os.pipe()
        process = subprocess.Popen([os.path.join(program.BUILD, "pounding-mesh"), self.with_file(text, ".geo"), "make"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, close_fds=False,
                                   preexec_fn=prepare)
        os.close(writing)
        with os.fdopen(reading, "rb") as stream:
            data = stream.read()
        process.wait()
        texts, at = [], 8  # behind the first word
        while data and len(texts) < 2:
            length = int.from_bytes(data[at:at + 8], sys.byteorder)
            texts.append(data[at + 8:at + 8 + length].decode())
            at += 8 + length
        return texts or [None, "killed" if process.returncode == -signal.SIGSYS else None]

    def test_box_of_no_length(self):
        self.refuse(TABLE + ["-t_mesh", "tests/meshes/box.geo", "-t_mesh_set", "lx=0"], "-t_mesh",
                    "Gmsh")

    def test_nodes_that_are_missing(self):
        mesh = self.with_file("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n"
                              "$Elements\n1\n1 1 2 1 1 1 7\n$EndElements\n", ".msh")
        self.refuse(TABLE + ["-t_mesh", mesh], mesh, "Gmsh")

    @program.long
    def test_recursion(self):
        self.refuse(self.geometry('Macro Again\n Call Again;\nReturn\nCall Again;\n')
                    + ["-mesh_time_limit", "10"], "Gmsh")

    def test_last_words_of_a_crash(self):
        self.refuse(self.geometry("Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Line(1) = {1, 2}; Curve Loop(1) = {1};\n"
                                  "Plane Surface(1) = {1}; Transfinite Surface {1} = {1, 2, 1};\n"),
                    "Gmsh crashed", "(signal 6, Aborted)", "Something wrong in edge loop")

    def test_loop_without_end(self):
        self.refuse(self.geometry("x = 0;\nFor i In {1:1e15}\n x = x + 1;\nEndFor\n")
                    + ["-mesh_time_limit", "5"], "5 s", "-mesh_time_limit")

    def test_commands(self):
        self.refuse_command('StringToName["SystemCall"] "touch FILE";', "-t_mesh", "stopped", "start a program")
        self.refuse_command('SystemCall "touch FILE";\n', "$MeshFormat", suffix=".msh")
        for suffix in (".txt", ".geo.gz", ""):
            self.refuse_command('SystemCall "touch FILE";\n', "ending", suffix=suffix)

    def test_a_dry_run_runs_no_command(self):
        text, path = self.marked('Printf("x") > "FILE";\n')
        program.must_refuse(self, TABLE + ["-t_mesh", self.with_file(text, ".geo"), "-dry_run"], "write to a file")
        self.assertFalse(os.path.exists(path))

    def test_forms_of_commands(self):
        """What a geometry may ask of Gmsh beside a mesh, under every name that its language has for it."""
        box = 'SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 1, 1, 1};\n'
        line = "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Line(1) = {1, 2};\n"
        view = 'View "v" {SP(0, 0, 0){1};};\n'
        inner = tempfile.mkdtemp()
        path = os.path.join(inner, "made")
        with open(os.path.join(inner, "inner.geo"), "w") as file:
            file.write(f'SystemCall "touch {path}";\n')
        forms = {
            "killed": [
                'SystemCall "touch FILE";', 'System "touch FILE";', 'NonBlockingSystemCall "touch FILE";',
                'S2N["SystemCall"] "touch FILE";', f'Include "{inner}/inner.geo";', f'Merge "{inner}/inner.geo";',
                f'Include StrCat("{inner}", "/inner.geo");', f'MergeWithBoundingBox "{inner}/inner.geo";',
                'x = "//"; SystemCall "touch FILE";'],
            "start a program": [line + 'Field[1] = ExternalProcess; Field[1].CommandLine = "touch FILE";\n'
                                'Background Field = 1;'],
            "write to a file": ['Printf("x") > "FILE";', 'Printf("x", 1 > 2) >> "FILE";', line + 'Mesh 1; Save "FILE.msh";',
                         line + 'Print "FILE.msh";', view + 'Save View[0] "FILE.pos";', box + 'Save "FILE.brep";',
                         line + 'Print "FILE.geo_unrolled";', 'CreateDir "FILE";',
                         'OnelabRun("x", "touch FILE");'],  # it removes an old socket before it opens another
        }
        for deed, texts in forms.items():
            for text in texts:
                with self.subTest(text):
                    error, denied = self.answer(text.replace("FILE", path) + "\n")
                    self.assertTrue(denied is not None and denied.startswith(deed), (error, denied))
                    self.assertEqual(os.listdir(inner), ["inner.geo"])
        for text in ('Plugin(MathEval).Run;', 'Parse StrCat("System", "Call;");', 'Error("x") > "FILE";'):
            error, denied = self.answer(text.replace("FILE", path) + "\n")
            self.assertTrue(error and not denied, text)

    def test_memory_that_is_not_enough(self):
        """It ends before parts of Gmsh that need what did not come."""
        with open(os.path.join(program.SOURCE, "tests/meshes/box.geo")) as file:
            text = "nx = 2000; ny = 2000; nz = 2000;\n" + file.read()
        self.assertEqual(self.answer(text, memory=600 << 20), ["the memory is not enough for it", ""])

    def test_numbers_beyond_every_mesh(self):
        for value in ("1e300", "-1e13", "nan", "inf"):
            self.refuse(TABLE + ["-t_mesh_set", f"unit={value}"], f"unit={value}", "beyond every mesh")

    def test_a_geometry_that_ends_gmsh(self):
        self.refuse(self.geometry("Exit;\n"), "-t_mesh", "without an answer")

    def without_call(self, number, arguments):
        """The program where the system knows no call of this number."""
        allow, unknown = 0x7fff0000, 0x50000 | 38
        code = [(0x20, 0, 0, 0), (0x15, 0, 1, number), (0x06, 0, 0, unknown), (0x06, 0, 0, allow)]
        filters = b"".join(struct.pack("HBBI", *line) for line in code)

        def restrict():
            libc = ctypes.CDLL(None)
            buffer = ctypes.create_string_buffer(filters)
            head = struct.pack("HxxxxxxQ", len(code), ctypes.addressof(buffer))
            libc.prctl(38, 1, 0, 0, 0)
            libc.prctl(22, 2, ctypes.create_string_buffer(head), 0, 0)

        return subprocess.run(program.words(arguments, 1)[3:], cwd=program.SOURCE, env=program.ENVIRONMENT,
                              capture_output=True, text=True, preexec_fn=restrict)

    @unittest.skipUnless(os.uname().machine == "x86_64", "numbers of its system calls")
    def test_a_system_without_landlock(self):
        landlock = 444
        result = self.without_call(landlock, TABLE + ["-dry_run"])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.count("warning: this system has no Landlock"), 1, result.stdout)
        for text, deed in (('SystemCall "touch FILE";\n', "start a program"), ('Printf("x") > "FILE";\n', "write to a file"),
                           ('CreateDir "FILE";\n', "write to a file")):
            text, path = self.marked(text)
            result = self.without_call(landlock, self.geometry(text) + ["-dry_run"])
            self.assertEqual(result.returncode, 1)
            self.assertEqual(len(program.error_lines(result)), 1, result.stderr)
            self.assertIn(deed, result.stderr)
            self.assertFalse(os.path.exists(path))

    def test_an_options_file_beside_the_mesh_is_an_input(self):
        """Gmsh takes its options, and can do no more by it than by the mesh."""
        with open(os.path.join(program.SOURCE, "tests/meshes/table.geo")) as file:
            mesh = self.with_file(file.read(), ".geo")
        with open(mesh + ".opt", "w") as file:
            file.write("Mesh.Optimize = 0;\n")
        _, summary = program.must_run(self, TABLE + ["-t_mesh", mesh])
        self.assertEqual([one["file"] for one in summary["inputs"] if one["option"] == "included"], [mesh + ".opt"])

    def test_quotes_in_paths(self):
        """They are names and nothing else."""
        folder = tempfile.mkdtemp() + "/a\" 'b'; SystemCall \"touch made\"; \\"
        os.mkdir(folder)
        with open(os.path.join(program.SOURCE, "tests/meshes/table.geo")) as file:
            text = file.read()
        with open(folder + "/inner.geo", "w") as file:
            file.write(text)
        with open(folder + "/outer.geo", "w") as file:
            file.write('Include "inner.geo";\n')
        _, summary = program.must_run(self, TABLE + ["-t_mesh", folder + "/outer.geo", "-t_mesh_set", "fault=0"])
        self.assertEqual([one["file"] for one in summary["inputs"] if one["option"] == "included"], [folder + "/inner.geo"])

    def test_a_parameter_that_the_geometry_sets_itself(self):
        with open(os.path.join(program.SOURCE, "tests/meshes/table.geo")) as file:
            text = file.read()
        _, doubts = self.connectivity(self.geometry(text + "high = 5;\nword = \"b\";\n")
                                      + ["-t_mesh_set", "high=4.5,word=a,fault=0"])
        self.assertEqual([doubt.split(": ", 1)[1].split(", and")[0] for doubt in doubts],
                         ["high was given as 4.5", "word was given as a"])
        self.assertIn(", 5;", doubts[0])

    def test_parameters_reach_the_geometry(self):
        """Negative, with an exponent, as a word, of a constant that has a label, and where it is read by a file that it includes."""
        inner = self.with_file("DefineConstant[lx = {3, Min -9, Max 9, Name \"Parameters/lx\"}, back = 2];\n"
                               "If (!Exists(kind)) kind = \"a\"; EndIf\n", ".geo")
        text = (f'Include "{inner}";\nIf (lx != -2 || back != 1.5e-3 || StrCmp(kind, "b") != 0) Error("%g %g", lx, back); EndIf\n')
        with open(os.path.join(program.SOURCE, "tests/meshes/table.geo")) as file:
            text += file.read()
        _, doubts = self.connectivity(self.geometry(text) + ["-t_mesh_set", "lx=-2,back=1.5e-3,kind=b"])
        self.assertEqual(doubts, [])

    def test_quotes_in_parameters(self):
        for value in ('a"; SystemCall "x', "a'b", "a\\b", "a\nb"):
            self.refuse(TABLE + ["-t_mesh_set", f"slab={value}"], "-t_mesh_set")
        self.refuse(TABLE + ["-t_mesh_set", "slab;x=1"], "-t_mesh_set")


if __name__ == "__main__":
    unittest.main()
