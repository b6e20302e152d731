"""run/tables: runs Models A and B through the program and sets Table 1 and the time step of Ambiel
et al. (Eng. Struct. 251, 2022) beside ours; the figures must be those of the summaries that it left, and the page has them
below their lines."""
import json
import os
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import program

sys.path.insert(0, os.path.join(program.SOURCE, "run"))
sys.dont_write_bytecode = True
from parts import measured  # noqa: E402


def tables(*words):
    return program.command("tables", *words)


class Tables(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder, cls.docs = tempfile.mkdtemp(prefix="pounding-"), tempfile.mkdtemp(prefix="pounding-")
        shutil.copy(os.path.join(program.SOURCE, "docs", "measurements", "pair.md"), cls.docs)
        cls.result = tables("frequencies", "time_steps", "--docs", cls.docs, "--output", cls.folder)

    def rows(self):
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in self.result.stdout.splitlines()
                if line.startswith("| ") and not line.startswith("| ---")]

    def test_the_page_has_what_is_printed_below_its_line(self):
        self.assertEqual(self.result.returncode, 0, self.result.stderr)
        page = Path(self.docs, "pair.md").read_text(encoding="utf-8")
        found = list(measured.MARKED.finditer(page))
        self.assertEqual([one[2] for one in found], ["frequencies", "time_steps"])
        for one in found:
            self.assertIn(one[3].strip(), self.result.stdout)
            self.assertEqual(measured.LINE.match(one[3].splitlines()[0])[1], one[2])
        before = Path(program.SOURCE, "docs", "measurements", "pair.md").read_text(encoding="utf-8")
        self.assertEqual(measured.MARKED.sub("", page), measured.MARKED.sub("", before))

    def test_frequencies(self):
        rows = [row for row in self.rows() if row[0] in "12"]
        self.assertEqual(len(rows), 12)
        for row in rows:
            measured_, ours = float(row[2]), {"A": (row[5], row[6]), "B": (row[7], row[8])}
            for model, (value, percent) in ours.items():
                with open(os.path.join(self.folder, "frequencies", f"model-{model.lower()}", "summary.json")) as file:
                    modes = json.load(file)["structures"][f"s{row[0]}"]["frequencies"][:6]
                self.assertIn(value, [f"{mode['frequency']:.2f}" for mode in modes], row)
                self.assertAlmostEqual(float(percent), 100 * (float(value) / measured_ - 1), delta=0.3, msg=row)
                self.assertLess(abs(float(percent)), 3, row)

    def test_time_steps(self):
        rows = [row for row in self.rows() if row[0] in "AB"]
        self.assertEqual([row[1] for row in rows], ["paper", "ours, structure 1", "ours, structure 2"] * 2)
        for row in rows:
            omega, undamped, damped = (float(cell) for cell in row[3:])
            self.assertAlmostEqual(omega * undamped / 2, 1, delta=5e-3, msg=row)
            self.assertLess(damped, undamped, row)

    def test_refuses_what_it_does_not_know(self):
        self.assertNotEqual(tables("--latex").returncode, 0)
        self.assertNotEqual(tables("house").returncode, 0)
        result = tables("shapes", "--docs", self.docs)
        self.assertEqual((result.returncode, result.stderr),
                         (1, f"run/tables: shapes: in no page of {self.docs}; --print prints it\n"))


if __name__ == "__main__":
    unittest.main()
