"""The table of pounding-spectra goes to where the shell points its standard output: behind what is
there, and never in silence to nowhere."""
import os
import subprocess
import tempfile
import unittest

from command import SPECTRA, frequencies, spectra, write_record


class StandardOutput(unittest.TestCase):
    def setUp(self):
        self.words = write_record(self, [0, 1, -1, 0.5], 0.01) + frequencies([1, 10])
        self.folder = tempfile.TemporaryDirectory(prefix="pounding-")
        self.addCleanup(self.folder.cleanup)
        self.path = os.path.join(self.folder.name, "all.csv")

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


if __name__ == "__main__":
    unittest.main()
