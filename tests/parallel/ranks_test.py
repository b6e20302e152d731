"""The answer does not depend on the number of ranks, and a run repeats itself bit for bit; with scaled mass as well,
where its energy balance is exact."""
import os
import unittest

import h5py
import numpy

import program

# Strong enough to touch early: the first impact comes after 0.7 s.
CASE = program.COARSE_PAIR + ["-motion_x_pga", "6", "-motion_x_envelope", "0.2,20",
                              "-floor2_gap", "0.004,0.002", "-floor1_gap", "0.02", "-end_time", "0.82"]


def history(folder, name):
    with h5py.File(os.path.join(folder, "history.h5"), "r") as file:
        return file[name][()]


class OnRanks:
    """Tests of the runs of a CASE: `runs` by their number of ranks, one rank first."""

    @classmethod
    def setUpClass(cls):
        cls.runs = {ranks: program.must_run(unittest.TestCase(), cls.CASE, ranks) for ranks in (1, 2, 3)}

    def test_histories_agree_until_just_after_the_first_impact(self):
        first = float(program.read_csv(os.path.join(self.runs[1][0], "impacts.csv"))["start"][0])
        time = history(self.runs[1][0], "time")
        window = time <= first + 0.1
        for name in ("displacement", "velocity", "acceleration", "gap"):
            reference = history(self.runs[1][0], name)[window]
            scale = abs(reference).max()
            self.assertGreater(scale, 0)
            for ranks in list(self.runs)[1:]:
                difference = abs(history(self.runs[ranks][0], name)[window] - reference).max()
                self.assertLessEqual(difference, 1e-9 * scale, (name, ranks))

    def test_a_second_run_is_bit_identical(self):
        folder, _ = program.must_run(self, self.CASE, 2)
        for name in ("time", "displacement", "velocity", "acceleration", "gap", "contact_force"):
            self.assertTrue(numpy.array_equal(history(folder, name), history(self.runs[2][0], name)), name)
        for name in ("impacts.csv", "spectra.csv", "energy.csv"):
            with open(os.path.join(folder, name)) as a, open(os.path.join(self.runs[2][0], name)) as b:
                self.assertEqual(a.read(), b.read(), name)


class Ranks(OnRanks, unittest.TestCase):
    CASE = CASE

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.runs["whole"] = program.must_run(unittest.TestCase(), CASE + ["-partition", "structures"], 2)

    def test_the_case_pounds(self):
        for _, summary in self.runs.values():
            self.assertGreater(summary["impacts"]["floor2"]["episodes"], 0)
            self.assertLess(summary["energy"]["relative_residual"], 1e-10)
            self.assertLess(summary["impacts"]["max_penetration"], 1e-4)

    def test_elements_or_structures_are_shared_out(self):
        self.assertGreater(self.runs[2][1]["partition"]["edge_cut"], 0)
        self.assertLess(self.runs[2][1]["partition"]["imbalance"], 1.05)
        whole = self.runs["whole"][1]["partition"]
        self.assertEqual(whole["edge_cut"], 0)
        self.assertGreater(whole["imbalance"], 1.05)
        _, chosen = program.must_run(self, CASE + ["-partition", "auto", "-end_time", 1e-3], 2)
        self.assertEqual(chosen["partition"], whole)

    def test_model_is_the_same(self):
        one = self.runs[1][1]
        for ranks in (2, 3, "whole"):
            other = self.runs[ranks][1]
            self.assertEqual(one["time_step"], other["time_step"])
            for name, structure in one["structures"].items():
                self.assertEqual(structure["dofs"], other["structures"][name]["dofs"])
                self.assertAlmostEqual(structure["mass"], other["structures"][name]["mass"], delta=1e-8)
                self.assertAlmostEqual(structure["omega_max"] / other["structures"][name]["omega_max"],
                                       1, delta=1e-8)


class ScaledMass(OnRanks, unittest.TestCase):
    """The first impact is at nodes whose mass is coupled by the beams around the slabs."""

    CASE = CASE + ["-s1_mass_scaling", "4e-5", "-s2_mass_scaling", "4e-5", "-modes", "3"]

    def test_the_case_pounds_and_its_energy_balance_closes(self):
        for _, summary in self.runs.values():
            self.assertGreater(summary["impacts"]["floor2"]["episodes"], 0)
            # Measured: 2.0e-12, and 1.8e-12 without scaled mass, at 1.6 times the steps.
            self.assertLess(summary["energy"]["relative_residual"], 1e-11)
            self.assertLess(summary["impacts"]["complementarity_residual"], 1e-10)

    def test_the_wanted_step_is_reached(self):
        for _, summary in self.runs.values():
            for structure in summary["structures"].values():
                scaling = structure["mass_scaling"]
                self.assertEqual(scaling["time_step"], 4e-5)
                self.assertGreater(structure["stable_time_step"], 4e-5)
                self.assertGreater(scaling["elements"], 0)
                self.assertGreater(scaling["coupled_dofs"], 6 * 2)
                # c = dt (2 beta + dt) / 4 less what the element allows itself
                beta = structure["damping"]["beta"]
                self.assertLess(scaling["largest_factor"], 4e-5 * (2 * beta + 4e-5) / 4)

    def test_the_model_is_the_same(self):
        one = self.runs[1][1]
        for ranks in (2, 3):
            other = self.runs[ranks][1]
            self.assertEqual(one["time_step"], other["time_step"])
            for name, structure in one["structures"].items():
                self.assertEqual(structure["mass_scaling"]["elements"],
                                 other["structures"][name]["mass_scaling"]["elements"])
                self.assertAlmostEqual(structure["omega_max"] / other["structures"][name]["omega_max"],
                                       1, delta=1e-8)


if __name__ == "__main__":
    unittest.main()
