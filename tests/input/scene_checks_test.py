"""The run that the options ask for: what cannot be is refused before the work, what may not be meant is told in one
line of doubt, on the terminal and in the summary."""
import os
import pty
import shutil
import subprocess
import tempfile
import unittest

import h5py

import program

PROCESSORS = 2  # on a terminal, of two ranks as well

# Two masses in a row on springs, 0.1 s of free vibration: nothing to doubt.
CHAIN = ["-structures", "m", "-m_mesh", "tests/meshes/chain.geo", "-m_mesh_set", "links=3", "-m_clamp", "ground",
         "-modes", "0", "-m_initial_velocity", "1,0,0", "-end_time", "0.1", "-time_step", "1e-4", "-output_interval", "1e-3"]
for mass in ("ground", "first", "second"):
    CHAIN += [f"-m_{mass}_element", "point_mass", f"-m_{mass}_mass", "2"]
for link in ("link1", "link2"):
    CHAIN += [f"-m_{link}_element", "spring", f"-m_{link}_stiffness", "1e4,1e4,1e4"]
PROBE = ["-peak_frequency", "100", "-probes", "p", "-p_structure", "m", "-p_at"]


class Run(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pounding-")
        self.output = os.path.join(self.folder, "results")

    def refuse(self, words, *expected):
        program.must_refuse(self, ["-output", self.output, *words], *expected, timeout=120)
        self.assertFalse(os.path.exists(self.output))

    def doubts(self, words, again=False):
        """Lines of doubt, the same in the summary and on the terminal."""
        if not again:
            shutil.rmtree(self.output, ignore_errors=True)
        result = program.must_end(self, ["-output", self.output, *words], timeout=120)
        printed = [line[9:] for line in result.stdout.splitlines() if line.startswith("warning: ")]
        self.assertEqual(program.summary(self.output)["warnings"], printed)
        again = "".join(f"  {line}\n" for line in printed[:8])
        self.assertIn(f"doubts, {len(printed)}:\n{again}" if printed else "\nno doubts\n", result.stdout[-3000:])
        return printed

    def doubt(self, words, *expected):
        (line,) = self.doubts(words)
        for word in expected:
            self.assertIn(word, line)

    def record(self, step, count):
        path = os.path.join(self.folder, "record.txt")
        with open(path, "w") as file:
            file.writelines(f"{i * step:.6f} {(-1) ** i}\n" for i in range(count))
        return path


class Time(Run):
    def test_nothing_to_doubt(self):
        self.assertEqual(self.doubts([*CHAIN, *PROBE, "1,0,0"]), [])

    def test_more_steps_than_can_be(self):
        self.refuse([*CHAIN, "-end_time", "1e20"], "-end_time 1e+20", "1e+24 steps", "above 1e+12")
        self.refuse([*CHAIN, "-time_step", "1e-20"], "1e+19 steps of 1e-20 s", "-time_step")

    def test_nothing_moves(self):
        self.doubt([*CHAIN, "-m_initial_velocity", "0,0,0"], "nothing makes the scene move", "-motion_x_record")

    def test_gravity_moves(self):
        self.assertFalse([line for line in self.doubts([*CHAIN, "-m_initial_velocity", "0,0,0", "-m_gravity", "0,0,-9.81"])
                          if "nothing" in line])

    def test_end_after_the_record(self):
        motion = ["-motion_x_unit", "m/s2", "-motion_x_record"]
        self.doubt([*CHAIN, *motion, self.record(0.005, 16)], "-end_time 0.1 s", "along x ends at 0.075 s")
        self.assertEqual(self.doubts([*CHAIN, *motion, self.record(0.005, 21)]), [])

    def test_step_longer_than_the_samples(self):
        motion = ["-motion_y_unit", "m/s2", "-motion_y_record", self.record(0.0005, 201)]
        self.doubt([*CHAIN, *motion, "-time_step", "0.001"], "time step 0.001 s", "motion along y, 0.0005 s")
        self.doubt([*CHAIN, *PROBE, "1,0,0", "-time_step", "0.002"], "-output_interval, 0.001 s", "-time_step 0.001")

    def test_step_longer_than_those_of_a_resampled_record(self):
        """Points of the band-limited signal between the samples may be stepped over."""
        resampled = ["-motion_y_unit", "m/s2", "-resampling", "band_limited", "-motion_y_record",
                     self.record(0.005, 21), "-time_step"]
        self.assertEqual(self.doubts([*CHAIN, *resampled, "0.002"]), [])
        lines = self.doubts([*CHAIN, *resampled, "0.01"])
        self.assertEqual(len([line for line in lines if "time step 0.01 s" in line and "motion along y, 0.005 s" in line]), 1,
                         lines)


class Displacements(Run):
    def test_above_a_twentieth_of_the_model(self):
        """The largest of the run, not that of its end: the masses are on their way back then."""
        words = [*CHAIN, *PROBE, "1,0,0", "-end_time", "0.08"]
        (line,) = self.doubts([*words, "-m_initial_velocity", "20,0,0"])
        largest = program.summary(self.output)["probes"]["p"]["peak_displacement"][0]
        self.assertIn(f"displacements reach {largest:.3g} m in a model of 2 m", line)
        with h5py.File(os.path.join(self.output, "history.h5")) as file:
            self.assertLess(abs(file["displacement"][-1]).max(), 0.5 * largest)
        self.assertEqual(self.doubts([*words, "-m_initial_velocity", "5,0,0"]), [])


class Probes(Run):
    def test_far_from_the_mesh(self):
        self.refuse([*CHAIN, *PROBE, "1.2,0,0"], "-p_at", "0.2 m away")

    def test_beside_a_node(self):
        self.doubt(["-structures", "m", "-m_mesh", "tests/meshes/line.geo", "-m_mesh_set", "length=10,n=10",
                    "-m_line_element", "bar", "-m_line_area", "1", "-m_line_material", "s", "-material_s_young", "1e9",
                    "-material_s_poisson", "0", "-material_s_density", "1000", "-m_clamp", "line:y+z",
                    "-m_initial_velocity", "1,0,0", "-end_time", "0.01", "-modes", "0", *PROBE, "3.25,0,0",
                    "-output_interval", "1e-3", "-spectra_frequencies", "1,100"], "probe p", "0.25 m away", "1 m")

    def test_a_metre_off_large_elements(self):
        lines = self.doubts(["-structures", "m", "-m_mesh", "tests/meshes/line.geo", "-m_mesh_set", "length=60,n=6",
                    "-m_line_element", "bar", "-m_line_area", "1", "-m_line_material", "s", "-material_s_young", "1e9",
                    "-material_s_poisson", "0", "-material_s_density", "1000", "-m_clamp", "line:y+z",
                    "-m_initial_velocity", "1,0,0", "-end_time", "0.1", "-modes", "0", *PROBE, "31,0,0",
                    "-output_interval", "1e-3"])
        self.assertTrue(any("probe p: its node is 1 m away" in line for line in lines), lines)

    def test_a_spring_of_ten_metres(self):
        path = os.path.join(self.folder, "chain.geo")
        with open(path, "w") as file, open(os.path.join(program.SOURCE, "tests/meshes/chain.geo")) as chain:
            file.write(chain.read().replace("{2, 0, 0}", "{11, 0, 0}"))
        self.doubt([*CHAIN, "-m_mesh", path, *PROBE, "1,0,0"], "group link2: a spring of 10 m", "bar")

    def test_a_spring_over_a_diagonal(self):
        path = os.path.join(self.folder, "chain.geo")
        with open(path, "w") as file, open(os.path.join(program.SOURCE, "tests/meshes/chain.geo")) as chain:
            file.write(chain.read().replace("{2, 0, 0}", "{4, 4, 0}"))
        self.doubt([*CHAIN, "-m_mesh", path, *PROBE, "1,0,0"], "group link2: a spring of 5 m", "acts along the axes")

    def test_dashpots_in_series_that_start_let_go(self):
        self.doubt([*CHAIN, "-m_link2_dashpot", "10,10,10", "-m_link2_dashpot_stiffness", "1e3,1e3,1e3", "-m_initial_displacement",
                    "0.01,0,0", *PROBE, "1,0,0"], "group link2: its dashpots in series with springs start let go")

    def test_springs_that_yield_in_modes_beside_beta(self):
        words = [*CHAIN, "-m_link2_yield_force", "10,10,10", "-m_damping_beta", 1e-3, *PROBE, "1,0,0"]
        reduced = ["-m_model", "modal", "-m_modal_vectors", 2]
        said = "group link2: yields in modes, whose stiffness damping (beta) acts on it as well"
        self.assertIn("-m_modal_damping", *[line for line in self.doubts([*words, *reduced]) if said in line])
        for more in ([], [*reduced, "-m_damping_beta", 0], [*reduced, "-m_damping_beta", 0, "-m_modal_damping", 0.02]):
            self.assertFalse([line for line in self.doubts([*words, *more]) if said in line], more)

    def test_loads_whose_sum_is_zero_are_a_start(self):
        lines = self.doubts([*CHAIN, "-preload", "static", "-loads", "left,right", "-left_on", "m:first",
                             "-left_force", "-100,0,0", "-right_on", "m:second", "-right_force",
                             "100,0,0", *PROBE, "1,0,0"])
        self.assertFalse([line for line in lines if "undeformed" in line or "miss its weight" in line], lines)

    def test_shift_of_a_mode_of_no_frequency(self):
        loose = ["-modes", 3, "-m_clamp", "none", "-m_allow_loose", "true", "-m_damping_uniform", 0.02, "-m_damping_reference", 5]
        result = program.must_end(self, [*CHAIN, *loose, "-dry_run", *PROBE, "1,0,0", "-output", self.folder])
        self.assertIn("damped 0.000 Hz", result.stdout)
        self.assertNotIn("nan", result.stdout)

    def test_far_within_five_percent_of_the_extent(self):
        self.refuse(["-structures", "m", "-m_mesh", "tests/meshes/line.geo", "-m_mesh_set", "length=100,n=100",
                     "-m_line_element", "bar", "-m_line_area", "1", "-m_line_material", "s", "-material_s_young", "1e9",
                     "-material_s_poisson", "0", "-material_s_density", "1000", "-m_clamp", "line:y+z",
                     "-end_time", "0.01", *PROBE, "50,2,0"], "-p_at", "2 m away")

    def test_nodes_that_are_not_averaged_are_numbered_from_1(self):
        self.assertEqual(self.doubts([*CHAIN, *PROBE, "1,0,0; 2,0,0", "-p_average", "false"]), [])
        with h5py.File(os.path.join(self.output, "history.h5")) as file:
            channels = [name.decode() for name in file["channels"]]
        self.assertEqual(channels, ["p.1.x", "p.1.y", "p.1.z", "p.2.x", "p.2.y", "p.2.z"])
        self.assertEqual({name: probe["position"] for name, probe in program.summary(self.output)["probes"].items()},
                         {"p.1": [1, 0, 0], "p.2": [2, 0, 0]})

    def test_on_a_clamped_node(self):
        self.doubt([*CHAIN, *PROBE, "0,0,0"], "probe p: its node is clamped")

    def test_on_a_contact_node(self):
        lines = self.doubts(program.COARSE_PAIR + ["-end_time", "1e-3", "-modes", "0", "-motion_x_duration", "16",
                                                   "-spectra_frequencies", "1,100"])
        lines = [line for line in lines if "has its peak" not in line]  # the run is short
        for name in ("s1_floor1", "s1_floor2", "s2_floor1", "s2_floor2"):
            self.assertTrue([line for line in lines if line.startswith(f"probe {name}: 2 of its 4 nodes are part of a")])
            self.assertTrue([line for line in lines if line.startswith(f"probe {name}: its node is 0.17 m away")])
        self.assertEqual(len(lines), 8, lines)

    def test_fine_pair_has_none(self):
        result = program.run(["-options_file", "petsc-options/azalee/gap2.yaml", "-dry_run", "-modes", "0"], 2, timeout=300)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("warning", result.stdout)
        self.assertIn("probe s1_floor1: 4 nodes of s1 at (1.68, 1.14, 2.72), at most 0 mm", result.stdout)


class Folder(Run):
    def test_cannot_be_made(self):
        """Refused before the meshes are read: the mesh is not there either."""
        file = os.path.join(self.folder, "file")
        open(file, "w").close()
        for words in (["-output", "/proc/nowhere/results"], ["-output", file], ["-output", os.path.join(file, "results")],
                      ["-output", self.output, "-export_matrices", file]):
            program.must_refuse(self, [*CHAIN, "-m_mesh", "none.geo", *words], " ".join(words[-2:]), timeout=60)
        self.assertEqual(os.listdir(self.folder), ["file"])

    def test_left_as_it_was_when_the_scene_is_wrong(self):
        self.refuse([*CHAIN, "-m_mesh", "none.geo", "-output", os.path.join(self.output, "deep", "er")], "none.geo")
        os.makedirs(self.output)
        program.run([*CHAIN, "-m_mesh", "none.geo", "-output", self.output], 1, timeout=60)
        self.assertEqual(os.listdir(self.output), [])

    def test_results_of_another_scene_are_named(self):
        self.assertEqual(self.doubts(CHAIN), [])
        self.assertEqual(self.doubts([*CHAIN, "-end_time", "0.05"], again=True), [])
        record = ["-motion_x_unit", "m/s2", "-motion_x_record", self.record(0.005, 21)]
        (line,) = self.doubts([*CHAIN, *record], again=True)
        self.assertIn(self.output + " holds results of another scene", line)
        self.assertIn("-motion_x_record none, now", line)
        self.assertEqual(self.doubts([*CHAIN, *record], again=True), [])

    def test_dry_run_writes_modes_where_asked(self):
        words = [*CHAIN, "-modes", "2", "-dry_run", "-output", self.output]
        self.assertEqual(program.run(words, timeout=60).returncode, 0)
        self.assertFalse(os.path.exists(self.output))
        result = program.must_end(self, [*words, "-write_modes"], timeout=60)
        self.assertEqual(sorted(os.listdir(self.output)), ["modes.h5", "modes.xdmf"])
        shutil.rmtree(self.output)


class Progress(Run):
    def test_only_where_somebody_sees_it(self):
        words = [*CHAIN, "-output", self.output, "-progress_interval", 1000]  # a busy machine is no reason
        for ranks in (1, 2):
            result = program.launch(words, ranks, timeout=60)
            self.assertIn("results in", result.stdout)
            self.assertNotIn("per simulated", result.stdout)
            self.assertIn("per simulated", self.on_a_terminal(program.words(words, ranks)))

    def on_a_terminal(self, command):
        mine, theirs = pty.openpty()
        process = subprocess.Popen(command, cwd=program.SOURCE, env=program.ENVIRONMENT, stdout=theirs, stdin=theirs)
        os.close(theirs)
        text = b""
        try:
            while piece := os.read(mine, 65536):
                text += piece
        except OSError:  # the other end is closed
            pass
        os.close(mine)
        self.assertEqual(process.wait(60), 0)
        return text.decode()


if __name__ == "__main__":
    unittest.main()
