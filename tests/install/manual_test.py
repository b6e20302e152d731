"""Man pages and completion for bash have every option that the programs know, and are well formed."""
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import program

MANUAL = Path(program.SOURCE) / "packaging" / "manual.py"


def said(name):
    return subprocess.run([Path(program.BUILD) / name, "-help"], env=program.ENVIRONMENT, capture_output=True, text=True,
                          check=True).stdout


def make(build, folder):
    return subprocess.run([MANUAL, build, "1.2.3", folder], env=program.ENVIRONMENT, capture_output=True, text=True, check=True)


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory(prefix="pounding-manual-")
        cls.addClassCleanup(place.cleanup)
        cls.folder = Path(place.name)
        make(program.BUILD, cls.folder)

    def complete(self, *words, function="_pounding"):
        line = (f"source '{self.folder}/pounding'; COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); {function}; "
                "printf '%s\\n' \"${COMPREPLY[@]}\"")
        return subprocess.run(["bash", "-c", line, "bash", *words], capture_output=True, text=True, check=True).stdout.split()

    def page(self, name):
        return (self.folder / f"{name}.1").read_text().replace("\\-", "-")

    def test_every_option_is_in_the_pages(self):
        for name, pattern, least in (("pounding", r"^  (-\S+) +\[", 200), ("pounding-spectra", r"^  (--\S+)", 20)):
            options = re.findall(pattern, said(name), re.MULTILINE)
            self.assertGreater(len(options), least)
            page = self.page(name)
            for option in options:
                self.assertIn(f".TP\n\\fB{option}\\fR", page)
            self.assertIn("pounding 1.2.3", page)
        self.assertIn("starts it", self.page("pounding-mesh"))

    def test_troff_finds_no_fault(self):
        if shutil.which("groff") is None:
            self.skipTest("groff is not installed")
        for name in ("pounding", "pounding-mesh", "pounding-spectra"):
            page = self.folder / f"{name}.1"
            done = subprocess.run(["groff", "-man", "-Tascii", "-ww", "-rCHECKSTYLE=1", page], capture_output=True, text=True, check=True)
            self.assertEqual(done.stderr, "")
            self.assertIn("SEE ALSO", re.sub(r"\x1b\[\d*m|.\x08", "", done.stdout))

    def test_words_are_completed(self):
        self.assertEqual(self.complete("pounding", "-dry"), ["-dry_run"])
        self.assertEqual(self.complete("pounding", "-options_f"), ["-options_file"])
        self.assertEqual(self.complete("pounding", "-partition", ""), ["auto", "elements", "structures"])
        self.assertEqual(self.complete("pounding", "-dry_run", "t"), ["true"])
        self.assertEqual(self.complete("pounding", "-left_slab_elem"), ["-left_slab_element"])
        self.assertIn("-left_mesh_set", self.complete("pounding", "-left_mesh"))
        self.assertEqual(self.complete("pounding", "-no_such"), [])
        self.assertIn("--envelope", self.complete("pounding-spectra", "--en", function="_pounding_spectra"))

    def test_programs_of_another_machine_leave_a_word_and_no_page(self):
        with tempfile.TemporaryDirectory(prefix="pounding-manual-") as folder:
            for name in ("pounding", "pounding-spectra"):
                script = Path(folder, name)
                script.write_text("#!/bin/sh\nexit 1\n")
                script.chmod(0o755)
            done = make(folder, Path(folder, "made"))
            self.assertIn("pounding does not run here: no man pages", done.stderr)
            self.assertEqual([path.name for path in Path(folder, "made").iterdir()], ["made"])


if __name__ == "__main__":
    unittest.main()
