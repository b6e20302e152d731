"""Structures at full order in ensembles: members are their single runs, whether their structures are stepped eight runs at a
time or run by run, alone or beside reduced ones, on any number of ranks to the bit; and what such ensembles refuse."""
import os
import tempfile
import unittest

import h5py
import numpy as np

import program
from ensemble_test import MODAL, SCENE, overrides, table, time_step

import pounding
from pounding import stability

FRICTION = ["-floor1_friction", "0.3", "-floor2_friction", "0.2"]
WEIGHT = ["-gravity", "9.81", "-preload", "static"]
# A mat on soil moves as a rigid body, whose mass is coupled.
SOIL = ["-left_clamp", "none", "-left_rigid", "base", "-left_soil_mat", "base", "-left_soil_size", "6,4", "-left_soil_vs", "200",
        "-left_soil_density", "1900", "-left_soil_poisson", "0.35"]
COLUMNS = "motion_x_seed,motion_x_pga,floor1_gap,floor2_gap,left_damping_factor"
ROWS = ["1,3.5,0.01,0.01,1", "4,6,\"0.004,0.006\",0.005,0.6", "5,4,0.003,0.003,1"]
EXACT = ("spectra/pseudo_acceleration", "impacts/impulse_sum", "peaks/displacement", "peaks/acceleration", "gaps/smallest",
         "pairs/displacement", "energy/residual", "impacts/slip")


def compare(test, result, member, words):
    """Holds a member against the single run of these words; returns the number of its impacts. Floors that nothing moves
    across have spectra of round-off alone: all are held against the largest."""
    single = pounding.load(program.must_run(test, words, 1)[0])
    spectra = np.array([single.spectrum(*channel.split(), damping)[1]
                        for channel in result.channels for damping in result.damping])
    own = result.pseudo_acceleration[member].reshape(spectra.shape)
    test.assertLess(np.abs(own - spectra).max(), 1e-11 * spectra.max())
    impulses = single.impacts["impulse"]
    test.assertEqual(result.impacts["episodes"][member].sum(), len(impulses))
    test.assertAlmostEqual(result.impacts["impulse_sum"][member].sum(), sum(impulses), delta=1e-11 * max(sum(impulses), 1))
    for c, contact in enumerate(result.contacts):
        if "slip" in result.impacts:
            slip = stability.slip_of(single, contact)
            test.assertAlmostEqual(result.impacts["slip"][member, c], slip, delta=1e-9 * slip)
        test.assertAlmostEqual(result.smallest_gap[member, c], np.nanmin(single.history["gap"][:, c]), delta=1e-12)
    return len(impulses)


def settled(folder, member):
    """Structure -> stability.MOTIONS of its base in a member."""
    with h5py.File(os.path.join(folder, "ensemble.h5")) as file:
        return dict(zip(map(bytes.decode, file["bases/names"]), file["bases/settled"][member]))


class Members(unittest.TestCase):
    def check(self, *more, plan, singles=(0, 1, 2)):
        """Steps the ensemble, holds its members against single runs; `plan`: what the program says it does."""
        folder = tempfile.mkdtemp(prefix="pounding-full-order-")
        words = [*SCENE, "-end_time", "0.8", "-spectra_damping", "0.05", *more]
        run = program.must_end(self, [*words, "-ensemble", table(ROWS, COLUMNS), "-output", folder], 1)
        for line in plan:
            self.assertIn(line, run.stdout)
        result = pounding.load_ensemble(folder)
        self.assertTrue(result.done.all())
        self.assertLess(np.abs(result.residual).max(), 1e-9)
        struck = [compare(self, result, m, [*words, "-time_step", time_step(folder), *overrides(ROWS[m], COLUMNS)])
                  for m in singles]
        self.assertGreater(sum(struck), 0)
        return words, folder

    def test_together_with_friction_under_their_weight(self):
        words, folder = self.check(*FRICTION, *WEIGHT, plan=[f"structure {name}: at full order, stepped eight runs at a time"
                                                             for name in ("left", "right")], singles=(1, 2))
        for ranks in (1, 2, 3):
            again = tempfile.mkdtemp(prefix="pounding-full-order-")
            program.must_end(self, [*words, "-ensemble", table(ROWS, COLUMNS), "-output", again], ranks)
            with h5py.File(os.path.join(folder, "ensemble.h5")) as one, h5py.File(os.path.join(again, "ensemble.h5")) as other:
                for name in EXACT:
                    np.testing.assert_array_equal(one[name][:], other[name][:], f"{name} on {ranks} ranks")

    def test_settlement_on_ground_that_yields(self):
        """Rocking presses the feet of a building beyond their strength; run by run on one rank to three."""
        words = [*SCENE, "-end_time", "0.6", *WEIGHT, "-left_clamp", "none", "-left_base_element", "grounded_spring", "-left_base_stiffness",
                 "2e7,2e7,6e7", "-left_base_dashpot", "2e5,2e5,4e5", "-left_base_yield_force", "0,0,2e4", "-left_base_hardening", "0.1",
                 "-left_roof_floor", "true", *MODAL[6:]]
        rows, found = ["1,4", "2,6"], []
        for ranks in (1, 2, 3):
            folder = tempfile.mkdtemp(prefix="pounding-full-order-")
            program.must_end(self, [*words, "-ensemble", table(rows, "motion_x_seed,motion_x_pga"), "-output", folder], ranks)
            found.append(settled(folder, 1)["left"])
        np.testing.assert_allclose(found, [found[0]] * 3, rtol=1e-8)
        single = pounding.load(program.must_run(self, [*words, "-time_step", time_step(folder), *overrides(rows[1], "motion_x_seed,motion_x_pga")], 1)[0])
        np.testing.assert_allclose(found[0], stability.base_motion(single, "left"), rtol=1e-9)
        self.assertGreater(found[0][0], 1e-4)
        self.assertGreaterEqual(found[0][1], found[0][0])

    def test_run_by_run_on_soil_beside_a_reduced_one(self):
        self.check(*SOIL, *MODAL[6:], *FRICTION, plan=["structure left: at full order, stepped run by run"], singles=(0, 1))


class Others(unittest.TestCase):
    def test_memory_before_the_run(self):
        run = program.must_end(self, [*SCENE, "-dry_run", "-ensemble", table(ROWS, COLUMNS)], 1)
        self.assertRegex(run.stdout, r"eight runs at full order: \d+ MB per rank")

    def test_factors_on_elements_that_members_share(self):
        program.must_refuse(self, [*SCENE, "-ensemble", table(["1.1"], "left_stiffness_factor")],
                            "column left_stiffness_factor: structure left is at full order")


if __name__ == "__main__":
    unittest.main()
