"""run/plant as a user runs it, on the small pair for the first tenths of a second."""
import csv
import os
import tempfile
import unittest

import program

PROCESSORS = 2  # it starts runs


class PlantStudy(unittest.TestCase):
    def study(self, folder, *words):
        return program.command("plant", "--size", "small", "--seconds", 0.25, "--modes", 20, "--out", folder, *words)

    def rows(self, folder, name):
        with open(os.path.join(folder, "comparison", f"{name}.csv")) as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))

    @program.long
    def test_pounding_beside_none_and_going_on(self):
        """A block that starts towards the frame strikes it; what is finished is not run again."""
        with tempfile.TemporaryDirectory() as folder:
            words = ["--fidelity", "full,modal", "--gap", 0.006, "--options", "-block_initial_velocity 0.3,0,0 -probes frame_cabinet1"]
            done = self.study(folder, *words)
            self.assertEqual(done.returncode, 0, done.stderr)
            impacts = {(row["contact"], row["run"]): row for row in self.rows(folder, "impacts")}
            self.assertEqual(impacts["all contacts", "apart"]["impacts"], "0")
            for fidelity in ("full", "modal"):
                self.assertGreaterEqual(int(impacts["floor1", fidelity]["impacts"]), 1)
                summary = program.summary(os.path.join(folder, fidelity))
                self.assertEqual((summary["ranks"], summary["end_time"]), (2, 0.25))
                self.assertLess(summary["energy"]["relative_residual"], 1e-11)
            self.assertEqual(program.summary(os.path.join(folder, "modal"))["structures"]["block"]["modal"]["modes"], 20)
            with open(os.path.join(folder, "plant.html")) as file:
                text = file.read()
            for part in ("What it cost", "floor1", 'href="full/report.html"', 'href="apart/report.html"'):
                self.assertIn(part, text)
            self.assertLess(text.index('class="answer touched"'), text.index("<table"))
            self.assertLess(text.index("The joint closes in all of 2 runs (full: "), text.index("<nav>"))
            self.assertLess(text.index("The buildings touched"), text.index("<h2 id=\"part-3\">"))
            self.assertLess(text.index("The buildings touched"), text.rindex("What it cost"))
            self.assertTrue(os.path.exists(os.path.join(folder, "full", "report.html")))
            again = self.study(folder, *words)
            self.assertEqual(again.returncode, 0, again.stderr)
            self.assertEqual(again.stdout.count("finished before"), 3)
            other = self.study(folder, "--fidelity", "full", "--gap", 0.007, *words[4:])
            self.assertEqual(other.returncode, 0, other.stderr)
            self.assertEqual(other.stdout.count("finished before"), 1)

    def test_joint_that_never_closes_changes_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.study(folder, "--ranks", 1, "--gap", 1, "--options", "-probes frame_cabinet1")
            self.assertEqual(done.returncode, 0, done.stderr)
            spectra = self.rows(folder, "spectra")
            self.assertGreater(len(spectra), 100)
            self.assertTrue(all(row["full / apart"] in ("1", "") for row in spectra))

    def test_mistakes_are_one_line(self):
        with tempfile.TemporaryDirectory() as folder:
            for words, part in ((("--gap", 0.004), "deviation"), (("--fidelity", "full,modes"), "'modes' is none of"),
                                (("--fidelity", "full,full"), "twice"), (("--seconds", 0), "not above 0"),
                                (("--options", "-contacts none"), "--options"),
                                (("--options", "-floor1_gop 1"), "-floor1_gop")):
                done = self.study(folder, *words)
                self.assertNotEqual(done.returncode, 0, words)
                self.assertIn(part, done.stderr)


if __name__ == "__main__":
    unittest.main()
