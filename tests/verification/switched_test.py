"""Buildings in modes while nothing strikes and at full order else: their motion, ledger, ranks, and runs continued in either."""
import os
import sys
import unittest

import h5py
import numpy

import program
from decks import SMALL

sys.path[:0] = [os.path.join(program.SOURCE, "tests", folder) for folder in ("restart", "composition")]
from cells import Cell  # noqa: E402
from features import FEATURES  # noqa: E402
from restart_test import RestartCase, checkpoint, history  # noqa: E402
from scene import STEP, Scene  # noqa: E402

TIME_STEP = 1e-5
# The two-storey pair on a very coarse mesh, damped so that 120 modes hold what stays between strikes.
PAIR = ["-options_file", "petsc-options/azalee/gap2.yaml", "-s1_mesh_set", SMALL, "-s2_mesh_set", SMALL, "-motion_x_pga", 20,
        "-motion_x_envelope", "0.02,20", "-floor2_gap", "4e-4,2e-4", "-floor1_gap", 0.02, "-modes", 1, "-time_step", TIME_STEP,
        "-spectra_frequencies", "1:200:5lin", "-end_time", 0.4, "-s1_damping_beta", 1e-4, "-s2_damping_beta", 1e-4]
# Shells, beams and cabinets on springs and dashpots of soil, under their weight, in uniform damping; nothing strikes.
PLANT = ["-options_file", "petsc-options/plant/small.yaml", "-floor1_gap", 0.5, "-floor2_gap", 0.5, "-gravity", 9.81, "-preload",
         "static", "-end_time", 0.3, "-modes", 0, "-spectra_frequencies", 10, "-fields_interval", 0.1, "-gap_interval", 0.01,
         *(word for axis in "xyz" for word in (f"-motion_{axis}_envelope", "0.2,15"))]


def switched(scene, part, *more, names=("s1", "s2"), modes=120):
    return scene + [word for name in names for word in (
        f"-{name}_model", "switched", f"-{name}_modal_vectors", modes, f"-{name}_switched_part", part)] + list(more)


# Two houses that meet twice, one of them on soil with hidden motions under a mat, in 40 modes between strikes.
FEATURE = {feature.name: feature.options for feature in FEATURES}
STRUCK = {"a_modal_vectors": 40, "a_switched_part": 1e-4, "a_damping_beta": 2e-4, "joint_gap": 2e-3, "end_time": 3000 * STEP}


def house(*names, **options):
    """A house in modes between strikes that has features of tests/composition, with its reactions and the force through a level."""
    scene = Scene()
    for name in ("modes between strikes", *names, "reactions", "storey force"):
        scene.lay(FEATURE[name])
    return Scene.of({**scene.options, "output_interval": 10 * STEP, **options})


def at_full_order(scene):
    return Scene.of({key: value for key, value in scene.options.items() if not key.startswith(("a_model", "a_modal", "a_switched"))})


def in_modes(folder):
    return program.summary(folder)["in_modes"]


class Switched(RestartCase):
    def assert_close(self, first, second, names, tolerance):
        for name in names:
            difference = abs(first[name] - second[name]).max()
            self.assertLess(difference, tolerance * abs(first[name]).max(), name)

    def test_motion_is_that_of_full_order_and_the_ledger_closes(self):
        full, run = self.complete(PAIR), self.complete(switched(PAIR, 1e-6))
        self.assertGreater(in_modes(run)["share"], 0.3)
        self.assertGreater(in_modes(run)["left"], 0)
        self.assert_close(history(full), history(run), ("displacement", "velocity"), 1e-3)
        one, other = (numpy.array(program.read_csv(os.path.join(folder, "spectra.csv"))["pseudo_acceleration"], dtype=float)
                      for folder in (full, run))
        self.assertLess(abs(numpy.log(other / one)).max(), 0.01)
        one, other = program.summary(full), program.summary(run)
        self.assertEqual(one["impacts"]["episodes"], other["impacts"]["episodes"])
        self.assertLess(other["energy"]["relative_residual"], 1e-10)
        lost = numpy.array(program.read_csv(os.path.join(run, "energy.csv"))["switch_loss"], dtype=float)
        self.assertNotEqual(lost[-1], 0)
        self.assertLess(abs(lost).max(), 1e-6 * one["energy"]["input"])

    def test_a_part_of_nothing_is_full_order_to_the_bit(self):
        self.assert_same_results(self.complete(PAIR), self.complete(switched(PAIR, 0)))

    def test_continued_in_modes_and_at_full_order_it_has_the_same_bits(self):
        whole = self.complete(switched(PAIR, 1e-6))
        found = set()
        for step in (18000, 25400):
            cut = self.cut(switched(PAIR, 1e-6), step, TIME_STEP)
            with h5py.File(checkpoint(cut)) as file:
                found.add(bool(file["tables/order"][0]))
            self.assert_same_results(whole, self.complete(switched(PAIR, 1e-6, "-restart", checkpoint(cut))))
        self.assertEqual(found, {False, True})

    def test_buildings_on_soil_under_their_weight(self):
        folders = [self.complete(PLANT), self.complete(switched(PLANT, 1e-5, names=("block", "frame"), modes=150))]
        self.assertGreater(in_modes(folders[1])["share"], 0.3)
        self.assertLess(program.summary(folders[1])["energy"]["relative_residual"], 1e-10)
        self.assert_close(*map(history, folders), ("displacement", "velocity"), 3e-3)
        files = [h5py.File(os.path.join(folder, "fields.h5")) for folder in folders]
        names = []
        files[0].visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" else None)
        shown = [name for name in names if "displacement" in name or "velocity" in name or "rotation" in name]
        self.assertGreaterEqual(len(shown), 4)
        self.assert_close(*({name: file[name][()] for name in shown} for file in files), shown, 3e-3)

    def held(self, scene):
        cell = Cell(scene)
        self.addCleanup(cell.close)
        return cell

    def test_all_modes_are_full_order_on_soil_with_rigid_parts_ties_and_links_that_remember(self):
        for names, tolerance in ((("soil under a mat", "eccentric join", "stiffness damping"), 1e-7),  # of a basis on soft soil
                                 (("soil from a table", "tie"), 1e-7),
                                 (("rigid slab", "Zener feet", "uniform damping", "rest under gravity"), 1e-9)):
            with self.subTest(names=names):
                cell = self.held(house(*names, a_modal_vectors=1000, a_switched_part=1e-2, joint_gap=.5, end_time=2000 * STEP))
                run = cell.records()
                self.assertGreater(run.summary["in_modes"]["share"], .5)
                self.assertLess(run.summary["energy"]["relative_residual"], 1e-12)
                self.assertIsNone(run.apart(cell.records(scene=at_full_order(cell.scene)), tolerance))

    def test_forces_and_memories_go_through_strikes_and_ranks(self):
        cell = self.held(house("soil from a table", **STRUCK))
        run = cell.reference
        self.assertGreater(run.summary["in_modes"]["share"], .3)
        self.assertGreater(run.summary["in_modes"]["left"], 0)
        self.assertLess(run.summary["energy"]["relative_residual"], 1e-12)
        self.assertGreater(abs(run.ledger["switch_loss"]).max(), 0)
        self.assertIsNone(run.apart(cell.records(scene=at_full_order(cell.scene)), 5e-3))
        for ranks in (2, 3):
            self.assertIsNone(run.apart(cell.records(ranks=ranks), 1e-8))
        found = set()
        for step in (900, 2000):
            _, output = cell.run("-checkpoint_steps", step, "-end_time", (step + 9) * STEP)
            with h5py.File(os.path.join(output, "checkpoint.h5")) as file:
                found.add(bool(file["tables/order"][0]))
            self.assertIsNone(run.apart(cell.records("-restart", os.path.join(output, "checkpoint.h5")), 0))
        self.assertEqual(found, {False, True})
        none = Scene.of({**cell.scene.options, "a_switched_part": 0})
        self.assertIsNone(cell.records(scene=none).apart(cell.records(scene=at_full_order(none)), 0))

    def test_soil_that_mats_share_and_dashpots_that_a_support_stretches_are_refused(self):
        for name, options in (("soil that mats share", {}), ("supports", {"a_stay_dashpot": 2e4})):
            with self.subTest(name=name):
                result, _ = self.held(house(name, **options)).run()
                self.assertEqual(result.returncode, 1)
                self.assertIn("soil that mats share, nor links that a support stretches", program.error_lines(result)[0])

    def test_where_contact_never_rests_it_stays_at_full_order(self):
        rattling = [*PAIR, "-floor2_gap", 0, "-floor1_gap", 0, "-end_time", 0.1]
        full, run = self.complete(rattling), self.complete(switched(rattling, 1e-6))
        impacts = program.read_csv(os.path.join(full, "impacts.csv"))
        lasted = sum(float(end) - float(start) for start, end in zip(impacts["start"], impacts["end"]))
        self.assertGreater(lasted, 0.05)
        self.assertLess(in_modes(run)["share"], 0.05)

    def test_what_no_mode_has_is_refused_in_one_line(self):
        for words, expected in (
                (["-floor2_crushing", 1e4, "-floor2_crushing_stiffness", 1e9, "-floor2_crushing_depth", .01, "-floor2_crushing_area", .5],
                 "contact floor2, which has forces beside hard contact"),
                (["-s1_mass_scaling", 1e-4], "-s1_mass_scaling"), (["-s1_modal_damping", .02], "-s1_modal_damping"),
                (["-s1_modal_patches", 4], "-s1_modal_patches"), (["-s1_brace1_yield_force", 1e3], "-s1_brace1_yield_force"),
                (["-fidelity_window", .1], "-fidelity_window"), (["-s1_switched_part", .5], "-s1_switched_part")):
            with self.subTest(words=words):
                line = program.must_refuse(self, [*switched(PAIR, 1e-6), *words], expected)
                self.assertIn("-s1_", line)

    def test_options_in_force_are_read_again(self):
        for words in (switched(PAIR, 1e-6), [*PAIR, "-s1_model", "modal", "-s1_modal_vectors", 4]):
            folder, _ = program.must_run(self, [*words, "-end_time", 1e-4])
            program.must_run(self, ["-options_file", os.path.join(folder, "resolved.yaml")])

    def test_a_basis_that_is_not_given_settles_in_a_period_or_is_as_large_as_any(self):
        words = [*PLANT, "-end_time", 1e-4, "-modes", 1, "-block_model", "switched", "-frame_model", "switched", "-block_switched_part", 1e-12]
        structures = program.must_run(self, words)[1]["structures"]
        block, frame = structures["block"], structures["frame"]
        self.assertEqual(block["modal"]["modes"], 300)
        period = 1 / frame["frequencies"][0]["frequency"]
        self.assertLess(abs(frame["modal"]["settling_time"] / period - 1), 0.05)
        self.assertGreater(block["modal"]["settling_time"], 1 / block["frequencies"][0]["frequency"])

    def test_the_part_goes_with_the_model(self):
        program.must_refuse(self, [*PAIR, "-s1_switched_part", 1e-6], "-s1_switched_part", "goes with -s1_model switched")


ON_RANKS = {"buildings in modes between strikes": (switched(PAIR, 1e-6), {"tolerance": 1e-6})}


if __name__ == "__main__":
    unittest.main()
