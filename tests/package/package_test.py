"""The Python package: scenes written and read back, runs, results as arrays, and its example."""
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

import program
import two_buildings
from two_buildings import pounding

PROCESSORS = 2  # runs on two ranks


class Scenes(unittest.TestCase):
    def setUp(self):
        self.place = Path(tempfile.mkdtemp(prefix="pounding-"))

    def test_what_is_written_is_what_the_program_reads(self):
        scene = {"include": two_buildings.SCENE, "title": 'quotes " and \\ back', "end_time": 0.01, "modes": 2,
                 "write_modes": True, "left": {"slabs": {"thickness": 0.2}}, "spectra_damping": [0.02, 0.05],
                 "loops": None}
        path = pounding.write_scene(self.place / "scene.yaml", scene)
        run = pounding.run(path, self.place / "out", ranks=2, folder=two_buildings.FOLDER)
        read = pounding.read_scene(self.place / "out" / "resolved.yaml")
        for name, text in pounding.flatten(scene).items():
            if name != "include":
                self.assertEqual(read[name], text, name)
        self.assertEqual(run.summary["options"]["left_slabs_thickness"], "0.2")
        self.assertEqual(sorted(set(run.spectra["damping"])), [0.02, 0.05])
        modes = pounding.load_modes(self.place / "out")
        self.assertEqual(modes["left"].shapes.shape, (2, 77, 6))
        self.assertAlmostEqual(modes["left"].frequencies[0],
                               run.summary["structures"]["left"]["frequencies"][0]["frequency"], delta=1e-9)

    def test_bad_scenes_are_one_line(self):
        for scene in ({"left": {"mesh": "a.geo"}, "left_mesh": "b.geo"}, {"two words": 1}, {"": 1}):
            with self.assertRaises(pounding.SceneError):
                pounding.write_scene(self.place / "scene.yaml", scene)

    def test_a_run_that_fails_says_what_the_program_said(self):
        for ranks in (1, 2):
            with self.assertRaisesRegex(pounding.RunError, "pounding: .*end_time"):
                two_buildings.launched(self.place / "bad", ranks, end_time=-1)


class Installed(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("pip") and importlib.util.find_spec("setuptools"), "no pip or setuptools here")
    @classmethod
    def setUpClass(cls):
        cls.place = place = Path(tempfile.mkdtemp(prefix="pounding-"))
        cls.addClassCleanup(shutil.rmtree, place)
        shutil.copytree(Path(program.SOURCE, "python"), place / "python",
                        ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
        subprocess.run([sys.executable, "-m", "pip", "install", "-q", "--no-build-isolation", "--no-deps", "--no-index",
                        "--target", place / "site", place / "python"], stdout=subprocess.DEVNULL, timeout=300, check=True)
        cls.variables = {name: value for name, value in os.environ.items() if name not in ("POUNDING_BUILD", "PYTHONPATH")
                         and not name.startswith(("OMP", "PMIX", "PRTE"))} | {"PYTHONPATH": str(place / "site")}

    def call(self, name, *words, **more):
        return subprocess.run([self.place / "site" / "bin" / name, *words], cwd=self.place, env={**self.variables, **more},
                              capture_output=True, text=True, timeout=300, check=False)

    def test_each_command_of_users_is_a_script_that_helps(self):
        scripts = sorted(path.name for path in (self.place / "site" / "bin").iterdir())
        commands = sorted(path.stem for path in Path(program.SOURCE, "python/pounding/commands").glob("[a-z]*.py"))
        self.assertEqual(scripts, sorted(f"pounding-{name}" for name in {*commands, "report"} - {"process"}))
        for name in scripts:
            with self.subTest(name):
                done = self.call(name, "--help")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn(f"usage: {name.replace('report', 'plot')} ", done.stdout)
                self.assertNotRegex(done.stdout, r"\brun/[a-z]")

    def test_commands_have_their_data(self):
        self.assertIn("pounding-new two-buildings DIR", self.call("pounding-new").stdout)
        done = self.call("pounding-new", "two-buildings", "mine")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual({path.name: path.read_bytes() for path in (self.place / "mine").iterdir()},
                         {path.name: path.read_bytes() for path in two_buildings.FOLDER.iterdir()})
        folder = self.place / "mine" / "out"
        two_buildings.launched(folder, gap=0.01, end_time=0.05, write_model=True)
        done = self.call("pounding-report", folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("<script", (folder / "report.html").read_text())
        done = self.call("pounding-plant", "--size", "small", POUNDING_BUILD=str(self.place))
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1))
        self.assertIn("pounding-plant: petsc-options/plant/small.yaml: neither in ", done.stderr)

    def test_it_is_installed_with_its_needs(self):
        place = self.place
        told = (place / "site" / "pounding-0.2.0.dist-info" / "METADATA").read_text()
        self.assertEqual(re.findall(r"Requires-Dist: (\w+)$", told, re.MULTILINE), ["h5py", "jinja2", "matplotlib", "numpy", "pyyaml", "scipy"])
        self.assertIn("VERSION 0.2.0 ", Path(program.SOURCE, "CMakeLists.txt").read_text())
        bin_folder = place / "bin"
        bin_folder.mkdir()
        (bin_folder / "pounding").write_text("#!/bin/sh\n")
        (bin_folder / "pounding").chmod(0o755)
        code = ("import pounding; from pounding import runs; print(pounding.__file__); print(pounding.program()); "
                "print(*sorted(name for name in runs.environment() if name.startswith(('OMP', 'PMIX', 'PRTE'))))")

        def said():
            return subprocess.run([sys.executable, "-c", code], cwd=place, capture_output=True, text=True, timeout=60, check=True,
                                  env={**self.variables, "PATH": f"{bin_folder}:{os.environ['PATH']}"}
                                  ).stdout.splitlines()

        places = [str(place / "site" / "pounding" / "__init__.py"), str(bin_folder / "pounding")]
        self.assertEqual(said(), [*places, "OMP_NUM_THREADS"])
        for top in (place / "share" / "pounding", place):  # of a prefix, of a tree in which the program was built
            (top / "run").mkdir(parents=True)
            shutil.copy(Path(program.SOURCE, "run", "environment"), top / "run")
            found = said()
            self.assertEqual(found[:2], places)
            self.assertIn("OMPI_MCA_ess_singleton_isolated", found[2].split())
            shutil.rmtree(top / "run")


class Results(unittest.TestCase):
    def test_frames_need_pandas_in_one_line(self):
        with mock.patch.dict(sys.modules, {"pandas": None}):
            with self.assertRaisesRegex(pounding.ResultError, "^to_frame needs pandas, which is not installed: .*$"):
                self.found.to_frame()

    def test_frames_have_what_the_arrays_have(self):
        frames = types.SimpleNamespace(DataFrame=lambda columns, index=None: (columns, index), Index=lambda values, name: (values, name))
        with mock.patch.dict(sys.modules, {"pandas": frames}):
            columns, index = self.found.to_frame()
            impacts, _ = self.found.to_frame("impacts")
            with self.assertRaisesRegex(pounding.ResultError, "no table 'roof'; there are history, "):
                self.found.to_frame("roof")
            with self.assertRaisesRegex(pounding.ResultError, "the run left no forces"):
                self.found.to_frame("forces")
        self.assertEqual((index[1], len(index[0])), ("time", len(self.found.history["time"])))
        np.testing.assert_array_equal(columns["acceleration left_roof.x"], self.found.series("acceleration", "left_roof", "x")[1])
        np.testing.assert_array_equal(columns["gap floor2"], self.found.history["gap"][:, self.found.contacts.index("floor2")])
        np.testing.assert_array_equal(impacts["impulse"], self.found.impacts["impulse"])

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="pounding-"))
        cls.found = two_buildings.launched(cls.folder, gap=0.01)

    def test_arrays_are_those_of_the_files(self):
        with h5py.File(self.folder / "history.h5") as file:
            names = [name.decode().strip("\0 ") for name in file["channels"][()]]
            column = file["acceleration"][:, names.index("left_roof.x")]
            stamps = file["time"][()] + file["acceleration"].attrs["time_offset"]
        time, values = self.found.series("acceleration", "left_roof", "x")
        np.testing.assert_array_equal(values, column)
        np.testing.assert_allclose(time, stamps, atol=1e-15)
        with open(self.folder / "summary.json") as file:
            self.assertEqual(self.found.summary, json.load(file))
        table = program.read_csv(self.folder / "impacts.csv")
        np.testing.assert_array_equal(self.found.impacts["impulse"], [float(text) for text in table["impulse"]])
        table = program.read_csv(self.folder / "spectra.csv")
        own = [float(value) for probe, way, value in zip(table["probe"], table["direction"],
                                                         table["pseudo_acceleration"]) if (probe, way) == ("left_roof", "x")]
        np.testing.assert_array_equal(self.found.spectrum("left_roof", "x")[1], own)

    def test_forces_are_those_of_the_files(self):
        with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
            run = two_buildings.launched(Path(folder), gap=0.01, end_time=0.05, forces="feet", feet_structure="left", csv_digits=17,
                                    feet_kind="reactions")
            with h5py.File(Path(folder, "history.h5")) as file:
                names = [name.decode().strip("\0 ") for name in file["forces"][()]]
                column = file["force"][:, names.index("feet.Fx")]
            time, values = run.force("feet.Fx")
            np.testing.assert_array_equal(values, column)
            self.assertEqual(len(time), len(values))
            self.assertEqual(abs(run.forces["peak"][run.forces["component"] == "Fx"]).max(), abs(values).max())
            self.assertRaises(pounding.ResultError, run.force, "feet.N")

    def test_what_is_not_there_is_told(self):
        for ask, words in ((self.found.spectrum, ("cellar", "x")), (self.found.spectrum, ("left_roof", "x", 0.07)),
                           (self.found.series, ("displacement", "cellar", "x"))):
            with self.assertRaisesRegex(pounding.ResultError, "left_roof"):
                ask(*words)
        with self.assertRaisesRegex(pounding.ResultError, "write_modes"):
            pounding.load_modes(self.folder)
        with self.assertRaisesRegex(pounding.ResultError, "not a folder"):
            pounding.load(self.folder / "nowhere")


class Example(unittest.TestCase):
    def test_gaps(self):
        with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
            script = os.path.join(program.SOURCE, "python", "examples", "gaps.py")
            done = subprocess.run([sys.executable, script, folder], capture_output=True, text=True, timeout=300,
                                  env={**os.environ, "POUNDING_BUILD": os.path.abspath(program.BUILD)}, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            rows = [line.split() for line in done.stdout.splitlines()[1:4]]
            counts = [int(row[1]) for row in rows]
            self.assertGreater(counts[0], counts[2])
            self.assertEqual(counts[2], 0)
            self.assertGreater(float(rows[0][4]), 2 * float(rows[2][4]), "impacts are felt at 100 Hz")
            self.assertGreater(float(rows[0][6]), 5 * float(rows[2][6]), "and by the slabs")
            self.assertTrue(Path(folder, "gaps.png").read_bytes().startswith(b"\x89PNG"))


if __name__ == "__main__":
    unittest.main()
