"""Numbers of hexahedra of general shape in 32 bits, beside the same in 64.

A cube of 5 x 5 x 5 distorted hexahedra, 648 dofs, free: every frequency from the exported matrices. A tower of such
hexahedra at rest under its weight; two of them that collide.
"""
import os
import sys
import tempfile
import unittest

import h5py
import numpy
import scipy.io
import scipy.linalg

import program
from recorded import all_nodes, assert_continues

sys.path.insert(0, os.path.join(program.SOURCE, "tests", "stability"))
from small_meshes import brick  # noqa: E402

CONCRETE = ["-material_concrete_young", "30e9", "-material_concrete_poisson", 0.2, "-material_concrete_density", 2400]
CHANGE, RIGID = 1e-8, 1e-6  # of frequencies; of the six lowest, as parts of the highest


def distorted(low, high, cells, out, flat=()):
    """A brick whose nodes are moved at random, by up to a part of its cells; those of some groups stay on their faces."""
    mesh = brick(low, high, cells)
    size = (numpy.array(high) - low) / cells
    way = numpy.random.default_rng(5).uniform(-out, out, mesh.nodes.shape) * size
    for name in flat:
        nodes = numpy.unique(mesh.groups[name][1])
        way[nodes, "xyz".index(name[0])] = 0
    return mesh.placed(lambda nodes: nodes + way)


def structure(name, mesh, numbers="single", element="hex8"):
    path = mesh.write(os.path.join(tempfile.mkdtemp(), "mesh.msh"))
    return [f"-{name}_mesh", path, f"-{name}_body_element", element, f"-{name}_body_material", "concrete",
            f"-{name}_numbers", numbers]


def exact_frequencies(test, numbers, element):
    folder = tempfile.mkdtemp()
    program.must_run(test, ["-structures", "cube", "-end_time", 1e-9, *CONCRETE, "-export_matrices", folder,
                            *structure("cube", distorted((0, 0, 0), (1, 1, 1), (5, 5, 5), .15), numbers, element)])
    stiffness, mass = (scipy.io.mmread(os.path.join(folder, "cube", f"{name}.mtx")) for name in ("stiffness", "mass"))
    scale = 1 / numpy.sqrt(mass.diagonal())
    return numpy.sqrt(numpy.abs(scipy.linalg.eigvalsh(scale[:, None] * stiffness.toarray() * scale)))


class Frequencies(unittest.TestCase):
    def test_of_a_free_cube(self):
        for element in ("hex8", "hex8_full"):
            exact, found = (exact_frequencies(self, numbers, element) for numbers in ("double", "single"))
            self.assertEqual(len(exact), 648)
            change = numpy.abs(found[6:] / exact[6:] - 1).max()
            rigid = found[:6].max() / found[-1]
            print(f"  {element}: 642 frequencies within {change:.1e}, six of {rigid:.1e} of the highest")
            self.assertLess(change, CHANGE, element)
            self.assertGreater(change, 1e-11, element)
            self.assertLess(rigid, RIGID, element)


def tower(*words, numbers="single"):
    """2 x 2 x 8 cells under their weight."""
    mesh = distorted((0, 0, 0), (1, 1, 4), (2, 2, 8), .15, ("z_min",))
    return [*structure("tower", mesh, numbers), *CONCRETE, "-structures", "tower", *all_nodes("nodes", "tower"), "-probes", "nodes",
            "-gravity", 9.81, *words]


def displacement(test, words, ranks=1):
    """Of all channels at all samples, shape (samples, channels), and the summary."""
    folder, summary = program.must_run(test, ["-modes", 1, *words], ranks)
    with h5py.File(os.path.join(folder, "history.h5")) as file:
        return file["displacement"][()], summary


class Rest(unittest.TestCase):
    def test_a_clamped_tower_stays_where_its_weight_put_it(self):
        end = 5 if program.ALL else .2
        way, summary = displacement(self, tower("-tower_clamp", "z_min", "-preload", "static", "-end_time", end, "-output_interval", .01))
        print(f"  {summary['steps']} steps")
        self.assertIn("of these 32 in 32 bits", summary["structures"]["tower"]["stiffness"])
        self.assertGreater(numpy.abs(way[0]).max(), 1e-6)
        self.assertLess(numpy.abs(way - way[0]).max(), 1e-13)


def blocks(*words, numbers="single"):
    """Two blocks of distorted hexahedra, one at rest on its foot, that collide."""
    left = distorted((0, 0, 0), (1, 1, 2), (2, 2, 3), .15, ("x_max", "z_min"))
    right = distorted((1.001, 0, 0), (2.001, 1, 2), (2, 2, 3), .15, ("x_min", "z_min"))
    return ["-structures", "left,right", *structure("left", left, numbers), *structure("right", right, numbers), *CONCRETE,
            "-left_clamp", "z_min", "-right_clamp", "z_min", "-contacts", "joint", "-joint_secondary", "left:x_max",
            "-joint_primary", "right:x_min", "-right_initial_velocity", "-3,0.2,0", "-gravity", 9.81, "-end_time", .01,
            *all_nodes("nodes", "left"), "-probes", "nodes", *words]


class OneOperator(unittest.TestCase):
    def test_however_it_is_applied(self):
        found, summary = displacement(self, blocks("-stiffness", "element"))
        self.assertGreater(summary["contact"]["impulse"] if "contact" in summary else len(found), 0)
        self.assertLess(summary["energy"]["relative_residual"], 1e-12)
        matrix = displacement(self, blocks("-stiffness", "assembled"))[0]
        exact = displacement(self, blocks("-stiffness", "element", numbers="double"))[0]
        scale = numpy.abs(exact).max()
        self.assertLess(numpy.abs(found - matrix).max(), 1e-11 * scale)
        self.assertGreater(numpy.abs(found - exact).max(), 1e-10 * scale)

    def test_continued_to_the_bit(self):
        assert_continues(self, blocks(), .005, 20)

    def test_members_are_single_runs(self):
        folder = tempfile.mkdtemp()
        table = os.path.join(folder, "members.csv")
        with open(table, "w") as file:
            file.write("joint_gap\n0.001\n0.002\n")
        common = blocks("-spectra_damping", .05, "-time_step", 1e-5)
        program.must_end(self, [*common, "-ensemble", table, "-output", folder], 1)
        with h5py.File(os.path.join(folder, "ensemble.h5")) as file:
            peaks = file["peaks/displacement"][()]
        for member, gap in enumerate((.001, .002)):
            way = displacement(self, [*common, "-joint_gap", gap])[0]
            self.assertGreater(numpy.abs(way).max(), 1e-3)
            numpy.testing.assert_allclose(peaks[member].ravel(), numpy.abs(way).max(axis=0)[:peaks[member].size], rtol=1e-9, atol=1e-15)

    def test_bases_are_not_taken_over(self):
        basis = os.path.join(tempfile.mkdtemp(), "basis.h5")
        modal = ["-left_model", "modal", "-left_modal_vectors", 4, "-left_modal_basis", basis]
        program.must_end(self, blocks(*modal, numbers="double"), 1)
        again = program.must_end(self, blocks(*modal), 1)
        self.assertIn("elements", again.stdout + again.stderr)


class Refusals(unittest.TestCase):
    def test_without_hexahedra(self):
        words = blocks("-left_body_element", "hex8")
        at = words.index("-left_numbers")
        self.assertEqual(words[at + 1], "single")
        program.must_refuse(self, ["-structures", "plate", "-plate_mesh", "tests/meshes/floor.geo", "-plate_plate_element", "shell",
                                   "-plate_plate_material", "concrete", "-plate_plate_thickness", .1, *CONCRETE, "-plate_numbers",
                                   "single", "-end_time", 1e-3],
                            "option -plate_numbers single: the structure has no hexahedra")


ON_RANKS = {"hexahedra with numbers in 32 bits": blocks}


if __name__ == "__main__":
    unittest.main()
