"""What `cmake --install` leaves works from any folder: programs, shipped scenes, tools, the Python package."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy

import program

PROCESSORS = 2  # it builds

COARSE = ["-s1_mesh_set", "cells_x=7,cells_y=5,column_elements=2", "-s2_mesh_set",
          "cells_x=5,cells_y=5,column_elements=2", "-end_time", "0.02", "-modes", "1", "-spectra_frequencies", "10,20"]
DEMO = os.path.join("petsc-options", "azalee", "demo.yaml")


def install(prefix, **variables):
    subprocess.run(["cmake", "--install", program.BUILD, "--prefix", prefix], check=True, capture_output=True,
                   env={**os.environ, **variables})


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory(prefix="pounding-")
        cls.addClassCleanup(place.cleanup)
        cls.prefix = Path(place.name).resolve() / "some where"
        install(cls.prefix)
        cls.share = cls.prefix / "share" / "pounding"
        # As a user's: nothing that says where the sources or the build are.
        cls.variables = {name: value for name, value in program.ENVIRONMENT.items()
                         if name not in ("POUNDING_BUILD", "PYTHONPATH")}

    def setUp(self):
        place = tempfile.TemporaryDirectory(prefix="pounding-")
        self.addCleanup(place.cleanup)
        self.here = Path(place.name)

    def call(self, *words, status=0, **variables):
        done = subprocess.run([str(word) for word in words], cwd=self.here, env={**self.variables, **variables},
                              capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, status, done.stdout[-2000:] + done.stderr[-2000:])
        return done

    def tool(self, *words, **options):
        return self.call(self.prefix / "bin" / "pounding-tools", *words, **options)

    def test_a_shipped_scene_runs_elsewhere_as_it_does_in_the_sources(self):
        for ranks in (1, 2):
            self.call("mpirun", "-n", ranks, self.prefix / "bin" / "pounding", "-options_file", self.share / DEMO, *COARSE,
                      "-partition", "elements", "-output", f"mine-{ranks}")
            folder, _ = program.must_run(self, ["-options_file", DEMO, *COARSE], ranks)
            self.addCleanup(shutil.rmtree, folder)
            with h5py.File(self.here / f"mine-{ranks}" / "history.h5") as mine, \
                    h5py.File(os.path.join(folder, "history.h5")) as own:
                self.assertTrue(numpy.array_equal(mine["displacement"][()], own["displacement"][()]))
        self.tool("plot", "mine-2")
        self.assertTrue((self.here / "mine-2" / "report.html").exists())
        self.tool("compare", "mine-1", "mine-2")
        self.assertTrue((self.here / "comparison" / "comparison.html").exists())

    def test_every_shipped_scene_finds_its_files(self):
        found = 0
        for scene in self.share.glob("petsc-options/*/*.yaml"):
            for name in re.findall(r"^[^#\n]*\b(?:include|mesh|target|record): ([^\s,}]+)", scene.read_text(), re.MULTILINE):
                self.assertTrue((scene.parent / name).is_file(), f"{scene}: {name}")
                found += 1
        self.assertGreater(found, 40)

    def test_tools_are_named_and_say_what_they_cannot(self):
        listed = self.tool().stdout.split()
        self.assertEqual(listed[1::2], ["column", "compare", "fragility", "import", "incoherent", "law", "match", "new", "plant", "plot", "seal", "section", "shake",
                                        "soil", "spans", "stability", "struck", "sweep", "tradeoff"])
        for name in listed[1::2]:
            said = self.tool(name, "--help").stdout
            self.assertIn(f"pounding-tools {name}", said)
            self.assertNotRegex(said, r"\brun/[a-z]")
        self.assertTrue(self.tool("plot", "nowhere", status=1).stderr.startswith("pounding-tools plot: "))
        self.assertIn("pounding-tools new two-buildings DIR", self.tool("new").stdout)
        self.assertIn("no tool plott", self.tool("plott", status=1).stderr)
        self.assertIn("no tool ../x", self.tool("../x", status=1).stderr)
        environment = self.tool("environment").stdout.strip()
        self.call("bash", "-c", f"source '{environment}' && test -n \"$OMP_NUM_THREADS\"")

    def test_a_new_scene_is_run_with_the_installed_program(self):
        said = self.tool("new", "two-buildings", ".").stdout
        self.assertIn(str(self.prefix / "bin" / "pounding"), said)
        self.assertIn(str(self.share / "run" / "environment"), said)
        self.tool("sweep", "two-buildings.yaml", "--set", "end_time=0.01,0.02", "--out", "ends", "--ranks", 2)
        self.assertTrue((self.here / "ends" / "sweep.csv").exists())

    def test_python_finds_package_and_program(self):
        modules = self.prefix / "lib" / "python3" / "dist-packages"
        text = ("import pounding; print(pounding.program()); "
                f"run = pounding.run({str(self.share / DEMO)!r}, 'py', ranks=2, "
                f"**dict(zip([w[1:] for w in {COARSE[::2]!r}], {COARSE[1::2]!r}))); print(len(run.history['time']))")
        lines = self.call("/usr/bin/python3", "-c", text, PYTHONPATH=str(modules)).stdout.split("\n")
        self.assertEqual(lines[0], str(self.prefix / "bin" / "pounding"))
        self.assertGreater(int(lines[1]), 100)

    def test_manual_and_completion_are_where_man_and_bash_look(self):
        manual = self.prefix / "share" / "man" / "man1"
        self.assertEqual(sorted(path.name for path in manual.iterdir()), ["pounding-mesh.1", "pounding-spectra.1", "pounding.1"])
        completions = self.prefix / "share" / "bash-completion" / "completions"
        self.assertEqual(sorted(path.name for path in completions.iterdir()), ["pounding", "pounding-spectra"])

    def test_nothing_points_to_the_build(self):
        for name in ("pounding", "pounding-mesh", "pounding-spectra"):
            self.assertNotIn("not found", self.call("ldd", self.prefix / "bin" / name).stdout)
            headers = subprocess.run(["readelf", "-d", self.prefix / "bin" / name], capture_output=True, text=True).stdout
            self.assertNotIn("RUNPATH", headers)
        for path in self.prefix.rglob("*"):
            self.assertNotIn(path.suffix, (".pyc", ".o"), path)
            if path.is_symlink():
                self.assertTrue(path.resolve().is_relative_to(self.prefix), path)
                self.assertTrue(path.exists(), path)


class Staged(unittest.TestCase):
    def test_destdir_is_the_root_of_everything(self):
        with tempfile.TemporaryDirectory(prefix="pounding-") as root:
            install("/usr", DESTDIR=root)
            modules = Path(root, "usr/lib/python3/dist-packages/pounding")
            self.assertTrue(modules.is_symlink())
            self.assertTrue((modules / "runs.py").exists())
            self.assertEqual(os.listdir(root), ["usr"])


class Setup(unittest.TestCase):
    """run/setup hands its options to cmake each time, not the first time only."""

    def units(self, build, *words):
        subprocess.run([os.path.join(program.SOURCE, "run", "setup"), *words], check=True, capture_output=True,
                       env={**os.environ, "POUNDING_BUILD": build, "POUNDING_TARGETS": "help"})
        cache = Path(build, "CMakeCache.txt").read_text()
        return re.search(r"^POUNDING_VECTOR_UNITS:STRING=(.*)$", cache, re.MULTILINE)[1]

    def test_options_count_after_the_first_time(self):
        with tempfile.TemporaryDirectory(prefix="pounding-") as build:
            every = self.units(build, "-DPOUNDING_TESTS=OFF")
            self.assertEqual(self.units(build, "-DPOUNDING_VECTOR_UNITS=v3"), "v3")
            self.assertEqual(self.units(build), "v3")
            self.assertEqual(self.units(build, f"-DPOUNDING_VECTOR_UNITS={every}"), every)


if __name__ == "__main__":
    unittest.main()
