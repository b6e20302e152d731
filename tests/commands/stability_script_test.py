"""run/stability: its table says for each case what is expected, what was seen, and the verdict."""
import csv
import os
import tempfile
import unittest

import program

PROCESSORS = 2  # it starts runs


def stability(*words):
    return program.command("stability", *words)


class Stability(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-")
        cls.result = stability("--quick", "--only", "mass_ratio", "--only", "one_element", "--only", "time_step",
                               "--only", "switching_bars", "--only", "passive_devices",
                               "--only", "contact_rows",
                               "--output", cls.folder)
        with open(os.path.join(cls.folder, "stability.csv"), newline="") as file:
            cls.rows = list(csv.DictReader(file))

    def sweep(self, name):
        return [row for row in self.rows if row["sweep"] == name]

    def test_ends_well_and_leaves_table_and_figure(self):
        self.assertEqual(self.result.returncode, 0, self.result.stdout + self.result.stderr)
        self.assertIn(f"{len(self.rows)} cases, 0 not as expected", self.result.stdout)
        with open(os.path.join(self.folder, "stability.png"), "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        with open(os.path.join(self.folder, "stability.md")) as file:
            lines = file.read().splitlines()
        self.assertEqual(len(lines), 2 + len(self.rows))
        self.assertEqual(len({line.count("|") for line in lines}), 1)

    def test_cases_within_their_limits(self):
        self.assertEqual(len(self.sweep("one element")), 5)
        self.assertEqual(len(self.sweep("mass ratio")), 3)
        for row in self.sweep("one element") + self.sweep("mass ratio"):
            self.assertEqual((row["outcome"], row["verdict"]), ("runs", "as expected"), row)
            self.assertLessEqual(float(row["measure"]), float(row["limit"]), row)

    def test_what_can_only_take_energy_gives_none(self):
        self.assertEqual(len(self.sweep("switching bars")), 8)
        self.assertEqual(len(self.sweep("passive devices")), 5)
        for row in self.sweep("switching bars") + self.sweep("passive devices"):
            self.assertEqual((row["outcome"], row["verdict"]), ("runs", "as expected"), row)

    def test_rows_of_contacts_that_are_there_twice_change_nothing(self):
        rows = self.sweep("contact rows")
        self.assertEqual(len(rows), 5)
        for row in rows:
            self.assertEqual((row["outcome"], row["verdict"]), ("runs", "as expected"), row)
            self.assertLessEqual(float(row["measure"]), 2e-9, row)
            self.assertIn("32 rows, 32 of them coupled", row["seen"])

    def test_end_of_the_method_is_told(self):
        *below, above, unasked = self.sweep("time step")
        self.assertTrue(all(row["outcome"] == "runs" for row in below))
        self.assertEqual((above["outcome"], above["verdict"]), ("stopped", "as expected"))
        self.assertIn("diverged", above["seen"])
        self.assertEqual((unasked["outcome"], unasked["verdict"]), ("refused", "as expected"))

    def test_refuses_a_sweep_that_is_not_there(self):
        result = stability("--only", "weather")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("slivers", result.stderr)


if __name__ == "__main__":
    unittest.main()
