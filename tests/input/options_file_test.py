"""Options from files, the command line and the surroundings: what is wrong is told with its place, and nothing but
the scene's own files and words has a say in the run."""
import os
import shutil
import tempfile
import unittest

import numpy
import scipy.io

import program

CASE = program.COARSE_PAIR + ["-end_time", "0.001"]


class Options(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pounding-")

    def file(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "wb") as file:
            file.write(text if isinstance(text, bytes) else text.encode())
        return path

    def refuse(self, arguments, *words):
        """One line that holds the words; status 1; nothing left behind."""
        output = os.path.join(self.folder, "results")
        line = program.must_refuse(self, [*arguments, "-output", output], *words, timeout=60)
        self.assertFalse(os.path.exists(output))
        self.assertNotIn("PETSC", line)


class Files(Options):
    def refuse_text(self, text, *words):
        path = self.file("case.yaml", text)
        self.refuse(["-options_file", path], path, *words)

    def test_broken_yaml(self):
        self.refuse_text("s1: {mesh: a.geo\n  b: [\n", "line 2, column 4", "not YAML")

    def test_a_kilobyte_that_would_take_for_ever(self):
        merges = "$$a0: &a0 {courant: 0.9}\n" + "".join(
            f"$$a{i}: &a{i} {{<<: [{', '.join(['*a' + str(i - 1)] * 9)}]}}\n" for i in range(1, 14)) + "<<: *a13\n"
        self.assertLess(len(merges), 1100)
        self.refuse_text(merges, "anchors hold anchors")
        self.refuse_text("s1: " + "[" * 100000, "line 1, column 68", "nested too deep")
        self.refuse_text("a: " + "{b: " * 20000, "nested too deep")

    def test_files_without_an_end_or_too_large(self):
        pipe, large = os.path.join(self.folder, "pipe"), os.path.join(self.folder, "large.txt")
        os.mkfifo(pipe)
        with open(large, "wb") as file:
            file.truncate(60_000_000_000)  # to hash it would take a minute
        self.refuse(CASE + ["-motion_x_record", large], "-motion_x_record", "holds 60000 MB")
        for option in ("-options_file", "-include", "-s1_mesh", "-motion_x_record", "-motion_x_target", "-restart",
                       "-s1_initial_state"):
            for path in (pipe, "/dev/zero"):
                self.refuse([*CASE, option, path], path)

    def test_a_geometry_that_names_a_pipe_or_a_device(self):
        os.mkfifo(os.path.join(self.folder, "pipe.geo"))
        for named in ("pipe.geo", "/dev/zero"):
            path = self.file("case.geo", f'Include "{named}";\nPoint(1) = {{0, 0, 0}};\n')
            self.refuse([*CASE, "-s1_mesh", path, "-s1_mesh_set", "none"], "-s1_mesh", "could not read it")

    def test_tab(self):
        self.refuse_text("s1:\n\tmesh: a.geo\n", "line 2, column 1", "a tab")

    def test_names_that_stand_twice(self):
        self.refuse_text("end_time: 1\ncourant: 0.5\nend_time: 2\n", "line 3", "end_time", "line 1")

    def test_structures_contacts_and_probes_that_stand_twice(self):
        for name in ("left", "floor1", "corner"):
            self.refuse_text(f"{name}: {{mesh: a.geo}}\n{name}: {{mesh: b.geo}}\n", "line 2", name, "line 1")

    def test_two_of_the_same_name_in_a_list(self):
        for option in ("structures", "contacts", "probes"):
            self.refuse(CASE + ["-" + option, "s1,s1"], "-" + option, "s1", "twice")

    def test_second_document(self):
        self.refuse_text("end_time: 1\n---\ncourant: 0.5\n", "line 3", "second document")

    def test_empty(self):
        self.refuse_text("", "holds no options")
        self.refuse_text("# nothing yet\n", "holds no options")

    def test_no_options(self):
        self.refuse_text("-end_time 1\n", "line 1", "expected lines like end_time: 25")

    def test_binary(self):
        self.refuse_text(b"\x7fELF\x02\x01\x01\x00\x00", "not YAML", "is it an options file?")

    def test_broken_file_that_is_included(self):
        path = self.file("inner.yaml", "a: [\n")
        outer = self.file("outer.yaml", f"include: {path}\n")
        self.refuse(["-options_file", outer], path, "line 2", "not YAML")

    def test_merged_names_yield_to_those_beside_them(self):
        path = self.file("case.yaml", "include: petsc-options/azalee/gap2.yaml\n$$short: &short {end_time: 1e-4, modes: 2}\n"
                                      "<<: *short\nmodes: 0\nspectra: {frequencies: [1, 2, 5]}\n")
        _, summary = program.must_run(self, ["-options_file", path, *program.COARSE_PAIR[2:]], 2, timeout=120)
        self.assertEqual(summary["options"]["end_time"], "1e-4")
        self.assertEqual(summary["options"]["modes"], "0")
        self.assertEqual(summary["options"]["spectra_frequencies"], "1,2,5")


class CommandLine(Options):
    def test_file_without_a_name(self):
        self.refuse(["case.yaml"], "did you mean -options_file case.yaml?")

    def test_equals_signs(self):
        self.refuse([*CASE, "end_time=0.1"], "did you mean -end_time 0.1?")
        self.refuse([*CASE, "-end_time=0.1"], "write -end_time 0.1")

    def test_stray_word(self):
        self.refuse([*CASE, "now"], "'now'", "no option")

    def test_options_file_without_a_file(self):
        self.refuse(["-options_file"], "-options_file needs a file")

    def test_version(self):
        for word in ("-version", "--version"):
            result = program.must_end(self, [word], 2, timeout=60)
            self.assertRegex(result.stdout, r"^pounding \d+\.\d+\.\d+ \([\w-]+\)\n(  \w+ .*\d\n)+$")


class Libraries(Options):
    """PETSc and SLEPc get what the scene gives them, and write where the scene says."""

    def test_files_elsewhere(self):
        elsewhere = os.path.join(self.folder, "elsewhere")
        for name, value in (("log_view", ":" + elsewhere), ("malloc_view", elsewhere), ("info", ":" + elsewhere),
                            ("lowest_eps_view", "ascii:" + elsewhere), ("lowest_eps_monitor", "ascii:" + elsewhere),
                            ("lowest_eps_view_vectors", "binary:" + elsewhere), ("mat_view", ":" + elsewhere),
                            ("log_trace", elsewhere), ("options_view", ":" + elsewhere),
                            ("viewer_binary_filename", elsewhere)):
            self.refuse([*CASE, "-" + name, value], "-" + name)
        self.assertEqual(os.listdir(self.folder), [])

    def test_debuggers(self):
        for name in ("start_in_debugger", "on_error_attach_debugger", "debugger_pause"):
            self.refuse([*CASE, "-" + name], "-" + name)

    def test_solver_that_is_not_there(self):
        self.refuse([*CASE, "-lowest_eps_type", "nope"], "-lowest_eps_type nope", "krylovschur")

    def test_solver_that_cannot_work(self):
        self.refuse([*CASE, "-lowest_eps_ncv", "3"], "-lowest_eps_ncv", "at least nev+1")
        self.refuse([*CASE, "-lowest_eps_max_it", "1"], "-lowest_eps_max_it", "modes converged")

    def test_only_the_scene_is_read(self):
        """Options in .petscrc, ~/.petscrc and PETSC_OPTIONS that would end the run or write files do not."""
        self.file(".petscrc", "-lowest_eps_type nope\n-log_view :log.txt\n-end_time 7\n")
        home = os.path.join(self.folder, "home")
        os.mkdir(home)
        shutil.copy(os.path.join(self.folder, ".petscrc"), home)
        environment = {**program.ENVIRONMENT, "HOME": home,
                       "PETSC_OPTIONS": "-lowest_eps_type nope -options_view :table.txt -end_time 9"}
        scene = self.file("case.yaml", "include: petsc-options/azalee/gap2.yaml\nend_time: 1e-4\n")
        words = ["-options_file", scene, *program.COARSE_PAIR[2:], "-output", os.path.join(self.folder, "results")]
        for name in ("petsc-options", "meshes"):
            os.symlink(os.path.join(program.SOURCE, name), os.path.join(self.folder, name))
        result = program.must_end(self, words, timeout=120, folder=self.folder, environment=environment)
        summary = program.summary(os.path.join(self.folder, "results"))
        self.assertEqual(summary["end_time"], 1e-4)
        (doubt,) = [line for line in summary["warnings"] if "PETSC_OPTIONS" in line]
        self.assertIn("is not read", doubt)
        self.assertIn("warning: " + doubt, result.stdout)
        self.assertEqual(sorted(os.listdir(self.folder)),
                         [".petscrc", "case.yaml", "home", "meshes", "petsc-options", "results"])

    def test_files_beside_matrices_are_not_read(self):
        """PETSc takes options from the .info file beside a matrix: this one would end the run."""
        scene = ["-structures", "m", "-m_mesh", "tests/meshes/line.geo", "-m_mesh_set", "length=10,n=5", "-m_clamp", "x_min",
                 "-m_line_element", "bar", "-m_line_area", "1", "-m_line_material", "s", "-material_s_young", "1e9",
                 "-material_s_poisson", "0", "-material_s_density", "1000", "-end_time", "1e-3", "-modes", "2", "-dry_run"]
        matrices = os.path.join(self.folder, "matrices")
        self.assertEqual(program.run([*scene, "-export_matrices", matrices], 1, timeout=60).returncode, 0)
        folder = os.path.join(matrices, "m")
        market = scipy.io.mmread(os.path.join(folder, "stiffness.mtx")).tocsr()
        with open(os.path.join(folder, "stiffness.petsc"), "wb") as file:
            for numbers, kind in (([1211216, *market.shape, market.nnz], ">i4"), (numpy.diff(market.indptr), ">i4"),
                                  (market.indices, ">i4"), (market.data, ">f8")):
                file.write(numpy.asarray(numbers, kind).tobytes())
        os.remove(os.path.join(folder, "stiffness.mtx"))
        with open(os.path.join(folder, "stiffness.petsc.info"), "w") as file:
            file.write("-lowest_eps_type nope\n-lowest_eps_tol nope\n")
        result = program.must_end(self, [*scene, "-m_matrices", folder], timeout=60)

    def test_no_option_of_the_scene_is_called_unused(self):
        result = program.run([*CASE, "-dry_run", "-options_left", "-output", self.folder], timeout=120)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("There are no unused options", result.stdout)


if __name__ == "__main__":
    unittest.main()
