"""Drift of the lowest storey against what it stands on, which may move: a support, soil, an isolator.

A mass on a column of 3 m. Under a ground that moves as one, and on a support that moves alone by the same record, its
column bends alike. On a foot that is free on soft springs the base sways as the foot's own probe says.
"""
import os
import tempfile
import unittest

import h5py
import numpy

import program
from decks import clock, in_modes, material, section
from support_motion_test import Pulse

MESH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
0 1 "foot"
0 2 "soil"
0 3 "mass"
1 4 "column"
$EndPhysicalNames
$Nodes
2
1 0 0 0
2 0 0 3
$EndNodes
$Elements
4
1 15 2 1 1 1
2 15 2 2 2 1
3 15 2 3 3 2
4 1 2 4 1 1 2
$EndElements
"""
HEIGHT = 3.0


class Bases(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-bases-")
        cls.mesh = os.path.join(cls.folder, "stick.msh")
        with open(cls.mesh, "w") as file:
            file.write(MESH)
        cls.pulse = Pulse(0.02, 0.5)
        cls.record = cls.pulse.file

    def words(self, *more):
        return ["-structures", "a", "-a_mesh", self.mesh, "-a_mass_element", "point_mass", "-a_mass_mass", 5000,
                "-a_column_element", "beam", "-a_column_material", "steel", "-a_column_section", "leg",
                *material("steel", "2.1e11", 0.3, 7850), *section("leg", 0.04, "4e-4", "2e-4", "3e-4", "0,1,0"),
                *clock(2e-5, 2, 1e-3), "-spectra_frequencies", "1,20", "-probes", "top,feet", "-top_structure", "a",
                "-top_at", f"0,0,{HEIGHT}", "-top_floor", "true", "-feet_structure", "a", "-feet_at", "0,0,0", *more]

    def clamped(self, *more):
        return self.words("-a_clamp", "foot", "-a_ignore", "soil", *more)

    def on_soil(self, *more):
        return self.words("-a_soil_element", "grounded_spring", "-a_soil_stiffness", "2e6,2e6,1e9,1e8,1e8,1e8",
                          "-a_foot_element", "point_mass", "-a_foot_mass", 4000, "-motion_x_record", self.record,
                          "-motion_x_unit", "m/s2", *more)

    def drift(self, words, ranks=2):
        """Peak of the lowest storey along x, and the largest sway of its floor and of its foot."""
        folder, summary = program.must_run(self, words, ranks)
        with h5py.File(os.path.join(folder, "history.h5")) as file:
            moved = file["displacement"][()]
            base = file["base_displacement"][()] if "bases" in file else None
            if base is not None:
                self.assertEqual([name.decode() for name in file["bases"]], ["a.x", "a.y", "a.z"])
                numpy.testing.assert_allclose(base, moved[:, 3:6], rtol=0, atol=1e-15)
        storey, = summary["drifts"]
        self.assertEqual((storey["upper"], storey["lower"], storey["height"]), ("top", "base", HEIGHT))
        sway = moved[:, 0] - moved[:, 3]
        self.assertAlmostEqual(abs(storey["peak"][0]) * HEIGHT / abs(sway).max(), 1, delta=1e-9)
        return abs(storey["peak"][0]), abs(moved[:, 0]).max(), abs(moved[:, 3]).max()

    def test_a_support_that_moves_alone_bends_the_column_as_the_ground_does(self):
        ground = self.clamped("-motion_x_record", self.record, "-motion_x_unit", "m/s2")
        alone = self.clamped("-supports", "rock", "-rock_groups", "a:foot", "-rock_motion_x_record", self.record,
                             "-rock_motion_x_unit", "m/s2")
        expected, _, held = self.drift(ground)
        self.assertEqual(held, 0)
        found, sway, base = self.drift(alone)
        self.assertGreater(base, 20 * expected * HEIGHT, "the base moves far")
        self.assertAlmostEqual(found / expected, 1, delta=1e-6)
        self.assertGreater(sway, base / 2)
        reduced = [*in_modes("a", 6)]
        found, _, _ = self.drift(alone + reduced, 1)
        self.assertAlmostEqual(found / expected, 1, delta=1e-3)

    def test_soil_under_the_foot_is_not_in_the_drift(self):
        full, sway, base = self.drift(self.on_soil())
        self.assertGreater(base, sway / 2, "soil gives more than the column")
        self.assertLess(full * HEIGHT, sway / 2)
        reduced, _, _ = self.drift(self.on_soil(*in_modes("a", 12)), 1)
        self.assertAlmostEqual(reduced / full, 1, delta=1e-6)

    def test_a_continued_run_has_the_same_drift(self):
        words = self.on_soil()
        whole, first = tempfile.mkdtemp(dir=self.folder), tempfile.mkdtemp(dir=self.folder)
        for folder, more in ((whole, []), (first, ["-end_time", 1.2, "-checkpoint_steps", 60000]),
                             (first, ["-restart", os.path.join(first, "checkpoint.h5")])):
            done = program.must_end(self, [*words, *more, "-output", folder], 2)
        self.assertEqual(program.summary(first)["drifts"], program.summary(whole)["drifts"])


if __name__ == "__main__":
    unittest.main()
