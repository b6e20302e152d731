"""What is understood of a record is said before it is used, and what may not be meant is refused or doubted."""
import os
import tempfile
import unittest

import h5py

import program

G = 9.80665


def scene(*words):
    """One mass on a grounded spring of 3 Hz."""
    return ["-structures", "mass", "-mass_mesh", "tests/meshes/chain.geo", "-mass_first_element", "point_mass",
            "-mass_first_mass", 50, "-mass_support_element", "grounded_spring",
            "-mass_support_stiffness", "17765,17765,17765", "-end_time", 0.2, "-output_interval", 1e-3,
            "-time_step", 1e-3, "-modes", 0, "-spectra_frequencies", 10, "-probes", "it",
            "-it_structure", "mass", "-it_at", "1,0,0", *words]


class Motion(unittest.TestCase):
    def record(self, text):
        handle, path = tempfile.mkstemp(suffix=".txt")
        with os.fdopen(handle, "w") as file:
            file.write(text)
        return path

    def refuse(self, text, *words, options=()):
        path = self.record(text)
        program.must_refuse(self, scene("-motion_x_record", path, *options, "-dry_run"), *words,
                            timeout=120)

    def test_several_columns_need_one_to_be_asked_for(self):
        table = "time,acc,vel,disp\n0,1,0,0\n0.02,2,0,0\n0.04,1,0,0\n"
        self.refuse(table, "4 columns (time, acc, vel, disp)", "give column",
                    options=["-motion_x_unit", "m/s2"])
        path = self.record(table)
        _, summary = program.must_run(self, scene("-motion_x_record", path, "-motion_x_unit", "m/s2",
                                                  "-motion_x_column", 2))
        self.assertEqual(summary["motion"]["x"]["format"], "column 2 of 4 (acc), time in column 1")

    def test_index_in_front_of_the_time(self):
        table = "".join(f"{i} {0.02 * i:.2f} {i % 3}\n" for i in range(10))
        self.refuse(table, "3 columns", "time in column 2", options=["-motion_x_unit", "m/s2"])
        path = self.record(table)
        _, summary = program.must_run(self, scene("-motion_x_record", path, "-motion_x_unit", "m/s2",
                                                  "-motion_x_column", 3))
        motion = summary["motion"]["x"]
        self.assertEqual((motion["time_step"], motion["points"], motion["pga"]), (0.02, 10, 2))

    def test_steps_longer_than_those_of_any_record(self):
        table = "".join(f"{20 * i} {i % 3}\n" for i in range(10))  # milliseconds
        unit = ["-motion_x_unit", "m/s2"]
        self.refuse(table, "20 s", "time_step: 20", options=unit)
        self.refuse("NPTS= 3, DT= 0.2 (g)\n.1\n.2\n.1\n", "0.2 s", "header")
        path = self.record(table)
        _, summary = program.must_run(self, scene("-motion_x_record", path, *unit, "-motion_x_time_step", 20))
        self.assertEqual(summary["motion"]["x"]["duration"], 180)

    def test_counts_that_are_not_those_of_the_file(self):
        for header, word in (("NPTS= 4, DT= .02", "announces 4 values but 3"),
                             ("NPTS= 2, DT= .02", "announces 2 values but 3"), ("NPTS= -3, DT= .02", "-3"),
                             ("NPTS= 3, DT= 0.0", "not positive"), ("NPTS= 3, DT= -.02", "not positive")):
            with self.subTest(header):
                self.refuse(f"IN UNITS OF (G)\n{header}\n.1\n.2\n.1\n", word)

    def test_no_ground_moves_like_that(self):
        for unit, value in (("m/s2", 1e12), ("cm/s2", 1e12), ("g", 25)):
            self.refuse(f"0 0\n0.02 {value}\n0.04 1\n", "g", options=["-motion_x_unit", unit])
        quiet = "0 0\n0.02 1\n0.04 1\n"
        self.refuse(quiet, "scaled peak", options=["-motion_x_unit", "m/s2", "-motion_x_scale", 1e9])
        self.refuse(quiet, "scaled peak", options=["-motion_x_unit", "m/s2", "-motion_x_pga", 1e12])

    def test_a_ground_that_jumps(self):
        """A step of .1 m within two samples of 1 ms; with the wrong sign it flies off at 200 m/s."""
        for sign in (-1, 1):
            values = [0, 1e5, sign * 1e5, *[0] * 20]
            text = "".join(f"{i / 1000:g} {value:g}\n" for i, value in enumerate(values))
            if sign > 0:
                self.refuse(text, "10000 g", options=["-motion_x_unit", "m/s2"])
                continue
            _, summary = program.must_run(self, scene("-motion_x_record", self.record(text), "-motion_x_unit", "m/s2"))
            self.assertAlmostEqual(summary["motion"]["x"]["file_peak"], 1e5, delta=1e-6)

    def test_says_what_it_understood_in_dry_runs_and_runs(self):
        path = self.record("A RECORD IN UNITS OF (G)\nNPTS= 5, DT= .01 SEC\n .1 -.2\n .1 .05\n 0.\n")
        words = scene("-motion_x_record", path, "-motion_x_pga", 2.0, "-motion_z_target",
                      "petsc-options/spectra/alluvial.csv", "-motion_z_pga", 1.0, "-motion_z_duration", 20)
        for more in ([], ["-dry_run"]):
            with tempfile.TemporaryDirectory() as folder:
                result = program.run([*words, *more, "-output", folder])
            self.assertEqual(result.returncode, 0, result.stderr)
            for line in (f"motion x: {path}",
                         "  rows of 2 values that follow one another, in g (header), 5 points every 0.01 s, "
                         "0.04 s, peak 1.961 m/s2 (0.2 g)",
                         "  scaled: to pga 2 m/s2; pga 2 m/s2 (0.2039 g)",
                         "motion z: petsc-options/spectra/alluvial.csv"):
                self.assertIn("\n" + line, result.stdout)
            self.assertEqual(result.stdout.count("synthetic, seed 1, "), 1)
        _, summary = program.must_run(self, words)
        motion = summary["motion"]
        self.assertIsNone(motion["y"])
        self.assertEqual((motion["x"]["file"], motion["x"]["unit"], motion["x"]["points"]), (path, "g (header)", 5))
        self.assertAlmostEqual(motion["x"]["file_peak"], 0.2 * G, delta=1e-12)
        self.assertAlmostEqual(motion["z"]["pga_in_g"], 1 / G, delta=1e-12)
        self.assertEqual(motion["z"]["scaled"], "to pga 1 m/s2")

    def test_rows_that_might_be_columns_are_doubted(self):
        path = self.record("1 0.5 0.2\n-2 0.25 0.1\n1 0.5 0.2\n")
        _, summary = program.must_run(self, scene("-motion_x_record", path, "-motion_x_unit", "m/s2",
                                                  "-motion_x_time_step", 0.02))
        self.assertEqual(summary["motion"]["x"]["points"], 9)
        self.assertTrue(any("or columns?" in line for line in summary["warnings"]), summary["warnings"])

    def test_records_set_in_when_their_times_say_so(self):
        paths = [self.record("COMP. N10E\nt [s], a (g)\n" + "".join(f"{first + 0.02 * i:.2f},{0.1 * (i % 3)}\n" for i in range(9)))
                 for first in (20, 23.2)]
        words = scene("-motion_x_record", paths[0], "-motion_y_record", paths[1])
        folder, summary = program.must_run(self, [*words, "-end_time", 4, "-output_interval", 0.02])
        self.assertAlmostEqual(summary["motion"]["y"]["sets_in_at"], 3.2)
        self.assertAlmostEqual(summary["motion"]["x"]["sets_in_at"], 0)
        self.assertEqual(summary["motion"]["y"]["component"], "N10E")
        with h5py.File(os.path.join(folder, "history.h5")) as file:
            time, ground = file["time"][:], file["ground_acceleration"][:]
        self.assertTrue((ground[time < 3.1, 1] == 0).all())
        self.assertGreater(abs(ground[(time > 3.2) & (time < 3.4), 1]).max(), 1)
        self.assertGreater(abs(ground[time < 0.2, 0]).max(), 1)
        result = program.run([*words, "-dry_run"], 1)
        self.assertIn("sets in at 3.2 s: its times begin at 23.2 s, t = 0 is 20 s of them", result.stdout)
        self.assertIn(", component N10E", result.stdout)

    def test_a_peak_after_the_end_is_doubted(self):
        """Half of the peak comes at 0.04 s, the peak at 0.2 s: an earlier end of the run applies half of what pga says."""
        path = self.record("t [s], a (g)\n" + "".join(
            f"{0.02 * i:.2f},{value}\n" for i, value in enumerate([0, 0.05, -0.1, 0.05, 0, 0, 0, 0, 0, 0.05, 0.2, 0.1, 0, 0])))
        for end, felt in ((0.18, 1), (0.2, 2), (0.25, 2)):
            folder = tempfile.mkdtemp(prefix="pounding-")
            result = program.run(scene("-motion_x_record", path, "-motion_x_pga", 2, "-end_time", end, "-output", folder))
            self.assertEqual(result.returncode, 0, result.stderr)
            with h5py.File(os.path.join(folder, "history.h5")) as file:
                self.assertAlmostEqual(abs(file["ground_acceleration"][:, 0]).max(), felt, delta=1e-9)
            said = [] if felt == 2 else ["option -end_time 0.18 s: the motion along x has its peak of 2 m/s2 later; the run "
                                         "feels 1 m/s2 at most"]
            self.assertEqual(program.summary(folder)["warnings"], said)
            self.assertEqual([line[9:] for line in result.stdout.splitlines() if line.startswith("warning: ")], said)

    def test_a_late_peak_is_that_of_times_and_of_what_lies_between_samples(self):
        table = [0, 0.05, -0.1, 0.05, 0, 0, 0, 0, 0, 0.05, 0.2, 0.1, 0, 0]
        first, late = (self.record("t [s], a (g)\n" + "".join(
            f"{start + 0.02 * i:.2f},{value}\n" for i, value in enumerate(table))) for start in (20, 21))
        for words, said in (
                (["-motion_x_record", first, "-motion_x_pga", 2, "-end_time", 0.19], ["x has its peak of 2 m/s2 later; the run feels 1.25"]),
                (["-motion_x_record", first, "-motion_x_pga", 2, "-end_time", 0.1999], []),
                (["-motion_x_record", first, "-motion_y_record", late, "-motion_y_pga", 2, "-end_time", 1.1],
                 ["y has its peak of 2 m/s2 later; the run feels 1 m/s2"])):
            _, summary = program.must_run(self, scene(*words))
            found = [line for line in summary["warnings"] if "has its peak" in line]
            self.assertEqual(len(found), len(said), found)
            for line, part in zip(found, said):
                self.assertIn(part, line)

    def test_an_end_within_the_strong_part_is_doubted(self):
        """The peak comes first; half of the squares come later."""
        path = self.record("t [s], a (g)\n" + "".join(
            f"{0.02 * i:.2f},{value}\n" for i, value in enumerate([0, 0.2, -0.2, 0.2, -0.2, 0.1414, -0.1414] + [0.14142] * 6 + [0, 0])))
        for end, felt in ((0.13, 62.5), (0.19, None)):
            _, summary = program.must_run(self, scene("-motion_x_record", path, "-end_time", end))
            self.assertEqual(summary["warnings"], [f"option -end_time {end} s: the run ends in the strong part of the motion along x, "
                                                   f"after {felt} % of its Arias intensity"] if felt else [])

    def test_no_motion_at_all_is_said(self):
        result = program.run(scene("-mass_initial_velocity", "1,0,0", "-dry_run"), 1)
        self.assertIn("\nmotion: none\n", result.stdout)


if __name__ == "__main__":
    unittest.main()
