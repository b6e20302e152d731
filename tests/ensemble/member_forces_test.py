"""Recorded forces of members, and how far their bases settled: those of the member's single run, on one rank, two and three; and
which forces members do not keep."""
import os
import tempfile
import unittest

import h5py
import numpy as np

import program
from ensemble_test import MODAL, SCENE, overrides, table, time_step
from soil_tables import coupled, write_soil

import pounding
from pounding import stability

COLUMNS = "motion_x_seed,motion_x_pga,floor1_gap,floor2_gap,left_damping_factor"
ROWS = ["1,3.5,0.01,0.01,1", "2,5,,\"0.008,0.012\",0.5", "3,4,0.012,0.009,2"]
FORCES = ["-forces", "left_base,right_base,above,roof_columns", "-left_base_structure", "left", "-left_base_kind", "reactions",
          "-left_base_about", "3,2,0", "-right_base_structure", "right", "-right_base_kind", "reactions",
          "-above_structure", "left", "-above_kind", "storey", "-above_level", "1.5", "-roof_columns_structure", "right",
          "-roof_columns_kind", "cut", "-roof_columns_group", "columns", "-roof_columns_level", "4.6"]
SOIL = ["-left_clamp", "none", "-left_rigid", "base", "-left_soil_mat", "base"]


class Members(unittest.TestCase):
    def check(self, *words, ranks=(1,), rows=ROWS, columns=COLUMNS):
        words = [*SCENE, *MODAL, "-end_time", "0.5", "-spectra_damping", "0.05", "-spectra_frequencies", "5", *FORCES, *words]
        first, none = None, np.zeros((len(rows), 0))
        for count in ranks:
            folder = tempfile.mkdtemp(prefix="pounding-ensemble-")
            program.must_end(self, [*words, "-ensemble", table(rows, columns), "-output", folder], count)
            result = pounding.load_ensemble(folder)
            self.assertEqual(len(result.force_names), 24)
            first = first or result
            np.testing.assert_array_equal(result.forces, first.forces)
        words += ["-time_step", time_step(folder)]
        for member, row in enumerate(rows):
            place, _ = program.must_run(self, [*words, *overrides(row, columns)], 1)
            single = pounding.load(place)
            np.testing.assert_allclose(result.force_time, single.history["time"], rtol=0, atol=1e-12)
            self.assertEqual(result.force_names, list(single.history["forces"]))
            own, theirs = single.history["force"], result.forces[member]
            largest = np.maximum(abs(own[:, :, None]).max(0).T, 1.0)
            self.assertGreater(largest.max(), 1e4)
            self.assertLess((abs(theirs - own) / np.repeat(largest.reshape(-1, 6).max(1), 6)).max(), 1e-9)
            with h5py.File(os.path.join(folder, "ensemble.h5")) as file:
                for base, moved in zip(file.get("bases/names", []), file.get("bases/settled", none)[member]):
                    np.testing.assert_allclose(moved, stability.base_motion(single, base.decode()), rtol=1e-9, atol=1e-12 * abs(moved).max())

    def test_on_one_rank_two_and_three(self):
        self.check("-gravity", "9.81", "-preload", "static", ranks=(1, 2, 3))

    def test_rayleigh_and_a_stiffness_of_their_own(self):
        self.check("-left_damping_uniform", "0", "-left_damping_reference", "", "-left_damping_alpha", "0.5",
                   "-left_damping_beta", "1e-5", rows=["1,4,1.2", "2,5,0.8"], columns="motion_x_seed,motion_x_pga,left_stiffness_factor")

    def test_on_soil_whose_dashpots_brake_all_at_once(self):
        self.check(*SOIL, "-left_soil_size", "6,4", "-left_soil_vs", "200", "-left_soil_density", "1900", "-left_soil_poisson",
                   "0.35", "-left_soil_frequency_dependence", "false", "-left_roof_floor", "true")

    def test_dashpots_of_feet_of_members_of_other_masses(self):
        self.check("-left_clamp", "none", "-left_base_element", "grounded_spring", "-left_base_stiffness", "2e7,2e7,6e7,2e7,2e7,2e7",
                   "-left_base_dashpot", "2e5,2e5,4e5,0,0,0", "-left_mass_scaling", "2e-3", "-time_step", "1e-4",
                   rows=["1,4,1", "2,5,1.3"], columns="motion_x_seed,motion_x_pga,left_stiffness_factor")

    def test_on_soil_from_a_table(self):
        self.check(*SOIL, "-left_soil_table", write_soil(coupled))

    def test_forces_of_elements_are_refused(self):
        program.must_refuse(self, [*SCENE, *MODAL, "-forces", "posts", "-posts_structure", "left", "-posts_kind", "members",
                                   "-posts_group", "columns", "-ensemble", table(["1"], "motion_x_seed")],
                            "forces posts are those of elements", "reactions, storeys and cuts")


if __name__ == "__main__":
    unittest.main()
