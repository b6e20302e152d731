"""PETSc and SLEPc of a prefix, or of sources with a build in them, are taken where PETSC_DIR, PETSC_ARCH and SLEPC_DIR
or PKG_CONFIG_PATH say so; one that will not do is refused when cmake configures. They are made of this machine's,
laid out and named as upstream does it."""
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import program

PROCESSORS = 2  # it builds


def of_this_machine(library):
    """Prefix of a library here."""
    return Path(subprocess.run(["pkg-config", "--variable=prefix", library], check=True, capture_output=True,
                               text=True).stdout.strip())


def lay_out(folder, library, configuration=lambda text: text):
    """A prefix of links to the headers and libraries of this machine, with LIBRARY.pc alone."""
    own = of_this_machine(library)
    for place in ("include", "lib"):
        (folder / place).mkdir(parents=True)
        for path in (own / place).iterdir():
            if path.name not in ("petscconf.h", "pkgconfig"):
                os.symlink(path.resolve(), folder / place / path.name)
    if library == "PETSc":
        text = (own / "include" / "petscconf.h").read_text()
        (folder / "include" / "petscconf.h").write_text(configuration(text))
    description = (own / "lib" / "pkgconfig" / f"{library}.pc").read_text()
    (folder / "lib" / "pkgconfig").mkdir()
    (folder / "lib" / "pkgconfig" / f"{library}.pc").write_text(
        re.sub(r"^prefix=.*$", f"prefix={folder}", description, flags=re.MULTILINE))
    return folder


class Petsc(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(prefix="pounding-petsc-")
        self.addCleanup(place.cleanup)
        self.here = Path(place.name).resolve()

    def configure(self, **variables):
        build = tempfile.mkdtemp(dir=self.here)
        done = subprocess.run(["cmake", "-S", program.SOURCE, "-B", build, "-G", "Ninja", "-DPOUNDING_TESTS=OFF",
                               "-DPOUNDING_UNITY=OFF"], capture_output=True, text=True, timeout=300, check=False,
                              env={**os.environ, **{name: str(value) for name, value in variables.items()}})
        return Path(build), done

    def takes(self, petsc, slepc, **variables):
        """What it configures compiles against theirs, and links them."""
        build, done = self.configure(**variables)
        self.assertEqual(done.returncode, 0, done.stderr)
        source = "CMakeFiles/pounding_core.dir/src/common/version.cpp.o"
        subprocess.run(["ninja", "-C", build, source], check=True, capture_output=True, timeout=300)
        ninja = (build / "build.ninja").read_text()
        link = re.search(r"^build pounding: .*\n(?:  .*\n)*", ninja, re.MULTILINE).group()
        compilation = re.search(rf"^build {source}: .*\n(?:  .*\n)*", ninja, re.MULTILINE).group()
        for library, prefix in (("PETSc", petsc), ("SLEPc", slepc)):
            self.assertIn(f"{prefix}/include", compilation)
            self.assertIn(f"{prefix}/lib/lib{library.lower()}", link)
            self.assertNotIn(str(of_this_machine(library)), compilation + link)

    def refuses(self, *parts, **variables):
        _, done = self.configure(**variables)
        self.assertNotEqual(done.returncode, 0)
        said = " ".join(done.stderr.split())
        for part in parts:
            self.assertIn(part, said)

    def test_of_a_prefix(self):
        petsc, slepc = lay_out(self.here / "petsc", "PETSc"), lay_out(self.here / "slepc", "SLEPc")
        self.takes(petsc, slepc, PETSC_DIR=petsc, SLEPC_DIR=slepc)
        self.takes(petsc, slepc, PKG_CONFIG_PATH=f"{petsc}/lib/pkgconfig:{slepc}/lib/pkgconfig")

    def test_of_sources_with_a_build_in_them(self):
        petsc = lay_out(self.here / "petsc" / "arch-opt", "PETSc")
        slepc = lay_out(self.here / "slepc" / "arch-opt", "SLEPc")
        self.takes(petsc, slepc, PETSC_DIR=petsc.parent, SLEPC_DIR=slepc.parent, PETSC_ARCH="arch-opt")
        self.refuses(f"{petsc.parent}/lib/pkgconfig has no PETSc.pc", "name a prefix without PETSC_ARCH",
                     PETSC_DIR=petsc.parent)

    def test_what_will_not_do_is_refused(self):
        for name, change, said in (
                ("long", lambda text: text + "#define PETSC_USE_64BIT_INDICES 1\n",
                 "configure it without --with-64-bit-indices"),
                ("complex", lambda text: text + "#define PETSC_USE_COMPLEX 1\n",
                 "not real numbers of double precision"),
                ("single", lambda text: text.replace("PETSC_USE_REAL_DOUBLE", "PETSC_USE_REAL_SINGLE"),
                 "not real numbers of double precision"),
                ("bare", lambda text: text.replace("PETSC_HAVE_MUMPS", "PETSC_HAVE_NONE"), "it lacks MUMPS")):
            with self.subTest(name):
                self.refuses(said, PETSC_DIR=lay_out(self.here / name, "PETSc", change))


if __name__ == "__main__":
    unittest.main()
