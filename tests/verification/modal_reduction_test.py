"""Structures reduced to modes and attachment vectors against the finite elements themselves.

Two small two-storey buildings that pound. With all modes a reduction is the same system in other
coordinates: the same histories but for round-off, in contact too, also where one building is reduced
and the other is not. With a few modes and the attachment vectors the floor spectra stay; without
the vectors impacts go wrong. A basis is computed by one rank alone, unless it asks for more: any
number of ranks gives the same bits.
"""
import math
import os
import tempfile
import unittest

import h5py
import numpy

import program
from decks import box_of, contacts, in_modes, material, probes
from recorded import IDENTITY, Recorded, write_samples

CHEAP = ["-modes", 6, "-spectra_frequencies", "1:400:60log"]
SMALL = "cells_x=3,cells_y=3,column_elements=1"
PAIR = ["-options_file", "petsc-options/azalee/gap2.yaml", "-s1_mesh_set", SMALL, "-s2_mesh_set", SMALL,
        "-motion_x_pga", 6, "-motion_x_envelope", "0.2,20", "-floor2_gap", "0.0004,0.0002",
        "-floor1_gap", 0.002, "-end_time", 0.4] + CHEAP
DOFS = 360
QUANTITIES = ("displacement", "velocity", "acceleration", "gap", "contact_force")


def reduced(structure, modes, *more):
    words = [*in_modes(structure, modes)]
    return words + [f"-{structure}_{more[i]}" if i % 2 == 0 else more[i] for i in range(len(more))]


def history(folder):
    with h5py.File(os.path.join(folder, "history.h5"), "r") as file:
        return {name: file[name][()] for name in QUANTITIES}


def spectra(folder):
    """Floor spectra along x of both upper floors."""
    table = program.read_csv(os.path.join(folder, "spectra.csv"))
    rows = list(zip(table["probe"], table["direction"], map(float, table["damping"]), map(float, table["pseudo_acceleration"])))
    return {probe: numpy.array([value for *row, value in rows if row == [probe, "x", 0.05]])
            for probe in ("s1_floor2", "s2_floor2")}


class Reduction(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder, cls.full_summary = program.must_run(unittest.TestCase(), PAIR)
        cls.full, cls.full_spectra = history(folder), spectra(folder)
        cls.time_step = ["-time_step", repr(cls.full_summary["time_step"])]

    def assert_same(self, found, reference, tolerance):
        for name in QUANTITIES:
            scale = abs(reference[name]).max()
            self.assertGreater(scale, 0, name)
            self.assertLessEqual(abs(found[name] - reference[name]).max(), tolerance * scale, name)

    def run_with(self, arguments):
        folder, summary = program.must_run(self, PAIR + arguments)
        self.assertGreater(summary["impacts"]["floor2"]["episodes"], 1)
        self.assertLessEqual(summary["energy"]["relative_residual"], IDENTITY)
        return history(folder), summary

    def test_all_modes_are_the_model_itself(self):
        found, summary = self.run_with(reduced("s1", 10 * DOFS) + reduced("s2", DOFS) + self.time_step)
        modal = summary["structures"]["s1"]["modal"]
        self.assertEqual((modal["coordinates"], modal["modes"], modal["attachment_vectors"]), (DOFS, DOFS, 0))
        for name in ("s1", "s2"):
            one, other = summary["structures"][name], self.full_summary["structures"][name]
            self.assertAlmostEqual(one["stable_time_step"] / other["stable_time_step"], 1, delta=1e-8)
            for a, b in zip(one["frequencies"], other["frequencies"]):
                self.assertAlmostEqual(a["frequency"] / b["frequency"], 1, delta=1e-8)
        self.assert_same(found, self.full, 1e-8)

    def test_one_building_reduced_the_other_not(self):
        found, summary = self.run_with(reduced("s2", DOFS) + self.time_step)
        self.assertNotIn("modal", summary["structures"]["s1"])
        self.assert_same(found, self.full, 1e-8)

    def spectrum_error(self, arguments):
        """Root mean square of the relative difference of the floor-2 spectra, 1 to 400 Hz."""
        folder, _ = program.must_run(self, PAIR + arguments)
        found = spectra(folder)
        differences = [numpy.log(found[probe] / full) for probe, full in self.full_spectra.items()]
        return math.sqrt(numpy.mean(numpy.square(differences)))

    def test_few_modes_with_attachment_vectors_give_the_floor_spectra(self):
        few = reduced("s1", 30) + reduced("s2", 30) + self.time_step
        with_vectors = self.spectrum_error(few)
        bare = ["-s1_modal_attachment", "false", "-s2_modal_attachment", "false"]
        without = self.spectrum_error(few + bare)
        self.assertLess(with_vectors, 0.15)
        self.assertGreater(without, 2 * with_vectors)
        patches = self.spectrum_error(few + ["-s1_modal_patches", 4, "-s2_modal_patches", 4])
        self.assertLess(patches, 1.3 * with_vectors)

    def test_patches_of_contact_points(self):
        few = reduced("s1", 30, "modal_patches", 3) + reduced("s2", 30)
        _, summary = program.must_run(self, PAIR + few + ["-end_time", 1e-3])
        self.assertEqual(summary["structures"]["s1"]["modal"]["attachment_vectors"], 3)
        program.must_refuse(self, PAIR + few + ["-s1_modal_attachment", "false"], "-s1_modal_patches", "-s1_modal_attachment")
        program.must_refuse(self, PAIR + ["-s1_modal_patches", 3], "-s1_modal_patches", "-s1_model modal")

    def test_mass_of_fast_coordinates_allows_a_longer_step(self):
        finer = "cells_x=10,cells_y=10,column_elements=1"
        words = ["-s1_mesh_set", finer, "-s2_mesh_set", finer, "-output_interval", 1.2e-4]
        words += reduced("s1", 30) + reduced("s2", 30)
        step = 1.2e-4
        plain, scaled = (Recorded(self, PAIR + words + more)
                         for more in ([], ["-s1_mass_scaling", step, "-s2_mass_scaling", step]))
        limits = [[run.summary["structures"][name]["stable_time_step"] for name in ("s1", "s2")]
                  for run in (plain, scaled)]
        self.assertGreater(step, 1.9 * limits[0][1])
        for before, after in zip(*limits):
            self.assertAlmostEqual(after / max(before, step), 1, delta=1e-12)
        self.assertAlmostEqual(scaled.summary["time_step"] / (0.9 * step), 1, delta=1e-5)
        for probe in ("s1_floor2", "s2_floor2"):
            error = numpy.log(scaled.spectrum(probe, "x")[1] / plain.spectrum(probe, "x")[1])
            self.assertLess(math.sqrt(numpy.mean(numpy.square(error))), 0.03, probe)

    def test_cut_off_counts_the_modes_below_it(self):
        words = ["-s1_model", "modal", "-s1_modal_cutoff", 40, "-dry_run"]
        result = program.must_end(self, PAIR + words)
        frequencies = self.full_summary["structures"]["s1"]["frequencies"]
        self.assertLess(frequencies[-1]["frequency"], 40)
        line = [line for line in result.stdout.splitlines() if "below the cut-off of 40 Hz" in line]
        self.assertEqual(len(line), 1, result.stdout)
        self.assertGreaterEqual(int(line[0].split()[0]), len(frequencies))

    def test_more_modes_than_dofs_are_all_of_them_with_a_word(self):
        result = program.must_end(self, PAIR + reduced("s1", 5000) + ["-dry_run"])
        self.assertIn(f"{DOFS} modes (5000 asked for, the structure has no more)", result.stdout)

    def test_a_step_too_long_names_the_coordinate(self):
        words = reduced("s1", 20) + reduced("s2", 20) + ["-time_step", 1e-3, "-allow_unstable"]
        with tempfile.TemporaryDirectory() as folder:
            line = program.must_refuse(self, PAIR + words + ["-output", folder], "diverged")
        self.assertRegex(line, r"generalised coordinate \d+ \(.* Hz\)")


class SeveralRanks(unittest.TestCase):
    """A basis that several ranks compute together is that of one, and repeats itself by its file."""

    def setUp(self):
        self.place = tempfile.mkdtemp(prefix="pounding-")

    def words(self, modes, ranks):
        return [*reduced("s1", modes, "modal_basis", f"{self.place}/s1-{ranks}.h5", "modal_ranks", ranks),
                *reduced("s2", modes, "modal_basis", f"{self.place}/s2-{ranks}.h5", "modal_ranks", ranks)]

    def run_with(self, scene, ranks):
        folder, summary = program.must_run(self, scene, ranks)
        return history(folder), summary

    def compare(self, scene, more_words, ranks, tolerance):
        alone, _ = self.run_with(scene + more_words(1), ranks)
        shared, summary = self.run_with(scene + more_words(2), ranks)
        for name in QUANTITIES:
            self.assertLessEqual(abs(shared[name] - alone[name]).max(), tolerance * abs(alone[name]).max(), name)
        again, _ = self.run_with(scene + more_words(2), ranks)
        for name in QUANTITIES:
            self.assertTrue(numpy.array_equal(again[name], shared[name]), name)
        return summary

    def test_on_two_and_three_ranks(self):
        for ranks in (2, 3):
            summary = self.compare(PAIR, lambda together: self.words(30, together), ranks, 1e-7)
            self.assertGreater(summary["impacts"]["floor2"]["episodes"], 1)
            for name in os.listdir(self.place):
                os.remove(f"{self.place}/{name}")

    def test_with_a_rigid_floor_and_at_rest_under_its_weight(self):
        scene = PAIR + ["-s1_levels", "slab", "-gravity", 9.81, "-preload", "static"]
        self.compare(scene, lambda together: self.words(25, together), 3, 1e-6)

    def test_more_ranks_than_there_are(self):
        scene = PAIR + ["-end_time", 0.01]
        one, _ = self.run_with(scene + self.words(20, 1), 1)
        many, _ = self.run_with(scene + self.words(20, 50), 2)
        for name in ("displacement", "velocity", "gap"):
            self.assertLessEqual(abs(many[name] - one[name]).max(), 1e-7 * abs(one[name]).max(), name)

    def test_it_needs_a_file(self):
        program.must_refuse(self, PAIR + reduced("s1", 20, "modal_ranks", 2), "-s1_modal_ranks 2", "-s1_modal_basis")
        program.must_refuse(self, PAIR + reduced("s1", 20, "modal_ranks", 0), "-s1_modal_ranks 0", ">= 1")
        program.must_refuse(self, PAIR + ["-s1_modal_ranks", 2], "-s1_modal_ranks", "-s1_model modal")


TWO_BRICKS = ["-structures", "left,right", *contacts(gap=("left:x_max", "right:x_min", 0.01)), "-left_initial_velocity",
              "1,0,0", "-left_damping_beta", 1e-4, "-right_damping_alpha", 0.5, "-right_damping_beta", 1e-4, "-end_time", 0.15,
              *probes(hit="right:x_min"), *box_of("left", "x0=-2,lx=2,nx=6,ny=2,nz=2", "soft"),
              *box_of("right", "x0=0,lx=2,nx=6,ny=2,nz=2", "soft"), *material("soft", 1e7, 0.3, 1000)]


class Bricks(unittest.TestCase):
    """A brick of finite elements flies against one of modes; neither is held."""

    def test_mixed_scene_closes_the_energy_identity(self):
        full, few = (Recorded(self, TWO_BRICKS + more).summary["impacts"]["gap"] for more in ([], reduced("right", 12)))
        self.assertGreater(few["episodes"], 0)
        self.assertAlmostEqual(few["total_impulse"] / full["total_impulse"], 1, delta=0.02)


class AboveTheStableStep(unittest.TestCase):
    """There no energy bounds the gaps, so the interface is looked at in every step."""

    def test_the_interface_is_looked_at_in_every_step(self):
        words = PAIR + reduced("s1", 20) + reduced("s2", 20) + ["-floor1_gap", 0.02, "-floor2_gap", 0.02,
                                                                "-gap_interval", 0.02, "-end_time", 0.02]
        stable = program.must_run(self, words)[1]
        self.assertLess(stable["interface_looks"], 0.2 * stable["steps"])
        beyond = ["-allow_unstable", "-time_step", 1.1 * stable["stable_time_step"]]
        _, unstable = program.must_run(self, words + beyond)
        self.assertGreaterEqual(unstable["interface_looks"], unstable["steps"])


class Damping(unittest.TestCase):
    """A ratio per mode that says what mass-proportional damping says of it: xi = alpha / (2 omega)."""

    def test_ratios_of_the_modes(self):
        alpha = 5.0
        brick = ["-structures", "tower", *box_of("tower", "lz=4,nz=2", "soft"), "-tower_clamp", "z_min",
                 *material("soft", 2e5, 0.2, 100), "-tower_initial_velocity", "1,0.3,0.1", *probes(top="tower:z_max"),
                 "-end_time", 3, "-time_step", 2e-3]
        brick += ["-output_interval", 2e-3, "-spectra_frequencies", 10, "-modes", 24]
        folder, summary = program.must_run(self, brick + ["-tower_damping_alpha", alpha])
        frequencies = [mode["frequency"] for mode in summary["structures"]["tower"]["frequencies"]]
        self.assertEqual(len(frequencies), 24)
        ratios = ",".join(repr(alpha / (4 * math.pi * f)) for f in frequencies)
        modal, _ = program.must_run(self, brick + reduced("tower", 24) + ["-tower_modal_damping", ratios])
        with h5py.File(os.path.join(folder, "history.h5")) as file:
            full = file["displacement"][()]
        with h5py.File(os.path.join(modal, "history.h5")) as file:
            self.assertLessEqual(abs(file["displacement"][()] - full).max(), 1e-8 * abs(full).max())


class Slow(unittest.TestCase):
    """A tower shaken so slowly that it moves as a rigid body: its base carries its mass times the ground's acceleration."""
    ACCELERATION = 2.0
    MASS = 2500 * 6 * (1 - 1 / 8)  # without the nodes that are held: half of the lowest of four layers

    def words(self, *more):
        sine = write_samples([self.ACCELERATION * math.sin(math.pi * i / 1000)**2 for i in range(1001)], 1e-3)
        return ["-structures", "tower", *box_of("tower", "lx=1,ly=1,lz=6,nx=1,ny=1,nz=4", "concrete"), "-tower_clamp", "z_min",
                *material("concrete", 3e10, 0.2, 2500), "-motion_x_record", sine, "-motion_z_record", sine, "-modes", 1,
                "-motion_x_unit", "m/s2", "-motion_z_unit", "m/s2", *probes(top="tower:z_max"), "-end_time", 1,
                "-forces", "base", "-base_structure", "tower", "-base_kind", "reactions", *reduced("tower", 2), *more]

    def test_mass_that_the_modes_leave_out_is_carried(self):
        """Regulatory Guide 1.92; the modes alone have two thirds of the mass along x and nothing along z."""
        supported = ["-supports", "s", "-s_groups", "tower:z_min"]
        for more in ([], supported):
            run = Recorded(self, self.words(*more))
            for way in "xz":
                self.assertAlmostEqual(abs(run.summary["forces"]["base"][f"F{way}"]["peak"]) / (self.MASS * self.ACCELERATION), 1,
                                       delta=0.02, msg=way)
            modal = run.summary["structures"]["tower"]["modal"]
            self.assertEqual(len(modal["residual_vectors"]), 3)
            self.assertLess(modal["residual_vectors"][-1], modal["largest_frequency"] * (1 + 1e-12))
            without = Recorded(self, self.words(*more, "-tower_modal_residual", "false")).summary
            shares = without["structures"]["tower"]["modal"]["mass_in_modes"]
            self.assertEqual(without["structures"]["tower"]["modal"]["residual_vectors"], [])
            self.assertLess(shares[2], 1e-9)
            for way, share in zip("xz", shares[::2]):
                self.assertAlmostEqual(abs(without["forces"]["base"][f"F{way}"]["peak"]) / (self.MASS * self.ACCELERATION), share,
                                       delta=0.02, msg=way)

    def test_spectra_beyond_the_modes_are_doubted(self):
        wide = ["-spectra_frequencies", "1:400:20log"]
        doubted = lambda *more: [line for line in Recorded(self, self.words(*wide, *more)).summary["warnings"] if "modes end" in line]
        self.assertEqual(len(doubted()), 1)
        self.assertEqual(doubted("-spectra_frequencies", "0.1:1:10log"), [])
        self.assertEqual(doubted("-tower_modal_vectors", 300), [])  # all of them

    def test_spectra_beyond_the_waves_of_the_mesh_are_doubted(self):
        doubted = lambda *more: [line for line in Recorded(self, self.words(*more)).summary["warnings"] if "mesh carries" in line]
        line, = doubted("-spectra_frequencies", "1:4000:20log")
        carried = float(line.split(" up to ")[1].split()[0])
        self.assertIn("go to 4000 Hz", line)
        self.assertEqual(doubted("-spectra_frequencies", f"1,{0.9 * carried}"), [])
        self.assertEqual(doubted("-spectra_frequencies", "1:4000:20log", "-probes", "none", "-forces", "none"), [])


# Coordinates that one rank computes have the same bits on any number of them.
SHORT = PAIR + ["-s1_initial_velocity", "0.3,0,0", "-end_time", 0.05]
ON_RANKS = {"both buildings in all modes": (SHORT + reduced("s1", DOFS) + reduced("s2", DOFS), {"tolerance": 0}),
            "both buildings in a few modes": (SHORT + reduced("s1", 30) + reduced("s2", 30), {"tolerance": 0}),
            # Accelerations are differences of velocities over a step.
            "one building in a few modes": (SHORT + reduced("s1", 30), {"tolerance": 1e-11}),
            "a brick that strikes one of modes": TWO_BRICKS + reduced("right", 12)}


if __name__ == "__main__":
    unittest.main()
