"""Phases of the start-up that take long say so, on any number of ranks, once."""
import re
import unittest

import program

CASE = ["-options_file", "petsc-options/plant/frames.yaml", "-end_time", "0.02", "-modes", 1, "-dry_run",
        "-a_mesh_set", "size=2,bays_x=4", "-b_mesh_set", "size=2,bays_x=3,x_offset=24.05,face_at_end=0"]
PHASES = ("a: mesh", "b: mesh", "a: lowest modes", "a: largest frequency and stable time step",
          "a: bounds of the gap rates")


def phases(text):
    """The phases that printed progress, and how many times each of them ended."""
    found = re.findall(r"^  (\S.*?): \d+\.\d s(?:, (?!done)[^,\n]+)?(, done)?$", text, re.MULTILINE)
    return {name: sum(1 for other, done in found if other == name and done) for name, _ in found}


class Progress(unittest.TestCase):
    def test_every_long_phase_says_so_once(self):
        for ranks in (1, 2):
            result = program.run(CASE + ["-progress_interval", "1e-5"], ranks)
            self.assertEqual(result.returncode, 0, result.stderr[-2000:])
            told = phases(result.stdout)
            for phase in PHASES:
                self.assertEqual(told.get(phase), 1, (ranks, phase, result.stdout[:4000]))
            self.assertRegex(result.stdout, r"a: largest frequency and stable time step: \d\.\d s, \d+ products")
            self.assertRegex(result.stdout, r"a: bounds of the gap rates: \d\.\d s, row \d+ of \d+")

    def test_short_phases_are_silent(self):
        result = program.run(CASE + ["-progress_interval", "1000"])
        self.assertEqual(result.returncode, 0, result.stderr[-2000:])
        self.assertEqual(phases(result.stdout), {})


if __name__ == "__main__":
    unittest.main()
