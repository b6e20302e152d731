"""run/distributions refuses what it cannot take, and says so where it may not make a system. What it makes takes an
hour and a mirror, and is tried by itself."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

COMMAND = Path(__file__).resolve().parents[2] / "run" / "distributions"


class Distributions(unittest.TestCase):
    def call(self, *words, start=(), **variables):
        return subprocess.run([*start, COMMAND, *words], capture_output=True, text=True, timeout=60, check=False,
                              env={**os.environ, **variables})

    def test_mistakes_are_one_line(self):
        for words, said in ((["--mirrors", "x"], "--mirrors: no such option"), (["--cache"], "--cache needs a value"),
                            (["Debian 13"], "no name of a suite"), (["../trixie"], "no name of a suite")):
            done = self.call(*words)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertRegex(done.stderr, rf"^run/distributions: .*{said}.*\n$")

    def test_it_is_skipped_where_it_may_not(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("bash", "dirname", "id"):
                os.symlink(shutil.which(name), Path(folder, name))
            done = self.call(PATH=folder)
            lacking = "debootstrap is not installed" if os.getuid() == 0 else "only root makes a system of its own"
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, f"run/distributions: skipped: {lacking}\n", ""))

    @unittest.skipUnless(os.getuid() == 0 and shutil.which("setpriv"), "needs root to become somebody else")
    def test_it_is_skipped_for_others_than_root(self):
        done = self.call(start=("setpriv", "--reuid", "65534", "--clear-groups"))
        if done.returncode == 127 or "Permission denied" in done.stderr:
            self.skipTest("the sources are root's alone")
        self.assertEqual((done.returncode, done.stdout),
                         (0, "run/distributions: skipped: only root makes a system of its own\n"), done.stderr)


if __name__ == "__main__":
    unittest.main()
