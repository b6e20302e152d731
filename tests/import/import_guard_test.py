"""Files that were made, or damaged, so that a reader loses itself in them: one line that says so, and in no time."""
import importlib
import os
import resource
import subprocess
import sys
import time
import unittest

import imported
from import_losses_test import ABAQUS, ANSYS, DYNA, NASTRAN
from imported import refused

from pounding import UserError

DECKS = {"model.inp": (ABAQUS, "** {}\n"), "model.bdf": (NASTRAN, "$ {}\n"), "model.cdb": (ANSYS, "! {}\n"),
         "model.k": (DYNA, "$ {}\n")}
# Letters that str.splitlines takes for the end of a line, and a card behind each that would hold all nodes.
ENDS = ("\x85", "\x0c", "\x1c", "\x1d", "\x1e", "\x0b")
SUPPORTS = {"model.inp": "*BOUNDARY{}3, 1, 6", "model.bdf": "SPC1,1,123456,3", "model.cdb": "D,3,ALL",
            "model.k": "*BOUNDARY_SPC_NODE{}         3         0         1         1         1         1         1         1"}


class Guard(unittest.TestCase):
    def test_comments_end_where_lines_do(self):
        """A deck as Windows and editors leave it: the words behind such a letter are a comment still."""
        for name, (deck, comment) in DECKS.items():
            plain = imported.imported(self, name, deck)[1]
            for end in ENDS:
                with self.subTest(name, end=end):
                    text = deck + comment.format(f"the top is held{end}{SUPPORTS[name].format(end)}")
                    said = imported.imported(self, name, text.encode("latin-1"))[1]
                    self.assertEqual(self.told(said), self.told(plain))

    @staticmethod
    def told(said):
        return [line for line in said.split("\n") if line.startswith(("read", "supported", "mass"))]

    def test_files_that_are_no_files(self):
        path = imported.of_file("model.inp", ABAQUS + "*INCLUDE, INPUT=more.inp\n")
        more = path.with_name("more.inp")
        os.mkfifo(more)
        for target, part in ((None, "no file with contents"), ("/dev/zero", "no file with contents"), ("/tmp",
                                                                                                      "no file with")):
            if target:
                more.unlink(missing_ok=True)
                more.symlink_to(target)
            done = imported.command(path, "m,kg,s")
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1))
            self.assertIn(part, done.stderr)
        refused(self, "model.inp", ABAQUS + f"*INCLUDE, INPUT={'x' * 5000}\n", "file name too long")

    def test_files_that_include_the_next_twice(self):
        path = imported.of_file("model.inp", ABAQUS + "*INCLUDE, INPUT=0.inp\n")
        for at in range(22):
            path.with_name(f"{at}.inp").write_text(f"*INCLUDE, INPUT={at + 1}.inp\n" * 2)
        path.with_name("22.inp").write_text("** nothing\n")
        begun = time.monotonic()
        done = imported.command(path, "m,kg,s")
        self.assertLess(time.monotonic() - begun, 10)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1))
        self.assertIn("more than 1000 files are included", done.stderr)

    def test_words_without_end(self):
        long = "1" * 5000
        begun = time.monotonic()
        for name, text, part in (
                ("model.inp", ABAQUS + f"*BOUNDARY\n{long}, 1\n", "node set 1111"),
                ("model.inp", ABAQUS + f"*NODE\n9, {long}, 0., 0.\n", "is not a number"),
                ("model.inp", ABAQUS + f"*NODE\n{long}, 0., 0., 0.\n", "is not a whole number"),
                ("model.inp", ABAQUS + "*NODE\n\xb2, 0., 0., 0.\n", "is not a whole number"),
                ("model.inp", ABAQUS + "*NODE\n9, 1_0, 0., 0.\n", "'1_0' is not a number"),
                ("model.inp", ABAQUS + "*BOUNDARY\n\xb2, 1\n", "node set \xb2 is not in the deck"),
                ("model.inp", ABAQUS + f"** {'a' * 100000}\n", "letters in a line"),
                ("model.cdb", ANSYS + f"ET,9,{long}\n", "names no element"),
                ("model.cdb", ANSYS + "ET,9,\xb2\n", "names no element"),
                ("model.cdb", ANSYS + f"NBLOCK,6,SOLID,9,9\n({long}i9)\n", "a format of"),
                ("model.cdb", ANSYS + "MP,DENS,9,\xb2\n", "is not a number"),
                ("model.k", DYNA + f"*ELEMENT_MASS\n{'9,1,' + long}\n", "is not a number"),
                ("model.k", DYNA + "*ELEMENT_MASS\n9,1e30,5.\n", "is not a whole number"),
                ("model.bdf", NASTRAN + "RBE2,9,1,123456,1,THRU,99999999\n", "a list of 99999999 numbers"),
                ("model.bdf", NASTRAN + f"CONM2,9,3,,{long}\n", "is not a number")):
            with self.subTest(name, part=part):
                refused(self, name, text.encode("latin-1"), part)
        self.assertLess(time.monotonic() - begun, 20)

    def test_names_do_not_move_the_cursor(self):
        refused(self, "model.inp", ABAQUS + "*BOUNDARY\nA\x1b[2J, 1\n", "node set A\\x1b[2J is not in the deck")

    def test_merges_of_a_study_that_double(self):
        """700 letters of YAML that are 16 million merged keys, and brackets without end."""
        study = importlib.import_module("pounding.fragility.study_file")
        merges = "a0: &a0 {x: 1}\n" + "".join(f"a{k + 1}: &a{k + 1}\n  <<: [*a{k}, *a{k}]\n" for k in range(24))
        for text, part in ((merges, "more than 10000 merged keys"), ("[" * 100000, "recursion")):
            begun = time.monotonic()
            with self.assertRaisesRegex(UserError, part):
                study.load(imported.of_file("study.yaml", text))
            self.assertLess(time.monotonic() - begun, 8)

    def test_ranges_stay_ranges(self):
        """Of a hundred million numbers, in the memory of a small deck."""
        rows = {"model.inp": "*NSET, NSET=ALL, GENERATE\n1, 99999999, 1\n*BOUNDARY\nALL, 1, 6\n",
                "model.cdb": "CMBLOCK,ALL,NODE,2\n(8i10)\n         1 -99999999\nD,ALL,ALL\n",
                "model.k": "*SET_NODE_LIST_GENERATE\n         7\n         1  99999999\n*BOUNDARY_SPC_SET\n" + "".join(
                    f"{value:10d}" for value in (7, 0, 1, 1, 1, 1, 1, 1)) + "\n"}
        for name, more in rows.items():
            with self.subTest(name):
                before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
                said = imported.imported(self, name, DECKS[name][0] + more)[1]
                self.assertIn("supported nodes 3", said)
                self.assertLessEqual(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, max(before, 600_000))

    def test_a_shell_section_without_numbers(self):
        shell = ("ET,9,181\nNBLOCK,6,SOLID,9,1\n(3i9,6e21.13e3)\n        9        0        0 1.0000000000000E+000\n"
                 "N,R5.3,LOC,       -1,\nEBLOCK,19,SOLID,1,1\n(19i9)\n" + "".join(
                     f"{value:9d}" for value in (1, 9, 1, 9, 0, 0, 0, 0, 4, 0, 9, 1, 2, 3, 9)) + "\n       -1\n"
                 "SECTYPE,9,SHELL\nSECDATA\n")
        refused(self, "model.cdb", ANSYS + shell, "a layer without thickness")

    def test_an_interrupt_before_it_has_begun(self):
        """At any time after the first line of the command: one line, status 1."""
        path = imported.of_file("model.inp", ABAQUS)
        script = ("import os, signal, sys, time\nsys.argv = ['COMMAND', 'FILE', 'OUT', '--units', 'm,kg,s']\n"
                  f"sys.path.insert(0, {str(imported.COMMAND.parent)!r})\nimport parts\n"
                  "from pounding import commands\ncommands.leave_when_interrupted('import')\n"
                  "wait = float(os.environ['WAIT'])\nif os.fork() == 0:\n    time.sleep(wait)\n"
                  "    os.kill(os.getppid(), signal.SIGINT)\n    os._exit(0)\n"
                  "import runpy\nrunpy.run_path(sys.argv[0], run_name='__main__')\n")
        script = script.replace("COMMAND", str(imported.COMMAND)).replace("FILE", str(path)).replace(
            "OUT", str(path.parent / "out") + "' + os.environ['WAIT'] + '")
        seen = set()
        for wait in (0.0, 0.02, 0.05, 0.08):
            done = subprocess.run([sys.executable, "-c", script], env={**os.environ, "WAIT": str(wait)}, text=True,
                                  capture_output=True, check=False, timeout=60)
            seen.add((done.returncode, done.stderr))
        self.assertLessEqual(seen, {(1, "run/import: interrupted\n"), (0, "")})
        self.assertIn((1, "run/import: interrupted\n"), seen)


if __name__ == "__main__":
    unittest.main()
