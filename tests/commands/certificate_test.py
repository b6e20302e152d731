"""Errors of step and mesh beside that of the reduction, as a run tells them, and the true ones."""
import math
import tempfile
import unittest

import program
from fidelity_target_test import PIERS, reduced, true_error
from two_buildings import pounding


PIERS = [*PIERS, "-end_time", 1.2]  # two impacts


def cells(times):
    """The two piers of bricks of .25 to 1 m, or as many times finer."""
    def words(across, along, up):
        return f"cells_x={times * across},cells_y={times * along},cells_z={times * up}"
    return ["-tall_mesh_set", words(1, 2, 9),
            "-low_mesh_set", "x0=0.604,thickness=0.5,height=7," + words(1, 2, 7)]


class Certificate(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.words = PIERS + cells(1) + reduced(("tall", "low"), 20, 0.3)
        cls.folder, summary = program.must_run(cls(), [*cls.words, "-fidelity_mesh", "true"])
        cls.told = summary["fidelity"]

    def test_mesh_beside_two_splits(self):
        """True by full order on this mesh and on one four times as fine, of whose error that of this is 16 times."""
        coarse, fine = (pounding.load(program.must_run(self, PIERS + cells(times))[0]) for times in (1, 4))
        true = 16 / 15 * true_error(coarse, fine)
        self.assertGreater(self.told["mesh"]["rms"]["1-400"] / true, 0.5, (self.told["mesh"], true))
        self.assertLess(self.told["mesh"]["rms"]["1-400"] / true, 2, (self.told["mesh"], true))
        self.assertEqual(self.told["governs"], "mesh")

    def test_split_meshes_are_those_of_more_cells(self):
        """`mesh_splits` of boxes in bricks: the same cells, numbered otherwise."""
        words = [*PIERS, "-end_time", 0.05]
        split, finer = (program.must_run(self, [*words, *more]) for more in ((*cells(1), "-mesh_splits", 1), cells(2)))
        for name in ("tall", "low"):
            self.assertEqual(*(run[1]["structures"][name]["dofs"] for run in (split, finer)))
        self.assertLess(true_error(*(pounding.load(run[0]) for run in (split, finer))), 1e-6)

    def test_all_errors_in_one(self):
        told = self.told
        self.assertEqual(list(told["mesh"]["channels"]), list(told["channels"]))
        for band, whole in told["whole_rms"].items():
            parts = (told["rms"][band], told["step"]["rms"][band], told["mesh"]["rms"][band])
            self.assertAlmostEqual(whole, math.hypot(*parts), delta=1e-12 * whole)
        self.assertGreater(told["split_dofs"], 4 * told["full_dofs"])
        self.assertEqual(told["mesh_not_judged"], "")

    @unittest.skipUnless(program.ALL, "run/test --all: another run, on two ranks")
    def test_ranks(self):
        told = program.must_run(self, [*self.words, "-fidelity_mesh", "true"], 2)[1]["fidelity"]
        for part in ("step", "mesh"):
            for band, value in self.told[part]["rms"].items():
                self.assertAlmostEqual(told[part]["rms"][band] / value, 1, delta=1e-6, msg=(part, band))

    def test_full_order_with_scaled_mass_has_the_same_mesh(self):
        words = [*PIERS, *cells(1), "-tall_mass_scaling", 1.2e-4, "-low_mass_scaling", 1.2e-4, "-fidelity_window", 0.3]
        told = program.must_run(self, [*words, "-fidelity_mesh", "true"])[1]["fidelity"]
        self.assertAlmostEqual(told["mesh"]["rms"]["1-400"] / self.told["mesh"]["rms"]["1-400"], 1, delta=0.3)

    def test_matrices_have_no_mesh_and_impacts_give_the_step_the_order_one(self):
        """All modes: nothing but the step is left."""
        place = tempfile.mkdtemp(prefix="pounding-")
        program.must_end(self, [*PIERS, *cells(1), "-dry_run", "-export_matrices", place])
        words = PIERS + cells(1) + reduced(("tall", "low"), 1000, 0.3)
        _, summary = program.must_run(
            self, [*words, "-fidelity_mesh", "true", "-tall_matrices", f"{place}/tall", "-low_matrices", f"{place}/low"])
        told = summary["fidelity"]
        self.assertIn("matrices, whose mesh cannot be judged", told["mesh_not_judged"])
        self.assertNotIn("mesh", told)
        self.assertEqual(told["governs"], "step")
        self.assertTrue(told["step"]["order_measured"])
        self.assertLess(told["step"]["order"], 1.5)
        self.assertGreater(told["step"]["rms"]["1-400"], told["rms"]["1-400"])

    def test_it_goes_with_a_window(self):
        program.must_refuse(self, [*PIERS, "-fidelity_mesh", "true"], "-fidelity_mesh", "-fidelity_window")

    @unittest.skipUnless(program.ALL, "run/test --all: two more runs")
    def test_scenes_whose_mesh_is_not_split_say_why(self):
        words = [*self.words, "-fidelity_mesh", "true", "-end_time", 0.6, "-fidelity_window", 0.1]
        probes = ["-probes", "face", "-face_structure", "tall", "-face_group", "east", "-face_average", "false"]
        load = ["-loads", "push", "-push_on", "tall:east", "-push_force", "1,0,0"]
        for more, why in ((probes, "record of each node"), (load, "acts on single nodes")):
            _, summary = program.must_run(self, words + more)
            self.assertIn(why, summary["fidelity"]["mesh_not_judged"])


class Target(unittest.TestCase):
    def test_a_mesh_beyond_the_target_is_told(self):
        words = [*PIERS, *cells(1), "-fidelity_target", 0.05, "-fidelity_window", 0.2, "-fidelity_mesh", "true"]
        result = program.must_end(self, words)
        self.assertRegex(result.stdout, r"the mesh alone is [\d.]+ % off, and must be finer: elements of 0\.\d+ times the size")

    def test_the_step_is_cut_where_it_governs(self):
        """Piers of four bricks, of which 25 modes and attachment vectors are nearly all."""
        words = [*PIERS, "-tall_mesh_set", "cells_x=1,cells_y=2,cells_z=2", "-tall_middle_at", "0,1,4.5", "-low_mesh_set",
                 "x0=0.604,thickness=0.5,height=7,cells_x=1,cells_y=2,cells_z=2", "-fidelity_window", 0.2]
        _, summary = program.must_run(self, words + reduced(("tall", "low"), 25, 0.2))
        self.assertEqual(summary["fidelity"]["governs"], "step")
        target = 0.4 * summary["fidelity"]["whole_rms"]["1-400"]
        _, cut = program.must_run(self, [*words, "-fidelity_target", target])
        self.assertLess(cut["fidelity"]["whole_rms"]["1-400"], target)
        self.assertLess(float(cut["options"]["time_step"]), summary["time_step"])
        self.assertEqual(cut["fidelity_climb"]["modes"], 25)


if __name__ == "__main__":
    unittest.main()
