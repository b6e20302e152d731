"""The error of reduced structures that the program tells, beside the true one, and -fidelity_target, which takes as few
modes as an accepted error allows."""
import math
import os
import tempfile
import unittest

import numpy as np

import program
import two_buildings
from two_buildings import pounding

PIERS = ["-options_file", "petsc-options/plant/piers.yaml", "-modes", 1, "-end_time", 1.6,
         "-spectra_frequencies", "1:400:131log"]


def reduced(names, modes, window):
    words = [word for name in names for word in (f"-{name}_model", "modal", f"-{name}_modal_vectors", modes)]
    return [*words, "-fidelity_window", window]


def true_error(found, full):
    """rms of the logarithm of the spectra's ratio over ln f, 1-400 Hz, of all channels that move."""
    squares = []
    for probe in full.spectrum_probes:
        if probe == "ground":
            continue
        spectra = {axis: full.spectrum(probe, axis) for axis in "xyz"}
        largest = max(values.max() for _, values in spectra.values())
        for axis, (frequency, values) in spectra.items():
            if values.max() <= 1e-3 * largest or values.min() <= 1e-9 * largest:
                continue
            inside = (frequency >= 1 - 1e-9) & (frequency <= 400.001)
            ratio = np.log(found.spectrum(probe, axis)[1] / values)[inside]
            logs = np.log(frequency[inside])
            squares.append(np.trapz(ratio**2, logs) / (logs[-1] - logs[0]))
    return math.sqrt(sum(squares) / len(squares))


class Estimate(unittest.TestCase):
    """The two piers and the two small buildings, each reduced and at full order."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-")
        cls.full = program.must_run(cls(), PIERS)[0]

    def estimate(self, words, ranks=1):
        folder, summary = program.must_run(self, words, ranks)
        return folder, summary["fidelity"]

    def test_it_is_within_a_factor_of_two(self):
        for modes in (6, 20):
            folder, told = self.estimate(PIERS + reduced(("tall", "low"), modes, 0.5))
            ratio = told["rms"]["1-400"] / true_error(pounding.load(folder), pounding.load(self.full))
            self.assertGreater(ratio, 0.5, (modes, told))
            self.assertLess(ratio, 2, (modes, told))
            self.assertGreater(told["impulse"], 0)
            self.assertAlmostEqual(told["window"][1] - told["window"][0], 0.5, delta=0.001)

    def test_frames_with_uniform_damping(self):
        scene = two_buildings.own_scene(self.folder, "modes: 0\n")
        words = ["-options_file", scene]
        full = program.must_run(self, words)[0]
        folder, told = self.estimate(words + reduced(("left", "right"), 60, 0.4))
        ratio = told["rms"]["1-400"] / true_error(pounding.load(folder), pounding.load(full))
        self.assertGreater(ratio, 0.5, told)
        self.assertLess(ratio, 2, told)

    def test_a_basis_of_all_modes_is_exact(self):
        """But for the time step, which is another one at full order: the window sees next to nothing."""
        words = PIERS + ["-tall_mesh_set", "cells_x=1,cells_y=2,cells_z=9", "-low_mesh_set",
                         "x0=0.604,thickness=0.5,height=7,cells_x=1,cells_y=2,cells_z=7", "-time_step", 2e-5]
        _, told = self.estimate(words + reduced(("tall", "low"), 1000, 0.5))
        self.assertLess(told["window_rms"]["1-400"], 0.004)

    def test_scaled_mass_at_full_order(self):
        """A run of the coarse pair that hits; without it the same at its own step."""
        words = program.COARSE_PAIR + ["-modes", 0, "-floor1_gap", 0.002, "-floor2_gap", 0.002, "-motion_x_duration", 12,
                                       "-motion_x_envelope", "0.2,3", "-motion_x_pga", 4, "-end_time", 0.8,
                                       "-spectra_frequencies", "1:400:131log"]
        full = program.must_run(self, words)[0]
        folder, told = self.estimate([*words, "-s1_mass_scaling", 4e-5, "-s2_mass_scaling", 4e-5, "-fidelity_window", 0.2])
        ratio = told["rms"]["1-400"] / true_error(pounding.load(folder), pounding.load(full))
        self.assertGreater(ratio, 0.5, told)
        self.assertLess(ratio, 2, told)

    def test_a_short_window_has_the_impact_that_it_is_made_for(self):
        for length in (0.05, 0.1, 0.2):
            folder, told = self.estimate(PIERS + reduced(("tall", "low"), 6, length))
            impacts = program.read_csv(os.path.join(folder, "impacts.csv"))
            _, start = max(zip(map(float, impacts["impulse"]), map(float, impacts["start"])))
            self.assertLess(told["window"][0] + length / 5, start)
            self.assertLess(start, told["window"][1] - length / 5)
            self.assertGreater(told["impulse"], 0)

    def test_bands_that_were_not_looked_at(self):
        words = [*PIERS, *reduced(("tall", "low"), 6, 0.1), "-end_time", 0.6, "-spectra_frequencies"]
        result = program.must_end(self, [*words, "1:33:30log", "-output", os.path.join(self.folder, "low")])
        self.assertRegex(result.stdout, r"\n  all that move( +[\d.]+){3} +- +-\n")
        told = program.summary(os.path.join(self.folder, "low"))["fidelity"]["rms"]
        self.assertEqual([told["50-150"], told["150-400"]], [None, None])
        program.must_refuse(self, [*words, "500,600"], "fewer than two of -spectra_frequencies")

    def test_ranks_and_repetition(self):
        words = PIERS + reduced(("tall", "low"), 6, 0.2) + ["-end_time", 1]
        told = [self.estimate(words, ranks)[1] for ranks in (1, 2, 2)]
        for band, value in told[0]["rms"].items():
            self.assertAlmostEqual(told[1]["rms"][band] / value, 1, delta=1e-4, msg=band)
            self.assertEqual(told[1]["rms"][band], told[2]["rms"][band])
        self.assertEqual(list(told[0]["channels"]), list(told[1]["channels"]))

    def test_scenes_that_it_cannot_tell_are_refused(self):
        window = ["-fidelity_window", 0.2]
        program.must_refuse(self, PIERS + window, "-fidelity_window", "no structure is reduced")
        words = PIERS + reduced(("tall", "low"), 6, 0.2)
        program.must_refuse(self, words + ["-tall_modal_damping", 0.03], "-fidelity_window", "ratios of modes of tall")
        program.must_refuse(self, words + ["-joint_sliding", 0.1], "-fidelity_window", "faces of contact joint slide")
        cracks = ["-options_file", "petsc-options/trade/cracking-walls.yaml", "-pier_model", "modal", "-pier_modal_vectors", 6]
        program.must_refuse(self, cracks + window, "-fidelity_window", "group walls of storey is not linear")


class Target(unittest.TestCase):
    """-fidelity_target on the two piers."""

    def test_takes_the_first_modes_that_suffice(self):
        result_folder, summary = program.must_run(self, PIERS + ["-fidelity_target", 0.05, "-fidelity_window", 0.3])
        climb = summary["fidelity_climb"]
        self.assertEqual(climb["target"], 0.05)
        self.assertEqual(summary["options"]["tall_modal_vectors"], str(climb["modes"]))
        self.assertLessEqual(summary["fidelity"]["rms"]["1-400"], 0.05)
        self.assertTrue(all(one["error"] > 0.05 for one in climb["tried"]))
        self.assertNotIn("fidelity_target", pounding.load(result_folder).summary["options"])

    def test_full_order_where_it_is_as_cheap_and_says_why(self):
        words = PIERS + ["-fidelity_target", 1e-5, "-fidelity_window", 0.2]
        result = program.must_end(self, words)
        self.assertIn("full order is taken, which", result.stdout)
        self.assertIn("25 modes are", result.stdout)

    def test_scaled_mass_is_tried_where_stiff_beams_hold_the_step(self):
        """Columns of 20 beams: so many steps that four runs with scaled mass cost less than one without."""
        words = ["-options_file", "petsc-options/azalee/gap2.yaml", "-modes", 0, "-end_time", 0.01, "-fidelity_window", 0.005,
                 "-spectra_frequencies", "1:400:31log", "-s1_mesh_set", "cells_x=7,cells_y=5,column_elements=20",
                 "-s2_mesh_set", "cells_x=5,cells_y=5,column_elements=20"]
        folder, summary = program.must_run(self, [*words, "-fidelity_target", 1e-6])
        scaled, = (one for one in summary["fidelity_climb"]["tried"] if one["scaled_mass"])
        self.assertEqual(scaled["modes"], 0)
        self.assertGreater(scaled["error"], 1e-6)
        self.assertGreater(scaled["wall_time"], 0)
        self.assertNotIn("mass_scaling", summary["structures"]["s1"])  # full order in the end
        _, summary = program.must_run(self, [*words, "-fidelity_target", 2 * scaled["error"]])
        self.assertTrue(summary["fidelity_climb"]["scaled_mass"])
        self.assertLessEqual(summary["fidelity"]["rms"]["1-400"], 2 * scaled["error"])
        self.assertGreater(summary["structures"]["s2"]["mass_scaling"]["elements"], 0)

    def test_what_the_user_gave_wins(self):
        _, summary = program.must_run(self, PIERS + ["-fidelity_target", 0.5, "-fidelity_window", 0.2, "-tall_model", "full"])
        self.assertEqual(summary["options"]["tall_model"], "full")
        self.assertEqual(summary["options"]["low_model"], "modal")

    def test_mistakes_are_one_line(self):
        for target in (0, -1, 1.5):
            program.must_refuse(self, PIERS + ["-fidelity_target", target], "-fidelity_target")
        words = PIERS + ["-fidelity_target", 0.05]
        program.must_refuse(self, words + ["-low_model", "modal", "-low_modal_vectors", 9], "-fidelity_target",
                            "reduced already")
        program.must_refuse(self, words + ["-low_model", "full", "-tall_model", "full"], "-fidelity_target", "leave")
        program.must_refuse(self, words + ["-probes", "none"], "-fidelity_target", "probe")
        program.must_refuse(self, words + ["-ensemble", "many.csv"], "-fidelity_target", "-ensemble")
        damped = ["-low_pier_damping_alpha", 0.1, "-low_pier_damping_beta", 1e-5]
        program.must_refuse(self, words + damped, "-fidelity_target", "cannot be reduced")


if __name__ == "__main__":
    unittest.main()
