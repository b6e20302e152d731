"""octave/load_results.m reads what Python reads, where Octave is installed."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import program
import two_buildings

OCTAVE = shutil.which("octave-cli")


@unittest.skipUnless(OCTAVE, "Octave is not installed (apt-get install octave)")
class Octave(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="pounding-"))
        cls.found = two_buildings.run(cls.folder, gap=0.01, forces="feet", feet_structure="left", feet_kind="reactions")

    def octave(self, text, status=0):
        folder = os.path.join(program.SOURCE, "octave")
        done = subprocess.run([OCTAVE, "--no-gui", "-q", "--eval", f"addpath('{folder}'); {text}"], capture_output=True,
                              text=True, timeout=120, cwd=self.folder)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def values(self, expression):
        """A vector that Octave prints to the last digit."""
        said = self.octave(f"run = load_results('{self.folder}'); printf('%.17g\\n', {expression});").stdout
        return np.array(said.split(), dtype=float)

    def test_histories_are_those_of_python(self):
        for expression, expected in (
                ("run.time", self.found.history["time"]),
                ("run.of('displacement', 'left_roof.x')", self.found.series("displacement", "left_roof", "x")[1]),
                ("run.of('force', 'feet.Fx')", self.found.force("feet.Fx")[1]),
                ("run.of('gap', 'floor2')", self.found.history["gap"][:, 1]),
                ("run.ground_acceleration(:, 1)", self.found.history["ground_acceleration"][:, 0])):
            np.testing.assert_array_equal(self.values(expression), expected, expression)
        self.assertEqual(self.values("run.summary.time_step")[0], self.found.summary["time_step"])

    def test_spectra_are_those_of_python(self):
        both = self.values("cell2mat(nthargout(1:2, run.spectrum, 'left_roof', 'x', 0.05))")
        np.testing.assert_array_equal(both, np.concatenate(self.found.spectrum("left_roof", "x", 0.05)))

    def test_what_is_not_there_is_named(self):
        for text, said in ((f"load_results('{self.folder}').of('gap', 'roof')", "no column roof; there are floor1, floor2"),
                           (f"load_results('{self.folder}').of('link_force', 'a')", "no link_force in the history"),
                           (f"load_results('{self.folder}').spectrum('left_roof', 'x', 0.07)", "no spectrum of left_roof"),
                           ("load_results('nowhere')", "give the output folder of a run")):
            self.assertIn(said, self.octave(text, status=1).stderr)


if __name__ == "__main__":
    unittest.main()
