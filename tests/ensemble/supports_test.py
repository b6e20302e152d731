"""Supports that move on their own in ensembles, where members differ in how they move, and bases of structures on them in
files."""
import os
import shutil
import tempfile
import unittest

import h5py
import numpy as np

import program
from ensemble_test import MODAL, SCENE, compare, overrides, table, time_step

import pounding

SOIL = ["-left_clamp", "none", "-left_rigid", "base", "-left_soil_mat", "base", "-left_soil_size", "6,4", "-left_soil_vs", "200",
        "-left_soil_density", "1900", "-left_soil_poisson", "0.35"]


def record(seed, peak):
    """Waves that set in at once and end at rest, as a file."""
    random = np.random.default_rng(seed)
    times = np.arange(0, 1.0, 0.005)
    values = peak * np.sin(np.pi * times)**2 * sum(np.sin(2 * np.pi * f * times + p) for f, p in zip((3, 7, 11), random.random(3) * 6))
    handle, path = tempfile.mkstemp(suffix=".txt")
    os.close(handle)
    np.savetxt(path, np.column_stack([times, values]), "%.17g")
    return path


class Moved(unittest.TestCase):
    """The two small buildings on supports of their own."""
    COLUMNS = "west_motion_x_record,east_delay,west_rotation_y_record,east_motion_y_scale,floor1_gap,motion_x_seed"

    @classmethod
    def setUpClass(cls):
        cls.rows = [f"{record(1, 1.5)},0.01,{record(2, .05)},1,0.01,1", f"{record(3, 3)},0.05,{record(4, .2)},-2,0.006,1",
                    f"{record(5, 2)},0.1,{record(6, .1)},1,0.004,2"]
        cls.ground = ["-supports", "west,east", "-west_groups", "left", "-east_groups", "right", "-east_delay", "0.02", "-west_point", "3,2,0",
                      "-west_motion_x_record", record(7, 1), "-west_rotation_y_record", record(8, .1), "-west_motion_x_unit", "m/s2",
                      "-east_motion_y_record", record(9, 1), "-east_motion_y_unit", "m/s2"]

    def words(self, *more):
        return [*SCENE, *MODAL, *self.ground, "-end_time", "0.9", "-spectra_damping", "0.05", *more]


class Supports(Moved):
    def check(self, *more, ranks=program.RANKS):
        folder = tempfile.mkdtemp(prefix="pounding-ensemble-")
        words = self.words(*more)
        program.must_end(self, [*words, "-ensemble", table(self.rows, self.COLUMNS), "-output", folder], ranks)
        result = pounding.load_ensemble(folder)
        self.assertTrue(result.done.all())
        self.assertLess(np.abs(result.residual).max(), 1e-9)
        struck = [compare(self, result, m, [*words, "-time_step", time_step(folder), *overrides(self.rows[m], self.COLUMNS)])
                  for m in range(3)]
        self.assertGreater(sum(struck), 0)
        return folder, result

    def test_each_member_is_its_single_run(self):
        self.check()

    def test_at_rest_under_the_weight_with_friction(self):
        self.check("-gravity", "9.81", "-preload", "static", "-floor1_friction", "0.4", "-floor2_friction", "0.4")

    def test_with_soil_under_a_mat(self):
        self.check(*SOIL)

    def test_passes_that_are_only_looked_at(self):
        """Feet that turn bring other faces together."""
        self.check("-floor1_gap", "0.001")

    def test_ranks_and_an_ensemble_that_goes_on(self):
        _, one = self.check(ranks=1)
        for ranks in (2, 3):
            folder, other = self.check(ranks=ranks)
            np.testing.assert_array_equal(one.pseudo_acceleration, other.pseudo_acceleration)
            np.testing.assert_array_equal(one.impacts["impulse_sum"], other.impacts["impulse_sum"])
        with h5py.File(os.path.join(folder, "ensemble.h5"), "r+") as file:  # as if killed
            file["done"][1] = 0
            file["spectra/pseudo_acceleration"][1] = np.nan
        again = program.must_end(self, [*self.words(), "-ensemble", table(self.rows, self.COLUMNS), "-output", folder], 1)
        self.assertIn("2 of 3 members are done already", again.stdout)
        np.testing.assert_array_equal(one.pseudo_acceleration, pounding.load_ensemble(folder).pseudo_acceleration)

    def test_a_support_that_moves_in_one_member_only_is_refused(self):
        for column, row, told in (("east_motion_z_record", record(1, 1), "support east has a motion of its own (z) here and not in the scene"),
                                  ("east_delay", "0", "support east has a motion of its own (x) in the scene and not here")):
            words = [*self.words(), "-ensemble", table([row], column), "-dry_run"]
            program.must_refuse(self, words, "line 2 (member 1)", told, "every member")
        program.must_refuse(self, [*self.words(), "-ensemble", table(["left"], "west_groups"), "-dry_run"],
                            "column 'west_groups' is no option that may differ", "<support>_motion_...")


class Bases(Moved):
    """A basis in a file goes with the supports that it was made for."""

    def run_with(self, basis, *more):
        folder = tempfile.mkdtemp(prefix="pounding-basis-")
        done = program.must_end(self, self.words("-left_modal_basis", basis, "-output", folder, *more), 1)
        return pounding.load(folder), done.stdout

    def test_a_basis_is_used_again_where_the_supports_are_the_same(self):
        basis = os.path.join(tempfile.mkdtemp(prefix="pounding-basis-"), "left.h5")
        first, told = self.run_with(basis)
        self.assertNotIn("modal basis from", told)
        again, told = self.run_with(basis)
        self.assertIn("modal basis from", told)
        np.testing.assert_array_equal(first.history["displacement"][:], again.history["displacement"][:])
        for more in (["-west_point", "3,2,1"], ["-west_motion_y_record", record(1, 1), "-west_motion_y_unit", "m/s2"],
                     ["-west_groups", "left:base"]):
            copy = shutil.copy(basis, basis + ".copy")
            _, told = self.run_with(copy, *more)
            self.assertIn("is of another model (number of vectors): computed anew", told)


if __name__ == "__main__":
    unittest.main()
