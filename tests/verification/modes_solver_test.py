"""Modes without a factorisation (-modes_solver iterative): those of the factorisation, on solids and thin
shells, clamped, free, on stiff springs, with a rigid end and with scaled mass, on any number of ranks. Every copy of
a frequency is found, however early the factorisation's iteration ends.
"""
import tempfile
import unittest

import modal_run
import program
from plate_modes_test import plate, springs
from solid_modes_test import box, cantilever

CASES = {
    "clamped bricks": cantilever((10, 1, 1), "hex8"),
    "free bricks": box((3, 2.5, 0.22), (6, 5, 1), "hex8"),
    "free thin plate": plate(4, 0.05, ()),
    "thin plate on springs": plate(4, 0.05, springs(1e10, True)),
    "rigid end": box((5, 0.5, 0.3), (10, 1, 1), "hex8", "-@_rigid", "x_max", "-@_clamp", "x_min"),
    "scaled mass": box((5, 0.5, 0.3), (10, 1, 1), "hex8", "-@_clamp", "x_min", "-@_mass_scaling", 1e-4),
}


def find(test, solver, ranks):
    cases = [[*words, "-modes_solver", solver, "-time_step", 1e-7] for words in CASES.values()]
    return modal_run.structures(test, cases, 10, ranks)


class WithoutAFactor(unittest.TestCase):
    def test_modes_are_those_of_the_factorisation_on_one_two_and_three_ranks(self):
        expected = find(self, "direct", 2)
        for ranks in (1, 2, 3):
            for name, direct, found in zip(CASES, expected, find(self, "iterative", ranks)):
                self.assertNotIn("modes_by", direct)
                self.assertIn("generalised Davidson", found["modes_by"], name)
                for one, other in zip(direct["frequencies"], found["frequencies"]):
                    close = 1e-7 * one["frequency"] if one["frequency"] > 0.01 else 0.01  # a motion without strain
                    self.assertAlmostEqual(one["frequency"], other["frequency"], delta=close, msg=(name, ranks))

    def test_refusals(self):
        scene = [*program.COARSE_PAIR, "-modes_solver", "iterative", "-dry_run"]
        program.must_refuse(self, [*scene, "-lowest_eps_max_it", 1], "modes converged", "-lowest_eps_max_it")
        program.must_refuse(self, [*program.COARSE_PAIR, "-modes_solver", "cg"], "-modes_solver", "auto direct iterative")


def posts(count, cells=4, height=2.0):
    """A mesh of equal posts that nothing joins, in a file."""
    each = cells + 1
    nodes = [f"{p * each + k + 1} {3 * p} 0 {height * k / cells}" for p in range(count) for k in range(each)]
    feet = [f"15 2 1 {p + 1} {p * each + 1}" for p in range(count)]
    lines = [f"1 2 2 {p + 1} {p * each + k + 1} {p * each + k + 2}" for p in range(count) for k in range(cells)]
    elements = [f"{number} {line}" for number, line in enumerate(feet + lines, 1)]
    file = tempfile.NamedTemporaryFile("w", suffix=".msh")
    file.write("\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '0 1 "feet"', '1 2 "posts"',
                          "$EndPhysicalNames", "$Nodes", str(len(nodes)), *nodes, "$EndNodes", "$Elements",
                          str(len(elements)), *elements, "$EndElements", ""]))
    file.flush()
    return file


class Copies(unittest.TestCase):
    """Posts that bend alike in two directions: twice as many copies of every frequency as there are posts."""

    def test_none_is_missed(self):
        for count, ranks, more in ((12, 1, []), (12, 2, []), (30, 2, []), (12, 2, ["-p_mass_scaling", 1e-4])):
            with posts(count) as mesh:
                _, summary = program.must_run(self, [
                    "-structures", "p", "-p_mesh", mesh.name, "-p_clamp", "feet", "-p_allow_loose", "true",
                    "-p_posts_element", "beam", "-p_posts_material", "steel", "-material_steel_young", 2e11,
                    "-material_steel_poisson", 0.3, "-material_steel_density", 7800, "-p_posts_section", "rod",
                    "-section_rod_area", 0.01, "-section_rod_inertia_y", 1e-5, "-section_rod_inertia_z", 1e-5,
                    "-section_rod_torsion", 2e-5, "-section_rod_z_axis", "1,0,0", "-p_initial_velocity", "1,0,0",
                    "-end_time", 1e-3, "-modes", 2 * count + 2, "-lowest_eps_tol", 1e-4, *more], ranks)
            found = [mode["frequency"] for mode in summary["structures"]["p"]["frequencies"]]
            first = [frequency for frequency in found if abs(frequency / found[0] - 1) < 1e-6]
            self.assertEqual(len(first), 2 * count, (count, ranks, more))


if __name__ == "__main__":
    unittest.main()
