"""docs/manual/submittal.md: the study that run/new writes goes from two meshes to the submittal, on a shorter motion."""
import re
import tempfile
import unittest
from pathlib import Path

import program


PAGE = Path(program.SOURCE) / "docs" / "manual" / "submittal.md"


class Submittal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="pounding-")))
        cls.commands = [line.strip() for line in PAGE.read_text().splitlines() if line.startswith("    $POUNDING")]

    def does(self, line):
        """A command of the page, in the folder of the study."""
        words = [word.replace("$POUNDING/run/", "").replace("$POUNDING/build/", "") for word in line.split() if word != "--pdf"]
        if words[0] == "pounding":
            return program.run([self.place / word if word.endswith(".yaml") else word for word in words[1:]])
        return program.command(words[0], *words[1:], cwd=self.place)

    def test_every_command_in_its_order(self):
        self.assertEqual([re.sub(r".*/", "", line.split()[0]) for line in self.commands], ["new", "pounding", "fragility", "fragility"])
        for number, line in enumerate(self.commands):
            if number == 2:  # two samples of four seconds
                study = self.place / "joint-review.yaml"
                text = study.read_text()
                for long, short in (("target: rg160.csv", "target: ground.csv"), ("duration: 22", "duration: 4"), ('envelope: "2,14"', 'envelope: "0.5,2"'), ("end_time: 22", "end_time: 4"),
                                    ("choose: 5", "choose: 2\n  correlation: 0.5"), ("  lower: {factor: 0.6667}\n", "")):
                    self.assertIn(long, text)
                    text = text.replace(long, short)
                study.write_text(text + 'frequencies: "0.5,1,2,5,10,20,50,100"\ndampings: [0.05]\n')
                rules = self.place / "rules.csv"
                rules.write_text(rules.read_text().replace("0.1:50:271log", "0.5:50:201log").replace("0.3:24", "0.5:24"))
            done = self.does(line)
            self.assertEqual(done.returncode, 0, f"{line}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
        page = (self.place / "review" / "submittal.html").read_text()
        for heading in ("by elevation", "Change of the joint as surveyed", "Equipment that fails", "Not covered"):
            self.assertIn(heading, page)
        self.assertIn("motions are refused by the rules", page, "four seconds are too short for them")
        rows = program.rows_of(self.place / "review" / "joint_by_elevation.csv")
        least = {row["contact"]: float(row["gap [m]"]) for row in rows}
        # The least of the surveys, the static closing and an error of half a millimetre.
        self.assertAlmostEqual(least["floor1"], 0.019, delta=0.002)
        self.assertAlmostEqual(least["floor2"], 0.016 - 0.002, delta=0.002)
        # All conditions at one level: their margins apart are the widths that they lack there.
        for row in program.rows_of(self.place / "review" / "conditions.csv"):
            margin = min(float(one["margin [m]"]) for one in rows if one["runs"] == f"apart, {row['soil']}_{row['state']}")
            self.assertAlmostEqual(margin, -float(row["joint, 5 % [m]"]), delta=1e-3)


if __name__ == "__main__":
    unittest.main()
