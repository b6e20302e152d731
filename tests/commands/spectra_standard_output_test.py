"""The table of pounding-spectra goes to where the shell points its standard output: behind what is
there, and never in silence to nowhere. Words that nobody reads end alone, and not a program or command."""
import os
import shutil
import subprocess
import tempfile
import unittest

import program
from spectra_command import SPECTRA, frequencies, spectra, write_record


class StandardOutput(unittest.TestCase):
    def setUp(self):
        self.words = write_record(self, [0, 1, -1, 0.5], 0.01) + frequencies([1, 10])
        self.folder = tempfile.mkdtemp(prefix="pounding-")
        self.path = os.path.join(self.folder, "all.csv")

    def shell(self, line):
        return subprocess.run(["bash", "-c", line, SPECTRA, *self.words], capture_output=True, text=True, timeout=60)

    def rows(self):
        with open(self.path) as file:
            lines = file.read().splitlines()
        return lines, [line for line in lines if line[:1] not in "#" and not line.startswith("probe,")]

    def test_appends_to_a_file(self):
        with open(self.path, "w") as file:
            file.write("# what was there\n")
        for words in ("", "--output /dev/stdout"):
            self.assertEqual(self.shell(f'"$0" "$@" {words} >> {self.path}').returncode, 0)
        lines, rows = self.rows()
        self.assertEqual(lines[0], "# what was there")
        self.assertEqual(len(rows), 4)

    def test_two_in_a_group_follow_each_other(self):
        self.assertEqual(self.shell(f'{{ "$0" "$@"; echo "# between"; "$0" "$@"; }} > {self.path}').returncode, 0)
        lines, rows = self.rows()
        self.assertEqual(len(rows), 4)
        self.assertEqual(lines.index("# between"), len(lines) // 2)
        self.assertEqual(rows[:2], rows[2:])

    def test_two_tables_do_not_share_it(self):
        for words in (["--peaks", "/dev/stdout"], ["--peaks", self.path, "--output", self.path]):
            result = spectra(*self.words, *words)
            self.assertEqual((result.returncode, result.stdout), (1, ""))
            self.assertIn("--peaks", result.stderr)

    def test_full_disk_is_an_error(self):
        for line in ('"$0" "$@" > /dev/full', '"$0" "$@" --output /dev/full', '"$0" --help > /dev/full'):
            result = self.shell(line)
            self.assertEqual(result.returncode, 1, line)
            if "--help" not in line:
                self.assertIn("could not be written completely", result.stderr)


    def test_an_unread_table_leaves_the_other_whole(self):
        impacts = os.path.join(self.folder, "impacts.csv")
        with open(impacts, "w") as file:
            file.write("contact,start,end\nroof,0.005,0.015\n")
        words = ["--treatment", "all", "--impacts", impacts, "--dirac-step", "0.001", "--peaks", self.path]
        reading, writing = os.pipe()
        os.close(reading)
        result = subprocess.run([SPECTRA, *self.words, *words], stdout=writing, stderr=subprocess.PIPE, timeout=60)
        os.close(writing)
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        with open(self.path) as file:
            self.assertTrue(file.readline().startswith("probe,direction,"))

    def test_a_closed_one_is_an_error(self):
        result = self.shell('"$0" "$@" >&-')
        self.assertEqual(result.returncode, 1)
        self.assertIn("could not be written completely", result.stderr)

    def test_a_limit_of_sizes_leaves_no_table(self):
        result = self.shell(f'ulimit -f 0; "$0" "$@" --output {self.path}')
        self.assertEqual(result.returncode, 1)
        self.assertIn("all.csv: could not be written completely", result.stderr)
        self.assertFalse(os.path.exists(self.path))


class Commands(unittest.TestCase):
    def test_go_on_where_nobody_reads(self):
        command = os.path.join(program.SOURCE, "run", "new")
        for line in ('"$0" two-buildings "$1" >&-', '"$0" two-buildings "$1" 2>&1 >&- | cat',
                     '{ sleep 0.3; "$0" two-buildings "$1"; echo $? > "$1/status"; } | true'):
            folder = os.path.join(tempfile.mkdtemp(prefix="pounding-"), "mine")
            result = subprocess.run(["bash", "-c", line, command, folder], capture_output=True, text=True, timeout=60)
            self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""), line)
            self.assertTrue(os.path.exists(os.path.join(folder, "two-buildings.yaml")))
        with open(os.path.join(folder, "status")) as file:
            self.assertEqual(file.read(), "0\n")


class Names(unittest.TestCase):
    def test_a_record_named_as_a_formula_is_a_text(self):
        """A spreadsheet would run it; a number is left alone."""
        record, *words = write_record(self, [0, 1, -1, 0.5], 0.01) + frequencies([1, 10])
        folder = tempfile.mkdtemp(prefix="pounding-")
        for name, told in (("=1+1", "'=1+1"), ("-x|1", "'-x|1"), ("@x", "'@x"), ("-0.5", "-0.5"), ("a=1", "a=1")):
            path = shutil.copy(record, os.path.join(folder, name + ".txt"))
            self.assertEqual(spectra(path, *words).stdout.splitlines()[1].split(",")[0], told)


class OutputFiles(unittest.TestCase):
    """Nothing but an earlier table gives way to a new one."""

    def setUp(self):
        self.words = write_record(self, [0, 1, -1, 0.5], 0.01) + frequencies([1, 10])
        self.folder = tempfile.mkdtemp(prefix="pounding-")

    def refuse(self, path, words=(), option="--output"):
        with open(path, "rb") as file:
            before = file.read()
        result = spectra(*self.words, *words, option, path)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertIn(f"{option} {path}", result.stderr)
        with open(path, "rb") as file:
            self.assertEqual(file.read(), before)

    def test_what_it_reads_or_what_is_no_table_stays(self):
        link = os.path.join(self.folder, "link.csv")
        os.symlink(self.words[0], link)
        notes = os.path.join(self.folder, "history.h5")
        with open(notes, "wb") as file:
            file.write(b"\x89HDF\r\n\x1a\n" + bytes(3000))
        peaks = ["--output", os.path.join(self.folder, "out.csv"), "--treatment", "all"]
        for path in (self.words[0], link, notes):
            self.refuse(path)
            self.refuse(path, peaks, "--peaks")

    def test_an_earlier_table_is_replaced_and_a_link_to_one(self):
        path, link = os.path.join(self.folder, "out.csv"), os.path.join(self.folder, "link.csv")
        for _ in range(2):
            self.assertEqual(spectra(*self.words, "--output", path).returncode, 0)
        with open(path) as file:
            before = file.read()
        os.symlink(path, link)
        self.assertEqual(spectra(*self.words, "--damping", 0.1, "--output", link).returncode, 0)
        self.assertFalse(os.path.islink(link))
        with open(path) as file:
            self.assertEqual(file.read(), before)


if __name__ == "__main__":
    unittest.main()
