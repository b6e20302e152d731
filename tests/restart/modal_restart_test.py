"""Runs of reduced structures that are stopped and continued; bases that are kept in a file."""
import os
import tempfile
import unittest

import h5py
import numpy

import program
from decks import SMALL_MODAL_PAIR as PAIR
from restart_test import RestartCase, checkpoint

TIME_STEP = 5e-5  # of the pair
END = ["-end_time", 0.4]
STEP = 7030  # in the middle of the pounding


class Restart(RestartCase):
    def continued(self, arguments, ranks_before, ranks_after):
        cut = self.cut(PAIR + arguments, STEP, TIME_STEP, ranks_before)
        return self.complete(PAIR + arguments + END + ["-restart", checkpoint(cut)], ranks_after)

    def test_is_bit_identical(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                whole = self.complete(PAIR + END, ranks)
                self.assertGreater(program.summary(whole)["impacts"]["episodes"], 1)
                self.assert_same_results(whole, self.continued([], ranks, ranks))

    def test_from_the_end_of_a_shorter_run_and_with_another_interval_of_the_ledger(self):
        whole = self.complete(PAIR + END + ["-energy_interval", 10], 1)
        for interval in (1, 999):
            with self.subTest(interval=interval):
                self.assert_same_motion(whole, self.complete(PAIR + END + ["-energy_interval", interval], 1))
        first = self.complete(PAIR + ["-end_time", STEP * TIME_STEP, "-checkpoint_steps", STEP, "-energy_interval", 10], 1)
        self.assert_same_results(whole, self.complete(
            PAIR + END + ["-restart", checkpoint(first), "-energy_interval", 10], 1))

    def test_on_other_ranks_the_motion_has_the_same_bits_and_energies_are_summed_otherwise(self):
        whole, other = self.complete(PAIR + END, 2), self.continued([], 1, 3)
        self.assert_same_motion(whole, other)
        one, other = (program.read_csv(os.path.join(folder, "energy.csv")) for folder in (whole, other))
        for name, values in one.items():
            values, found = (numpy.array(part, dtype=float) for part in (values, other[name]))
            largest = max(abs(values).max(), 1e-6 * abs(numpy.array(one["kinetic"], dtype=float)).max())
            numpy.testing.assert_allclose(found, values, rtol=0, atol=1e-8 * largest, err_msg=name)

    def test_of_one_reduced_building(self):
        full = ["-s1_model", "full"]
        arguments = [word for word in PAIR if word not in ("-s1_model", "-s1_modal_vectors")]
        arguments = arguments[:arguments.index("modal")] + arguments[arguments.index("modal") + 2:]
        arguments += full + ["-time_step", 2e-5]
        whole = self.complete(arguments + END, 2)
        cut = self.cut(arguments, 17575, 2e-5, 2)
        self.assert_same_results(whole, self.complete(arguments + END + ["-restart", checkpoint(cut)], 2))

    def test_with_another_basis_is_refused(self):
        cut = self.cut(PAIR, STEP, TIME_STEP)
        with h5py.File(checkpoint(cut), "r+") as file:
            check = file["structures/s1/basis_check"][()]
            check[5] = -check[5]  # a vector that points the other way
            file["structures/s1/basis_check"][...] = check
        self.assertEqual(program.command("seal", checkpoint(cut)).returncode, 0)
        program.must_refuse(self, PAIR + END + ["-restart", checkpoint(cut), "-output", self.folder()], *("-restart",
                            "s1", "another modal basis", "-s1_modal_basis"), ranks=2)


class Basis(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pounding-")
        self.files = {name: os.path.join(self.folder, name + ".h5") for name in ("s1", "s2")}
        self.case = PAIR + ["-end_time", 0.05]
        for name, path in self.files.items():
            self.case += [f"-{name}_modal_basis", path]

    def run_case(self, *more, ranks=2):
        output = os.path.join(self.folder, "results")
        result = program.must_end(self, self.case + list(more) + ["-output", output], ranks)
        with h5py.File(os.path.join(output, "history.h5")) as file:
            return result.stdout, file["velocity"][()]

    def test_is_used_again_and_gives_the_same_bits(self):
        said, first = self.run_case()
        self.assertNotIn("modal basis", said)
        for ranks in (1, 2, 3):
            said, again = self.run_case(ranks=ranks)
            for name, path in self.files.items():
                self.assertIn(f"structure {name}: modal basis from {path}", said)
            self.assertTrue(numpy.array_equal(first, again))
        # What the basis does not depend on.
        said, _ = self.run_case("-s1_damping_beta", 1e-5, "-floor2_gap", 0.001, "-motion_x_pga", 3)
        self.assertEqual(said.count("modal basis from"), 2)

    def test_of_another_model_is_computed_anew(self):
        self.run_case()
        for changed, words in (("elements", ["-s1_brace1_area", 130e-6]),
                               ("mesh", ["-s1_mesh_set", "cells_x=3,cells_y=3,column_elements=2"]),
                               ("clamp", ["-s1_clamp", "none", "-s1_allow_loose"]),
                               ("number of vectors", ["-s1_modal_vectors", 21]),
                               ("contact points", ["-floor1_secondary", "s1:face2", "-floor1_primary",
                                                   "s2:face2"]),
                               ("probe points", ["-s1_floor1_at", "0,0,0"])):
            said, _ = self.run_case(*words)
            line = [line for line in said.splitlines() if "is of another model" in line]
            self.assertEqual(len([text for text in line if "structure s1" in text]), 1, said[:2000])
            self.assertIn(changed, line[0])
            said, _ = self.run_case(*words)
            self.assertIn("structure s1: modal basis from", said)

    def test_file_that_is_none_is_left_alone(self):
        for text in ("not HDF5", None):
            with open(self.files["s1"], "w") as file:
                file.write(text or "")
            if text is None:
                h5py.File(self.files["s1"], "w").close()
            with open(self.files["s1"], "rb") as file:
                before = file.read()
            program.must_refuse(self, self.case + ["-output", self.folder], "-s1_modal_basis " + self.files["s1"])
            with open(self.files["s1"], "rb") as file:
                self.assertEqual(file.read(), before)

    def test_changed_file_is_refused(self):
        self.run_case()

        def refuse(word):
            program.must_refuse(self, self.case + ["-output", self.folder], "-s1_modal_basis " + self.files["s1"],
                                word)

        with h5py.File(self.files["s1"], "r+") as file:
            file["squared_frequency"][1] = float("nan")
        refuse("run/seal")
        self.assertEqual(program.command("seal", self.files["s1"]).returncode, 0)
        refuse("not finite")

    def test_damping_goes_by_the_number_of_the_mode(self):
        """Ratios beyond the modes kept are those of the modes chosen among the candidates."""
        ratios = ",".join(["0.02"] * 20 + ["0.3"] * 40 + ["0.02"])
        reduced = ["-s1_modal_candidates", 60, "-s1_modal_damping"]
        _, one = self.run_case(*reduced, 0.02)
        _, other = self.run_case(*reduced, ratios)
        self.assertFalse(numpy.array_equal(one, other))

    def test_file_that_cannot_be_written(self):
        self.files["s1"] = os.path.join(self.folder, "nowhere", "s1.h5")
        program.must_refuse(self, self.case + ["-s1_modal_basis", self.files["s1"]],
                            "-s1_modal_basis " + self.files["s1"], ranks=2)


if __name__ == "__main__":
    unittest.main()
