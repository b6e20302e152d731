"""Elements at the end of what a mesh may hold: slivers run, broken ones are refused by their number.

A brick of 1 x 1 x h m of concrete has the largest frequency of its eight nodes in closed form only for
h = 1; the others come from an independent code and approach 2 c_p / h. In a column one thin layer
between cubes of side a costs the step its root only: sqrt(h a) / c.
"""
import math
import os
import re
import tempfile
import unittest

import program
from history import History, refused, scenes
from small_meshes import Mesh, brick

BRICKS = {1.0: 9128.70929175277, 0.1: 74582.69848302077, 0.01: 745360.6514844532, 1e-4: 74535599.29657775}
CUBE = brick((0, 0, 0), (1, 1, 1), (1, 1, 1))
SECTION = ["-section_tube_area", 1e-3, "-section_tube_inertia_y", 1e-6, "-section_tube_inertia_z", 1e-6,
           "-section_tube_torsion", 1e-6, "-section_tube_z_axis", "0,0,1"]


class Slivers(unittest.TestCase):
    def test_step_is_that_of_the_element(self):
        words = ["-structures", ",".join(f"b{i}" for i in range(len(BRICKS))), "-end_time", 1e-12, "-modes", 0,
                 *scenes.material("concrete", *scenes.CONCRETE)]
        for i, thickness in enumerate(BRICKS):
            words += [f"-b{i}_mesh", "tests/meshes/box.geo", f"-b{i}_mesh_set", f"lz={thickness!r}",
                      f"-b{i}_body_element", "hex8_full", f"-b{i}_body_material", "concrete"]
        structures = History(self, words, 2).summary["structures"]
        wave = math.sqrt(30e9 * 0.8 / (1.2 * 0.6) / 2400)
        for i, (thickness, omega) in enumerate(BRICKS.items()):
            self.assertAlmostEqual(structures[f"b{i}"]["omega_max"] / omega, 1, delta=1e-9)
            self.assertAlmostEqual(structures[f"b{i}"]["stable_time_step"] * omega / 2, 1, delta=1e-9)
            if thickness <= 0.01:
                self.assertAlmostEqual(omega * thickness / (2 * wave), 1, delta=1e-4)

    def test_thin_layer_in_a_column_runs_and_is_named(self):
        wave, side = math.sqrt(30e9 / 2400), 0.1
        for thickness in (1e-3, 1e-5):
            run = History(self, scenes.column(thickness), 2)
            column = run.summary["structures"]["column"]
            self.assertAlmostEqual(run.summary["stable_time_step"] * wave / math.sqrt(thickness * side), 1, delta=0.01)
            named = float(re.search(r"group 'body' at .*, ([^,]+)\)$", column["stiffest_element"])[1])
            self.assertAlmostEqual(named, 0.5 + thickness / 2, delta=1e-5)  # the next ones are 0.05 m away
            self.assertAlmostEqual(run.summary["impacts"]["total_impulse"] / (2 * column["mass"]), 1, delta=0.05)
            self.assertLess(run.energy["relative_residual"], 1e-12)


class Warnings(unittest.TestCase):
    """One line before the run names the worst of the elements that cost the others their time step."""

    def warnings(self, words, ranks=2):
        with tempfile.TemporaryDirectory() as folder:
            result = program.run([*words, "-dry_run", "-output", folder], ranks, timeout=300)
        self.assertEqual(result.returncode, 0, result.stderr)
        return [line for line in result.stdout.splitlines() if "sliver" in line]

    def test_thin_layer_is_named(self):
        lines = {tuple(self.warnings(scenes.column(1e-5), ranks)) for ranks in (1, 2)}
        self.assertEqual(len(lines), 1, lines)
        said, = lines  # doubts come in the answer of a dry run, in its details and at the end
        self.assertEqual(len({one.removeprefix("warning: ").strip() for one in said}), 1, said)
        line = said[-1]
        found = re.search(r"element (\d+) of group 'body' at \((.*)\) allows by itself (\S+) s, the median of its "
                          r"group (\S+) s \(1 such", line)
        self.assertEqual([float(x) for x in found[2].split(",")], [0.05, 0.05, 0.5])
        wave = math.sqrt(30e9 / 2400)
        self.assertAlmostEqual(float(found[3]) * wave / 1e-5, 1, delta=1e-3)
        self.assertAlmostEqual(float(found[4]) * wave / 0.1, 1, delta=1e-3)

    def test_the_summary_keeps_it(self):
        folder, summary = program.must_run(self, [*scenes.column(1e-5), "-end_time", 1e-7, "-modes", 0])
        (structure,) = summary["structures"].values()
        (sliver,) = structure["slivers"]
        self.assertIn("of group 'body' at (0.05, 0.05, 0.5)", sliver["element"])
        self.assertEqual(sliver["number_in_group"], 1)
        self.assertAlmostEqual(sliver["time_step"] / sliver["median_of_group"] / 1e-4, 1, delta=2e-3)

    def test_even_meshes_are_not_blamed(self):
        for words in (scenes.column(0.1), scenes.column(0.02), program.COARSE_PAIR,
                      ["-options_file", "petsc-options/azalee/pair.yaml"],
                      ["-options_file", "petsc-options/azalee/pair-b.yaml"]):
            self.assertEqual(self.warnings([*words, "-end_time", 1e-3, "-modes", 0]), [], words)


class Broken(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pounding-")

    def refuse(self, mesh, element, *words, group="body", more=()):
        path = mesh.write(os.path.join(self.folder, "broken.msh"))
        return refused(self, ["-structures", "part", "-part_mesh", path, f"-part_{group}_element", element,
                              f"-part_{group}_material", "concrete", *scenes.material("concrete", *scenes.CONCRETE),
                              "-end_time", 1e-9, *more], *words, ranks=2)

    def brick_with(self, nodes):
        """A sound cube, and beside it one on these of its nodes."""
        beside = [node + len(CUBE.nodes) for node in nodes]
        return Mesh([*CUBE.nodes, *(CUBE.nodes + (5, 0, 0))],
                    {"body": ("hexahedron", [CUBE.groups["body"][1][0], beside])})

    def test_inverted_brick(self):
        row = CUBE.groups["body"][1][0]
        swapped = [row[1], row[0], *row[2:]]
        for element in ("hex8", "hex8_full"):
            line = self.refuse(self.brick_with(swapped), element, "structure part", "element 2 of group 'body'")
            self.assertIn("Jacobian -0.0305021", line)
            self.refuse(self.brick_with(row[4:] + row[:4]), element, "element 2 of group 'body'", "Jacobian")

    def test_brick_without_thickness(self):
        for thickness in (0, 1e-13):
            flat = CUBE.placed(lambda nodes, h=thickness: nodes * (1, 1, h))
            self.refuse(flat, "hex8", "element 1 of group 'body'", "two of its nodes")

    def test_beam_without_length(self):
        lines = Mesh([(0, 0, 0), (1, 0, 0), (1, 0, 0)], {"line": ("line", [[0, 1], [1, 2]])})
        self.refuse(lines, "beam", "element 2 of group 'line'", "two of its nodes", group="line",
                    more=["-part_line_section", "tube", *SECTION])

    def test_shell_without_area_or_turned_over_itself(self):
        square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        for corners, word in (([0, 1, 1, 0], "two of its nodes"), ([0, 2, 1, 3], "area")):
            beside = [(x + 5, y, z) for x, y, z in square]
            plate = Mesh([*square, *beside], {"plate": ("quadrangle", [[0, 1, 2, 3], [c + 4 for c in corners]])})
            self.refuse(plate, "shell", "element 2 of group 'plate'", word, group="plate",
                        more=["-part_plate_thickness", 0.1])
        dented = Mesh([*square[:2], (0.2, 0.2, 0), square[3]], {"plate": ("quadrangle", [[0, 1, 2, 3]])})
        self.refuse(dented, "shell", "element 1 of group 'plate'", "convex", group="plate",
                    more=["-part_plate_thickness", 0.1])

    def test_shell_of_no_thickness(self):
        plate = Mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], {"plate": ("quadrangle", [[0, 1, 2, 3]])})
        for thickness in (0, -0.1):
            self.refuse(plate, "shell", "-part_plate_thickness", "> 0", group="plate",
                        more=["-part_plate_thickness", thickness])

    def test_everything_clamped(self):
        self.refuse(CUBE, "hex8", "structure part", "clamped", more=["-part_clamp", "z_min,z_max"])


class WithoutMass(unittest.TestCase):
    def test_node_that_no_element_uses_is_left_out(self):
        folder = tempfile.mkdtemp(prefix="pounding-")
        found = []
        for number, nodes in enumerate((CUBE.nodes, [*CUBE.nodes.tolist(), [7, 7, 7]])):
            path = Mesh(nodes, CUBE.groups).write(os.path.join(folder, f"{number}.msh"))
            run = History(self, ["-structures", "part", "-part_mesh", path, "-part_body_element", "hex8",
                                 "-part_body_material", "concrete", "-end_time", 1e-6, "-modes", 0,
                                 *scenes.material("concrete", *scenes.CONCRETE)], 2)
            found.append({key: run.summary["structures"]["part"][key] for key in ("nodes", "mass", "omega_max")})
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0]["nodes"], 8)

    def test_rotation_without_inertia(self):
        words = ["-structures", "mass", "-mass_mesh", "tests/meshes/chain.geo", "-mass_first_element", "point_mass",
                 "-mass_first_mass", 1, "-mass_support_element", "grounded_spring", "-mass_support_stiffness",
                 "1,1,1,1,1,1", "-end_time", 1e-3]
        refused(self, words, "structure mass", "(1, 0, 0)", "no mass", ranks=2)

    def test_drilling_rotation_of_a_flat_shell_has_inertia(self):
        run = History(self, [*scenes.lone_elements(["plate"]), "-plate_initial_velocity", "0,0,1"])
        self.assertEqual(run.summary["structures"]["plate"]["dofs"], 24)
        self.assertLess(run.energy["relative_residual"], 1e-12)


if __name__ == "__main__":
    unittest.main()
