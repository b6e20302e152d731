"""run/tables: runs Models A and B through the program and sets Table 1 and the time step of Ambiel
et al. (Eng. Struct. 251, 2022) beside ours; the figures must be those of the summaries that it left."""
import json
import os
import tempfile
import unittest

import program


def tables(*words):
    return program.command("tables", *words)


class Tables(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-")
        cls.result = tables("--markdown", "--output", cls.folder)

    def rows(self):
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in self.result.stdout.splitlines()
                if line.startswith("| ") and not line.startswith("| ---")]

    def test_both_forms_are_written_and_the_one_asked_for_is_printed(self):
        self.assertEqual(self.result.returncode, 0, self.result.stderr)
        with open(os.path.join(self.folder, "tables.md")) as file:
            self.assertEqual(file.read(), self.result.stdout)
        with open(os.path.join(self.folder, "tables.txt")) as file:
            text = file.read()
        self.assertNotIn("|", text)
        self.assertIn("rotation 2", text)

    def test_frequencies(self):
        rows = [row for row in self.rows() if row[0] in "12"]
        self.assertEqual(len(rows), 12)
        for row in rows:
            measured, ours = float(row[2]), {"A": (row[5], row[6]), "B": (row[7], row[8])}
            for model, (value, percent) in ours.items():
                with open(os.path.join(self.folder, f"model-{model.lower()}", "summary.json")) as file:
                    modes = json.load(file)["structures"][f"s{row[0]}"]["frequencies"][:6]
                self.assertIn(value, [f"{mode['frequency']:.2f}" for mode in modes], row)
                self.assertAlmostEqual(float(percent), 100 * (float(value) / measured - 1), delta=0.3, msg=row)
                self.assertLess(abs(float(percent)), 3, row)

    def test_time_steps(self):
        rows = [row for row in self.rows() if row[0] in "AB"]
        self.assertEqual([row[1] for row in rows], ["paper", "ours, structure 1", "ours, structure 2"] * 2)
        for row in rows:
            omega, undamped, damped = (float(cell) for cell in row[3:])
            self.assertAlmostEqual(omega * undamped / 2, 1, delta=5e-3, msg=row)
            self.assertLess(damped, undamped, row)

    def test_refuses_an_unknown_option(self):
        self.assertNotEqual(tables("--latex").returncode, 0)


if __name__ == "__main__":
    unittest.main()
