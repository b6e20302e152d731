"""Whence the results are: every file that was read with its hash, versions, machine, time, what the command line
changed, and how records, materials and sections were understood.

A mass on a spring and a beam, from an options file that includes another, a geometry that includes another, and a
record."""
import datetime
import hashlib
import os
import re
import subprocess
import sys
import tempfile
import unittest

import numpy

import program

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
from pounding.scenes import read_scene  # noqa: E402

LATIN = b"K\xf6ln".decode(errors="surrogateescape")

SAMPLES = [0.0, 0.5, -1.0, 2.5, 1.0, 0.0]  # m/s2
STEP = 0.02


class Provenance(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pounding-origin-")
        self.write("points.geo", "Point(1) = {0, 0, 0};\nPoint(2) = {1, 0, 0};\n")
        self.write("stick.geo", 'Include "points.geo";\nLine(1) = {1, 2};\nTransfinite Curve {1} = 3;\n'
                   'Physical Curve("post") = {1};\nPhysical Point("foot") = {1};\n')
        self.write("record.txt", "".join(f"{value}\n" for value in SAMPLES))
        self.write("parts.yaml", "post: {structure: stick, at: '1,0,0'}\nmaterial: {mine: {young: 2e11, poisson: 0.25, "
                   "density: 7800}}\nsection: {heb120: {z_axis: '0,1,0'}}\n")
        self.scene = self.write("case.yaml", """include: parts.yaml
title: A post, 1 m
structures: stick
stick: {mesh: stick.geo, clamp: foot, damping_alpha: 1,
        post: {element: beam, material: mine, section: heb120}}
motion: {x: {record: record.txt, unit: m/s2, time_step: 0.02, pga: 5}}
end_time: 0.1
modes: 2
probes: post
""")

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", errors="surrogateescape") as file:
            file.write(text)
        return path

    def run_case(self, *words, ranks=1):
        return program.must_run(self, ["-options_file", self.scene, *words], ranks)[1]

    def test_names_are_bytes(self):
        """Folder, mesh, record, title and output in Latin-1, and a title that a terminal would obey."""
        self.folder = os.path.join(self.folder, LATIN)
        os.mkdir(self.folder)
        self.write(f"{LATIN}.geo", "Point(1) = {0, 0, 0};\nPoint(2) = {1, 0, 0};\nLine(1) = {1, 2};\n"
                   'Transfinite Curve {1} = 3;\nPhysical Curve("post") = {1};\nPhysical Point("foot") = {1};\n')
        self.write(f"{LATIN}.txt", "".join(f"{value}\n" for value in SAMPLES))
        with open(self.scene) as file:
            text = file.read().replace("include: parts.yaml", f"include: {os.path.dirname(self.folder)}/parts.yaml")
        self.write("case.yaml", text.replace("stick.geo", f"{LATIN}.geo").replace("record.txt", f"{LATIN}.txt")
                   .replace("A post, 1 m", f"{LATIN}"))
        out = os.path.join(self.folder, LATIN)
        first = program.launch(["-options_file", "case.yaml", "-output", out], folder=self.folder)
        self.assertEqual(first.returncode, 0, ascii(first.stderr))
        told = program.summary(out)
        self.assertEqual((told["title"], os.path.basename(told["machine"]["folder"])), ("K\xf6ln", "K\xf6ln"))
        self.assertIn("K\xf6ln.txt", [os.path.basename(one["file"]) for one in told["inputs"]])
        resolved = os.path.join(out, "resolved.yaml")
        self.assertEqual(read_scene(resolved)["title"], LATIN)
        again = program.launch(["-options_file", resolved, "-title", "a\033[31m\nb", "-output", out + "2"], folder=self.folder)
        self.assertEqual(again.returncode, 0, ascii(again.stderr))
        self.assertIn("\na [31m b\n", again.stdout)
        self.assertEqual(read_scene(os.path.join(out + "2", "resolved.yaml"))["title"], "a\033[31m\nb")

    def test_every_input_has_the_hash_of_its_content(self):
        names = ("case.yaml", "parts.yaml", "stick.geo", "points.geo", "record.txt")
        inputs = self.run_case()["inputs"]
        self.assertEqual(sorted(os.path.basename(one["file"]) for one in inputs), sorted(names))
        for one in inputs:
            with open(one["file"], "rb") as file:
                content = file.read()
            self.assertEqual((one["bytes"], one["sha256"]), (len(content), hashlib.sha256(content).hexdigest()))
        before = {one["file"]: one["sha256"] for one in inputs}
        self.write("points.geo", "Point(1) = {0, 0, 0};\nPoint(2) = {1.0, 0, 0};\n")
        after = {one["file"]: one["sha256"] for one in self.run_case()["inputs"]}
        self.assertEqual([os.path.basename(path) for path in before if after[path] != before[path]], ["points.geo"])

    def test_files_that_gmsh_opened_are_inputs(self):
        """Whatever their names are made of, once each; those that it only looked for are none."""
        self.write("more.pos", 'View "size" {SP(0, 0, 0){1};};\n')
        with open(os.path.join(self.folder, "stick.geo"), "a") as file:
            file.write('n = "more";\nMerge StrCat(n, ".pos");\nMerge Str("more.pos");\nx = FileExists("none.geo");\n')
        inputs = self.run_case()["inputs"]
        told = [os.path.basename(one["file"]) for one in inputs if one["option"] == "included"]
        self.assertEqual(told, ["points.geo", "more.pos"])

    def test_a_file_is_told_for_every_option_that_names_it(self):
        record = os.path.join(self.folder, "record.txt")
        inputs = self.run_case("-motion_y_record", record, "-motion_y_unit", "m/s2", "-motion_y_time_step", STEP)["inputs"]
        told = [one for one in inputs if one["file"] == record]
        self.assertEqual([one["option"] for one in told], ["motion_x_record", "motion_y_record"])
        self.assertEqual(told[0]["sha256"], told[1]["sha256"])

    def test_tables_of_loads_and_starts_are_inputs(self):
        push = self.write("push.txt", "0 0\n0.1 1\n")
        start = self.write("start.csv", "x,y,z,vx\n1,0,0,0.1\n")
        inputs = self.run_case("-loads", "push", "-push_on", "stick:post", "-push_line_force", "0,0,9", "-push_table", push,
                               "-stick_initial_state", start, ranks=2)["inputs"]
        told = {one["option"]: one["file"] for one in inputs}
        self.assertEqual((told.get("push_table"), told.get("stick_initial_state")), (push, start))

    def test_all_matrices_have_hashes(self):
        self.run_case("-export_matrices", self.folder)
        folder = os.path.join(self.folder, "stick")
        with open(os.path.join(folder, "stiffness.mtx")) as file:
            rows = next(line for line in file if not line.startswith("%")).split()[0]
        self.write("stick/damping.mtx", f"%%MatrixMarket matrix coordinate real general\n{rows} {rows} 1\n1 1 0.5\n")
        inputs = self.run_case("-stick_matrices", folder, ranks=2)["inputs"]
        self.assertEqual(sorted(os.path.basename(one["file"]) for one in inputs if one["option"] == "stick_matrices"),
                         ["damping.mtx", "dofs.csv", "mass.mtx", "stiffness.mtx"])

    def reduced(self, *words, ranks=1):
        words = ["-options_file", self.scene, "-stick_model", "modal", "-stick_modal_vectors", 4, "-stick_modal_basis",
                 os.path.join(self.folder, "basis.h5"), *words]
        return program.must_run(self, words, ranks)

    def test_a_kept_basis_has_the_hash_of_what_was_used(self):
        """Of the run that writes it as of one that takes it up."""
        inputs = self.reduced()[1]["inputs"]
        with open(os.path.join(self.folder, "basis.h5"), "rb") as file:
            expected = hashlib.sha256(file.read()).hexdigest()
        self.assertEqual([one["sha256"] for one in inputs if one["option"] == "stick_modal_basis"], [expected])

    def test_a_run_that_did_not_end_has_the_hashes(self):
        """They are there before the first step, as sha256sum reads them; the file still repeats the run."""
        folder, summary = self.reduced()
        with open(os.path.join(folder, "resolved.yaml")) as file:
            lines = file.read().splitlines()
        told = [line[2:] for line in lines if re.match("# [0-9a-f]{64}  ", line)]
        self.assertEqual(told, [f"{one['sha256']}  {one['file']}" for one in summary["inputs"]])
        check = subprocess.run(["sha256sum", "--check", "--strict"], input="\n".join(told) + "\n", text=True,
                               cwd=program.SOURCE, capture_output=True)
        self.assertEqual(check.returncode, 0, check.stderr)
        self.assertIn(f"# Begun {summary['started']} by pounding {summary['version']} ({summary['commit']})", "\n".join(lines))
        again = program.must_run(self, ["-options_file", os.path.join(folder, "resolved.yaml")], 1)[1]
        self.assertEqual({**again["options"], "output": ""}, {**summary["options"], "output": ""})

    def test_a_name_with_a_line_end_adds_no_option(self):
        os.rename(os.path.join(self.folder, "record.txt"), os.path.join(self.folder, "a\nend_time: 9\n.txt"))
        folder, summary = program.must_run(self, ["-options_file", self.scene, "-motion_x_record",
                                                  os.path.join(self.folder, "a\nend_time: 9\n.txt")], 1)
        with open(os.path.join(folder, "resolved.yaml")) as file:
            self.assertNotIn("\nend_time: 9", file.read())
        self.assertEqual(summary["end_time"], 0.1)

    def test_versions_are_those_that_the_program_prints(self):
        printed = program.run(["--version"], 2).stdout.splitlines()
        summary = self.run_case()
        self.assertEqual(printed[0], f"pounding {summary['version']} ({summary['commit']})")
        self.assertEqual(printed[1:], [f"  {name} {version}" for name, version in summary["versions"].items()])
        self.assertTrue({"compiler", "MPI", "PETSc", "SLEPc", "MUMPS", "Gmsh", "METIS", "HDF5", "FFTW", "LibYAML"}
                        <= set(summary["versions"]))
        for name, version in summary["versions"].items():
            self.assertRegex(version, r"\d+\.\d+", name)

    def test_time_and_machine(self):
        before = datetime.datetime.now(datetime.timezone.utc).replace(microsecond=0)
        summary = self.run_case(ranks=2)
        started, ended = (datetime.datetime.strptime(summary[key], "%Y-%m-%dT%H:%M:%S%z") for key in ("started", "ended"))
        self.assertLessEqual(before, started)
        self.assertLessEqual(started, ended)
        self.assertLessEqual(ended, datetime.datetime.now(datetime.timezone.utc))
        self.assertEqual(summary["machine"]["names"], [os.uname().nodename])
        self.assertEqual(summary["machine"]["folder"], program.SOURCE)
        self.assertEqual(summary["ranks"], 2)

    def test_what_the_command_line_changed_is_said(self):
        self.assertEqual(self.run_case()["overrides"], {})
        folder = os.path.join(self.folder, "results")
        words = ["-options_file", self.scene, "-motion_x_pga", 2.5, "-end_time", 0.05, "-output", folder]
        result = program.must_end(self, words)
        self.assertIn("\nA post, 1 m\n  with end_time 0.05, motion_x_pga 2.5\n", result.stdout)
        self.assertEqual(program.summary(folder)["overrides"], {"end_time": "0.05", "motion_x_pga": "2.5"})

    def test_the_record_as_it_was_understood(self):
        motion = self.run_case()["motion"]["x"]
        self.assertAlmostEqual(motion["factor"], 5 / max(map(abs, SAMPLES)), delta=1e-14)
        scaled = 2 * numpy.array(SAMPLES)
        velocity = STEP * numpy.concatenate([[0], numpy.cumsum((scaled[1:] + scaled[:-1]) / 2)])
        moved = numpy.sum(STEP * velocity[:-1] + STEP**2 * (2 * scaled[:-1] + scaled[1:]) / 6)
        self.assertAlmostEqual(motion["end_velocity"], velocity[-1], delta=1e-14)
        self.assertAlmostEqual(motion["end_displacement"], moved, delta=1e-14)
        self.assertIn("no correction, straight lines", motion["treatment"])
        self.assertIn("band-limited resampling to 0.0005 s",
                      self.run_case("-resampling", "band_limited")["motion"]["x"]["treatment"])

    def test_materials_and_sections_have_their_numbers(self):
        post = self.run_case()["structures"]["stick"]["regions"]["post"]
        self.assertEqual(post["material"], {"name": "mine", "young": 2e11, "poisson": 0.25, "density": 7800})
        self.assertEqual((post["element"], post["section"]["name"]), ("beam", "heb120"))
        self.assertAlmostEqual(post["section"]["area"], 34.01e-4, delta=1e-5)  # EN 10365


if __name__ == "__main__":
    unittest.main()
