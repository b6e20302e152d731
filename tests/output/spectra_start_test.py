"""Gravity that is dropped on a structure which is held: one line of doubt, and spectra and peaks that leave
out what comes before -spectra_start.

One mass on a spring of 3 Hz with 20 % damping under its weight, shaken from 2.5 s on: at 2 s what the drop
did is 5e-4 of it. The oscillators of the spectra are at rest at the start, so that the spectra are those of
the recorded samples from there on."""
import os
import subprocess
import tempfile
import unittest

import h5py
import numpy

import program
from decks import clock, probes

START, END, FREQUENCIES = 2.0, 4.0, "0.5:50:40log"


def scene(record, *words):
    return ["-structures", "mass", "-mass_mesh", "tests/meshes/chain.geo", "-mass_first_element", "point_mass",
            "-mass_first_mass", 50, "-mass_support_element", "grounded_spring",
            "-mass_support_stiffness", "17765,17765,17765", "-mass_damping_alpha", 7.54, "-mass_gravity", "0,0,-9.81",
            "-motion_z_record", record, "-motion_z_unit", "m/s2", *clock(5e-4, END, 1e-3), "-modes", 1,
            "-spectra_frequencies", FREQUENCIES, "-spectra_damping", "0.02,0.05", *probes(it="mass@1,0,0"), *words]


class SpectraStart(unittest.TestCase):
    def setUp(self):
        handle, self.record = tempfile.mkstemp(suffix=".txt")
        with os.fdopen(handle, "w") as file:
            for i in range(401):
                file.write(f"{1.0 * numpy.sin(40 * (0.01 * i - 2.5)) if i >= 250 else 0.0:.12g}\n")

    def run_scene(self, *words, ranks=1):
        folder, summary = program.must_run(self, scene(self.record, "-motion_z_time_step", 0.01, *words), ranks)
        return folder, summary, program.read_csv(os.path.join(folder, "spectra.csv"))

    def vertical(self, table):
        return numpy.array([float(value) for value, direction, ratio in
                            zip(table["pseudo_acceleration"], table["direction"], table["damping"])
                            if direction == "z" and float(ratio) == 0.05]).reshape(2, -1)[0]  # then the ground's

    def test_the_drop_is_left_out(self):
        _, whole, table = self.run_scene()
        self.assertEqual(set(table["start"]), {"0"})
        dropped = self.vertical(table)
        folder, summary, table = self.run_scene("-spectra_start", START)
        self.assertEqual(set(table["start"]), {"2"})
        with h5py.File(os.path.join(folder, "history.h5")) as file:
            offset = file["acceleration"].attrs["time_offset"]
            counts = file["time"][()] + offset >= START - 1e-9
            peak = abs(file["acceleration"][()][counts, 2]).max()
            moved = abs(file["displacement"][()][counts, 2]).max()
        self.assertAlmostEqual(summary["probes"]["it"]["sampled_peak_acceleration"][2] / peak, 1, delta=1e-12)
        self.assertAlmostEqual(summary["probes"]["it"]["peak_displacement"][2] / moved, 1, delta=1e-12)
        self.assertGreater(whole["probes"]["it"]["sampled_peak_acceleration"][2], 9)
        self.assertLess(peak, 2)
        later = self.vertical(table)
        self.assertGreater(dropped.max() / later.max(), 3)
        # The same from the other program, and from the samples alone.
        result = subprocess.run([os.path.join(program.BUILD, "pounding-spectra"), "--start", str(START),
                                 "--channels", "it.z", "--frequencies", FREQUENCIES, "--digits", "17",
                                 os.path.join(folder, "history.h5")], capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 0, result.stderr)
        header, *rows = (line.split(",") for line in result.stdout.splitlines())
        self.assertEqual(header, list(table))
        self.assertEqual({row[header.index("start")] for row in rows}, {"2"})
        other = numpy.array([float(row[header.index("pseudo_acceleration")]) for row in rows])
        self.assertLess(abs(other / later - 1).max(), 1e-12)

    def test_a_continued_run_counts_its_peaks_from_the_start_that_it_is_given(self):
        """Peaks of forces are kept in the checkpoint as they come: nothing of those before stays."""
        forces = ["-forces", "base", "-base_structure", "mass", "-base_kind", "reactions"]
        words = scene(self.record, "-motion_z_time_step", 0.01, *forces)
        folder = tempfile.mkdtemp(prefix="pounding-")
        ended = program.must_end(self, [*words, "-end_time", 2, "-checkpoint_steps", 4000, "-output", folder])
        restart = ["-restart", os.path.join(folder, "checkpoint.h5")]
        continued, _ = program.must_run(self, [*words, *restart, "-spectra_start", 3])
        whole, _ = program.must_run(self, [*words, "-spectra_start", 3])
        for name in ("forces.csv", "spectra.csv"):
            with open(os.path.join(continued, name)) as one, open(os.path.join(whole, name)) as other:
                self.assertEqual(one.read(), other.read())
        program.must_refuse(self, [*words, *restart, "-spectra_start", 1],
                            "-spectra_start 1 s: the peaks of forces were counted from 0 s on until the checkpoint at 2 s")

    def test_gravity_on_what_is_held_is_doubted(self):
        _, summary, _ = self.run_scene()
        self.assertEqual(len([line for line in summary["warnings"] if "drop test" in line]), 1)
        _, summary, _ = self.run_scene("-mass_gravity", "0,0,0")
        self.assertEqual([line for line in summary["warnings"] if "gravity" in line], [])

    def test_start_must_leave_something(self):
        for start in (END, 3.9999, -1, "soon"):
            program.must_refuse(self, scene(self.record, "-motion_z_time_step", 0.01, "-spectra_start", start,
                                "-dry_run"), "-spectra_start")


if __name__ == "__main__":
    unittest.main()
