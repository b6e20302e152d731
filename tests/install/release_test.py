"""A release has one version everywhere, and the packages that docs/manual/install.md names are those that the workflow makes.
The package file for Spack has every library that CMake looks for, and hands CMake options that it has; Spack itself is
not needed: the file is run with words of its language that take notes."""
import re
import unittest
from pathlib import Path

import yaml

import program

PROCESSORS = 2  # it builds

TOP = Path(program.SOURCE)
PACKAGE = TOP / "packaging" / "spack" / "packages" / "pounding" / "package.py"
# Spack's names of the libraries that CMakeLists.txt and petsc.cmake name.
NAMES = {"MPI": "mpi", "PETSc": "petsc", "SLEPc": "slepc", "hdf5": "hdf5", "zlib": "zlib-api", "fftw3": "fftw", "yaml": "libyaml",
         "metis": "metis", "gmsh": "gmsh", "lapack": "lapack", "blas": "blas", "libcrypto": "openssl", "libseccomp": "libseccomp",
         "nlohmann_json": "nlohmann-json", "PkgConfig": "pkgconfig"}


class Notes:
    """The words of a package file that are used there."""

    def __init__(self):
        self.versions, self.needs, self.variants = [], {}, []

    def words(self):
        class CMakePackage:
            def define(self, name, value):
                return name

            def define_from_variant(self, name, variant):
                return name

        class When:
            def __init__(self, spec):
                self.spec = spec

            def __enter__(self):
                return self

            def __exit__(self, *why):
                return False

        def depends_on(spec, **more):
            name, _, rest = re.fullmatch(r"([\w-]+)((.*))", spec).groups()
            self.needs[name] = rest

        return {"CMakePackage": CMakePackage, "when": When, "depends_on": depends_on, "__name__": "package",
                "version": lambda name, **more: self.versions.append(name),
                "variant": lambda name, **more: self.variants.append(name),
                "license": lambda name: None, "requires": lambda spec, **more: None}


class Anything:
    """A spec with a prefix of every library."""
    prefix = "/prefix"

    def __getitem__(self, name):
        return self


class Release(unittest.TestCase):
    def test_downloads_are_those_that_the_workflow_makes(self):
        version = re.search(r"project\(pounding VERSION (\S+)", (TOP / "CMakeLists.txt").read_text())[1]
        self.assertIn(f"## {version}", (TOP / "CHANGELOG.md").read_text())
        jobs = yaml.safe_load((TOP / ".github" / "workflows" / "ci.yml").read_text())["jobs"]
        images = jobs["package"]["strategy"]["matrix"]["image"]
        self.assertEqual([one["image"] for one in jobs["installed"]["strategy"]["matrix"]["include"]], images)
        files = {f"pounding_{version}-{image.replace(':', '')}_amd64.deb" for image in images}
        page = (TOP / "docs" / "manual" / "install.md").read_text()
        self.assertEqual(set(re.findall(r"pounding_[\w.-]+_amd64\.deb", page)), files)
        self.assertLess(page.index("## Downloading"), page.index("## Building"))
        self.assertIn("installed", jobs["release"]["needs"])


class Spack(unittest.TestCase):
    def setUp(self):
        self.notes = Notes()
        words = self.notes.words()
        exec(compile(PACKAGE.read_text().replace("from spack.package import *", ""), str(PACKAGE), "exec"), words)
        self.package = words["Pounding"]()
        self.cmake = "".join((TOP / name).read_text() for name in ("CMakeLists.txt", "cmake/petsc.cmake", "cmake/vector_units.cmake"))

    def test_version_is_that_of_the_program(self):
        version = re.search(r"project\(pounding VERSION (\S+)", self.cmake)[1]
        self.assertEqual(self.notes.versions, ["main", version])

    def test_libraries_are_those_that_cmake_looks_for(self):
        found = re.findall(r"find_package\((\w+) REQUIRED|pkg_check_modules\(\w+ REQUIRED IMPORTED_TARGET (\w+)|"
                           r"find_library\(\w+ (\w+) REQUIRED|foreach\(library (\w+) (\w+)\)|IMPORTED_TARGET \w+-openmpi (\w+)\)",
                           self.cmake)
        wanted = {NAMES[name] for names in found for name in names if name}
        self.assertGreater(len(wanted), 13)
        self.assertLessEqual(wanted, self.notes.needs.keys())
        self.assertIn("~int64", self.notes.needs["petsc"])
        self.assertIn("+mumps", self.notes.needs["petsc"])
        least = re.search(r"cmake_minimum_required\(VERSION (\S+)\)", self.cmake)[1]
        self.assertIn(f"@{least}:", self.notes.needs["cmake"])

    def test_options_are_those_of_cmake(self):
        self.package.spec = Anything()
        for name in self.package.cmake_args():
            self.assertRegex(self.cmake, rf"(?:set|option)\({name} ")


if __name__ == "__main__":
    unittest.main()
