"""run/new, and docs/manual/tutorial.md: every command of the page, run in an empty folder."""
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import program

PROCESSORS = 2  # runs on two ranks

PAGE = os.path.join(program.SOURCE, "docs", "manual", "tutorial.md")


def commands():
    """Indented lines of the page outside its lists, in their order."""
    with open(PAGE) as file:
        return [line.strip() for line in file if re.match(r"    (export|source|mpirun|\$POUNDING)", line)]


class Tutorial(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = Path(tempfile.mkdtemp(prefix="pounding-"))
        build = os.path.abspath(program.BUILD)
        lines = ["set -euo pipefail", "export POUNDING_BUILD=" + build]
        for command in commands():
            command = command.replace("~/pounding", program.SOURCE).replace("$POUNDING/build/", build + "/")
            lines += [f"echo '$ {command}'", command]
        cls.done = subprocess.run(["bash", "-c", "\n".join(lines)], cwd=cls.place, capture_output=True, text=True,
                                  timeout=600, check=False)

    def said(self, number):
        """Output of the command of that number."""
        return re.split(r"^\$ .*\n", self.done.stdout, flags=re.MULTILINE)[number + 1]

    def test_every_command_ends_well(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout[-3000:] + self.done.stderr[-3000:])
        self.assertGreaterEqual(len(commands()), 10)
        for name in ("gap-20/report.html", "gap-60/report.html", "comparison/comparison.html", "gaps/sweep.csv"):
            self.assertTrue((self.place / name).is_file(), name)

    def test_figures_of_the_page(self):
        """The numbers in the page are those of the runs."""
        with open(PAGE) as file:
            page = " ".join(file.read().split())
        dry = self.said(3)
        for number in ("mass 23180 kg", " 2.340  y", " 3.222  x", "mass 12647 kg", " 3.553  y", " 4.377  x",
                       "1 connected piece, held", "5 pairs (5 node to node)", "nothing hits: modal 20.85 mm", "gap 20 to 20 mm", "time step 3.045"):
            self.assertIn(number, dry)
        narrow, wide = (program.summary(self.place / name) for name in ("gap-20", "gap-60"))
        self.assertEqual((narrow["impacts"]["episodes"], wide["impacts"]["episodes"]), (1, 0))
        table = program.read_csv(self.place / "gap-20" / "impacts.csv")
        self.assertAlmostEqual(float(table["start"][0]), 2.30, delta=0.01)
        self.assertAlmostEqual(1e3 * float(table["duration"][0]), 2.3, delta=0.1)
        impulse, felt = narrow["impacts"]["largest_impulse"], narrow["probes"]["right_roof"]["peak_acceleration"][0]
        self.assertIn(f"with {impulse:.0f} N s", page)
        self.assertIn(f"feels {felt:.0f} m/s2", page)
        for row in re.findall(r"\| (\d+) mm \| (\d+) \| (\d*)", page):
            gap, count, strongest = row
            found = program.summary(self.place / "gaps" / f"floor1_gap={int(gap) / 1000:g}")["impacts"]
            self.assertEqual(found["episodes"], int(count))
            if strongest:
                self.assertAlmostEqual(found["largest_impulse"] / float(strongest), 1, delta=2e-3)
        row = re.search(r"\| left_roof \| x \| gap-60 \| ([\d.]+) \| 400 \| ([\d.]+) \| ([\d.]+) \|", self.said(8))
        self.assertIsNotNone(row, self.said(8))
        self.assertIn(f"{float(row[1]):.3f} of the pseudo-acceleration at 400 Hz, but {float(row[2]):.2f} times that at "
                      f"{float(row[3]):.1f} Hz", page)

    def test_rayleigh_damping_costs_what_the_page_says(self):
        words = [word for side in ("left", "right") for name, value in
                 (("uniform", 0), ("ratio", 0.05), ("frequencies", "2,20")) for word in (f"-{side}_damping_{name}", value)]
        dry = program.run(["-options_file", self.place / "two-buildings.yaml", "-dry_run", "-modes", 1, *words], 1)
        self.assertEqual(dry.returncode, 0, dry.stderr)
        costs = [float(text) for text in re.findall(r"costs ([\d.]+) times the steps", dry.stdout)]
        self.assertEqual([round(cost) for cost in costs], [35, 34], "docs/manual/tutorial.md says how many times")


class New(unittest.TestCase):
    def test_nothing_is_written_over(self):
        with tempfile.TemporaryDirectory(prefix="pounding-") as place:
            self.assertEqual(program.command("new", "two-buildings", os.path.join(place, "mine", "deep")).returncode, 0)
            path = os.path.join(place, "two-buildings.yaml")
            Path(path).write_text("mine\n")
            again = program.command("new", "two-buildings", place)
            self.assertEqual(again.returncode, 1)
            line, = again.stderr.splitlines()
            self.assertIn("two-buildings.yaml is there already", line)
            self.assertEqual(Path(path).read_text(), "mine\n")
            self.assertEqual(sorted(os.listdir(place)), ["mine", "two-buildings.yaml"], "nothing else is written either")

    def test_lists_what_there_is(self):
        self.assertIn("run/new two-buildings DIR    Two small frame buildings", program.command("new").stdout)
        for words in (["castle", "."], ["two-buildings"]):
            self.assertEqual(program.command("new", *words).returncode, 2)


if __name__ == "__main__":
    unittest.main()
