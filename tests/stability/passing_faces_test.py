"""Nodes of the primary between those of the secondary.

A cube of 1 m flies at 1 m/s to one 20 mm away whose face bulges by 10 mm in its middle. Of one pass the nodes of the
first cube's single facet alone are kept out, so that the bulge goes 10 mm into it before they strike, at 20 ms in place of
10. Columns beside a wall between whose nodes the wall sways are the same with lines.
"""
import tempfile
import unittest

import h5py

import program
from history import History, scenes
from small_meshes import Mesh, brick

BULGE, GAP = 0.01, 0.02


def bulging(secondary="one", *more, end=0.03, young=1e9):
    """Words of the scene, with the facet of one side as the secondary."""
    other = {"one": "two", "two": "one"}[secondary]
    face = {"one": "one:x_max", "two": "two:x_min"}
    words = ["-structures", "one,two", "-contacts", "joint", "-joint_secondary", face[secondary], "-joint_primary", face[other],
             "-one_initial_velocity", "1,0,0", "-time_step", "5e-5", "-end_time", end, "-output_interval", 5e-4,
             "-energy_interval", 1]
    folder = tempfile.mkdtemp()
    for name, start, cells in (("one", -1, 1), ("two", GAP, 2)):
        mesh = brick((start, 0, 0), (start + 1, 1, 1), (1, cells, cells))
        middle = (mesh.nodes == (GAP, 0.5, 0.5)).all(axis=1)
        mesh.nodes[middle, 0] -= BULGE
        words += [f"-{name}_mesh", mesh.write(f"{folder}/{name}.msh"), f"-{name}_body_element", "hex8_full",
                  f"-{name}_body_material", "stiff"]
    return [*words, *scenes.material("stiff", young, 0, 2000), *more]


def column_beside_wall(*more):
    """A column of one beam a side, whose ends and middle are its nodes, 10 mm from a wall of shells as fine as 0.25 m."""
    across, up = 3, 17
    nodes = [(0.01, 0.25 * i - 0.25, 0.25 * k) for k in range(up) for i in range(across)]
    cells = [[across * k + i, across * k + i + 1, across * (k + 1) + i + 1, across * (k + 1) + i]
             for k in range(up - 1) for i in range(across - 1)]
    wall = Mesh(nodes, {"wall": ("quadrangle", cells)})
    column = Mesh([(0, 0, 0), (0, 0, 2), (0, 0, 4)], {"column": ("line", [[0, 1], [1, 2]])})
    folder = tempfile.mkdtemp()
    return ["-structures", "hall,house", "-contacts", "joint", "-joint_secondary", "hall:column", "-joint_primary",
            "house:wall", "-hall_mesh", column.write(f"{folder}/column.msh"), "-house_mesh",
            wall.write(f"{folder}/wall.msh"), "-hall_column_element", "beam", "-hall_column_material", "soft",
            "-hall_column_section", "square", "-section_square_area", 0.01, "-section_square_inertia_y", 1e-5,
            "-section_square_inertia_z", 1e-5, "-section_square_torsion", 1e-5, "-section_square_z_axis", "1,0,0",
            "-house_wall_element", "shell", "-house_wall_material", "soft", "-house_wall_thickness", 0.01,
            "-joint_gap", 0.005, "-house_initial_velocity", "-1,0,0", "-end_time", 0.02, "-output_interval", 1e-3, "-energy_interval", 1,
            *scenes.material("soft", 1e8, 0.2, 2000), *more]


def doubts(run):
    """The warnings of a run that are about contacts."""
    return [line for line in run.summary["warnings"] if line.startswith("contact")]


class Passes(unittest.TestCase):
    def assert_passed(self, run, depth, delta):
        """A warning and the summary tell the same."""
        other = run.summary["contacts"]["joint"]["other_pass"]
        self.assertAlmostEqual(other["depth"], depth, delta=delta)
        said = [line for line in doubts(run) if "in one pass" in line]
        self.assertEqual(len(said), 1)
        self.assertIn(f"up to {1e3 * other['depth']:.3g} mm", said[0])
        return other

    def test_larger_facets_of_the_secondary_take_two(self):
        for secondary, passes in (("one", 2), ("two", 1)):
            run = History(self, bulging(secondary))
            contact = run.summary["contacts"]["joint"]
            self.assertEqual(contact["passes"], passes, secondary)
            self.assertAlmostEqual(run.column("start")[0], GAP - BULGE, delta=1e-4)
            self.assertEqual([line for line in doubts(run) if "pass" in line], [])

    def test_pass_that_is_not_taken_is_looked_at(self):
        run = History(self, bulging("one", "-joint_passes", 1))
        self.assertAlmostEqual(run.column("start")[0], GAP, delta=1e-4)
        other = self.assert_passed(run, BULGE, 1.1e-3)  # a look per ms
        self.assertAlmostEqual(other["facet_size"], 1, delta=1e-12)
        self.assertEqual([round(x, 12) for x in other["place"]], [0.5, 0.5])
        self.assertIn("passes 2", " ".join(doubts(run)))

    def test_of_reduced_structures_too(self):
        modal = [word for name in ("one", "two")
                 for word in (f"-{name}_model", "modal", f"-{name}_modal_vectors", 3)]
        run = History(self, bulging("one", "-joint_passes", 1, *modal))
        self.assert_passed(run, BULGE, 1.1e-3)

    def test_members_of_an_ensemble_too(self):
        """As their single runs, and one line says so of both."""
        words = bulging("one", "-joint_passes", 1, *(word for name in ("one", "two") for word in (
            f"-{name}_model", "modal", f"-{name}_modal_vectors", 3)), "-probes", "p", "-p_structure", "one", "-p_at", "-1,0,0",
            "-spectra_frequencies", 10)
        with tempfile.TemporaryDirectory() as folder:
            with open(f"{folder}/members.csv", "w") as file:
                file.write("one_stiffness_factor\n1\n2\n")
            said = program.must_end(self, [*words, "-ensemble", f"{folder}/members.csv", "-output", f"{folder}/out"], 1).stdout
            line, = (line for line in said.splitlines() if line.startswith("warning:") and "in one pass" in line)
            self.assertIn("(0.5, 0.5) m", line)
            self.assertIn("(2 members, the first is member 1, line 2)", line)
            with h5py.File(f"{folder}/out/ensemble.h5") as file:
                found = {name: file[f"other_pass/{name}"][:, 0] for name in ("depth", "time")}
        for member, factor in enumerate((1, 2)):
            other = History(self, [*words, "-one_stiffness_factor", factor]).summary["contacts"]["joint"]["other_pass"]
            for name in ("depth", "time"):
                self.assertAlmostEqual(found[name][member] / other[name], 1, delta=1e-9)

    def test_lines_take_two(self):
        run = History(self, column_beside_wall())
        self.assertEqual(run.summary["contacts"]["joint"]["passes"], 2)
        self.assertAlmostEqual(run.column("start")[0], 0.005, delta=2e-4)

    def test_gap_given_counts_for_the_pass_that_is_not_taken(self):
        run = History(self, bulging("one", "-joint_passes", 1, "-joint_gap", GAP))
        other = run.summary["contacts"]["joint"]["other_pass"]
        self.assertLess(other["depth"], 1e-3)  # of the middle, which is at rest until it is pulled along

    def test_restart_after_the_deepest_keeps_it(self):
        words = bulging("one", "-joint_passes", 1)
        whole = History(self, words)
        with tempfile.TemporaryDirectory() as folder:
            program.must_end(self, [*words, "-checkpoint_steps", 500, "-end_time", 0.0255, "-output", folder])
            again = History(self, [*words, "-restart", f"{folder}/checkpoint.h5"])
        self.assertEqual(*(run.summary["contacts"]["joint"]["other_pass"] for run in (whole, again)))


ON_RANKS = {"faces of which one pass is looked at": lambda: bulging("one", "-joint_passes", 1),
            "columns beside a wall": lambda: column_beside_wall()}


if __name__ == "__main__":
    unittest.main()
