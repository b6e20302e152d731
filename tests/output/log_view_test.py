"""PETSc's -log_view tells the five lines of a step by their names, with as many calls as there were steps."""
import re
import tempfile
import unittest

import program

LINES = ("detect_contact", "free_velocity", "solve_impulse", "correct_velocity", "close_energy")
CASE = program.COARSE_PAIR + ["-motion_x_pga", "6", "-motion_x_envelope", "0.2,20", "-floor2_gap", 0,
                              "-floor1_gap", 0, "-end_time", "0.02", "-modes", 0, "-log_view"]
TIMED = 50  # steps that a run makes to tell its time


class LogView(unittest.TestCase):
    def test_the_lines_of_a_step_are_events(self):
        for ranks in (1, 2):
            folder = self.enterContext(tempfile.TemporaryDirectory())
            result = program.must_end(self, CASE + ["-output", folder], ranks)
            steps = program.summary(folder)["steps"] + 1  # t_0 is one too
            calls = {name: re.search(rf"^{name[:16]}\S* +(\d+) ", result.stdout, re.MULTILINE) for name in LINES}
            for name, found in calls.items():
                self.assertIsNotNone(found, f"{name} on {ranks} ranks\n" + result.stdout[-6000:])
            calls = {name: int(found.group(1)) for name, found in calls.items()}
            self.assertEqual(calls["free_velocity"], steps + TIMED)
            self.assertEqual(calls["close_energy"], steps + TIMED)
            self.assertGreater(calls["solve_impulse"], 0)
            self.assertEqual(calls["solve_impulse"], calls["correct_velocity"])
            self.assertGreaterEqual(calls["detect_contact"], calls["solve_impulse"])


if __name__ == "__main__":
    unittest.main()
