"""Commands of the project that are asked for help give it, from any folder, and do nothing else."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]


class Help(unittest.TestCase):
    def test_scripts_in_bash_say_what_they_do(self):
        scripts = [path for path in sorted((SOURCE / "run").iterdir()) if path.is_file() and os.access(path, os.X_OK)
                   and path.read_text().startswith("#!/usr/bin/env bash")]
        self.assertIn(SOURCE / "run" / "demo", scripts)
        for path in scripts:
            with self.subTest(path.name), tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([path, "--help"], cwd=folder, env={**os.environ, "POUNDING_BUILD": f"{folder}/build"},
                                      capture_output=True, text=True, timeout=60, check=False)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                line = path.read_text().splitlines()[1].lstrip("#\" ")
                self.assertEqual(done.stdout.splitlines()[0], line)
                self.assertNotIn("setup:", done.stdout)
                self.assertEqual(os.listdir(folder), [])


if __name__ == "__main__":
    unittest.main()
