"""run/struck and the block `struck` of a study: strengths beside hand numbers, rows found again from single runs, mistakes."""
import csv
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
import program
import two_buildings
import yaml
from pounding import UserError
from pounding.fragility import study
from pounding.fragility.study_file import Reader
from pounding.struck import STRENGTHS, Strength, Window, of_run, read_strengths
from study_command import STUDY, StudyCommand


AREAS = {"struck_areas": "0.1,0.5", "struck_edges": 1}
STRUCK = {"areas": [0.1, 0.5], "edges": [1], "strength": 30e6, "support": 0.9, "edge_strength": 2e5, "contacts": {"floor1": {"edge_strength": 4e5}}}
ALIKE = {"states": None, "soils": None}


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class OfStrengths(unittest.TestCase):
    def test_bearing(self):
        """ACI 318-19, table 22.8.3.2: 0.85 f'c sqrt(A2 / A1), at most twice 0.85 f'c."""
        one = Strength(30e6, 0.9)
        for area, expected in ((0.1, 51e6), (0.225, 51e6), (0.4, 0.85 * 30e6 * 1.5), (0.9, 25.5e6), (2.0, 25.5e6)):
            self.assertAlmostEqual(one.bearing(area) / expected, 1, delta=1e-12)
        self.assertAlmostEqual(Strength(30e6, None, 0.65).bearing(0.1), 0.65 * 25.5e6)
        self.assertTrue(np.isnan(Strength(None, None, 1.0, 5e5).of(Window(0.1, False))))
        self.assertEqual(Strength(edge=5e5).of(Window(1.0, True)), 5e5)


    def test_mistakes(self):
        for words, values in (("give strength, f'c in Pa, or edge_strength", {}), ("strength: 30 is below 100000 Pa", {"strength": 30}),
                              ("edge_strength: 800 is below 1000 N/m", {"edge_strength": 800}), ("phi is unknown", {"phi": 1}),
                              ("support: 1 goes with a strength", {"edge_strength": 5e5, "support": 1}),
                              ("reduction: 1.1 is above 1", {"strength": "30e6", "reduction": 1.1}),
                              ("'strong' is not a number", {"strength": "strong"}), ("strength: -3 is not above 0", {"strength": -3}),
                              ("contacts: ['a'] is no list of contacts", {"strength": 3e7, "contacts": ["a"]})):
            with self.subTest(words), self.assertRaises(UserError) as refused:
                read_strengths(Reader(values, Path("s.yaml"), "", ("contacts", *STRENGTHS)))
            self.assertIn(words, str(refused.exception))


class OfARun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="pounding-")
        self.addCleanup(folder.cleanup)
        self.place = Path(folder.name)

    def struck(self, text, status):
        (self.place / "strengths.yaml").write_text(text)
        done = subprocess.run([os.path.join(program.SOURCE, "run", "struck"), "run", "strengths.yaml"], cwd=self.place, capture_output=True,
                              text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def test_rows_and_mistakes(self):
        run = two_buildings.run(self.place / "run", gap=0.01, **AREAS)
        windows, found = of_run(run)
        self.assertEqual([window.name for window in windows], ["0.1 m2", "0.5 m2", "1 m of edge"])
        hit = int(found[:, 0, 0].argmax())
        contact, pressure = run.contacts[hit], found[hit, 0, 0] / 0.1
        self.assertGreater(pressure, 0)
        strength = pressure / 0.85 / 2 / 1.25  # a root of 2 that is not enough
        done = self.struck(f"strength: {strength:.12g}\nsupport: 0.4\n", 3)
        row = next(row for row in rows_of(self.place / "run" / "struck.csv") if row["contact"] == contact)
        self.assertEqual((row["over"], row["unit"], row["holds"]), ("0.1 m2", "Pa", "no"))
        self.assertAlmostEqual(float(row["largest over strength"]), 1.25, delta=1e-9)
        self.assertIn("0.1 m2", done.stdout)
        self.struck(f"strength: {strength:.12g}\nsupport: 0.4\ncontacts:\n  {contact}: {{strength: {2 * strength:.12g}}}\n",
                    0 if all(values[0] <= 0 for k, values in enumerate(found[:, 0]) if k != hit) else 3)
        impacts = run.impacts["window_force"][run.impacts["contact"] == contact].max()
        self.assertLessEqual(found[hit, :, 0].max(), impacts * (1 + 1e-9))
        mistake = self.struck("strength: 30e6\ncontacts: {roof: {support: 1}}\n", 1).stderr
        self.assertEqual(mistake, "run/struck: strengths.yaml: contacts: roof is no contact of the run; it has floor1, floor2\n")
        two_buildings.run(self.place / "run", gap=0.01)
        self.assertIn("did not look over areas of its faces", self.struck("strength: 30e6\n", 1).stderr)


class OfAStudy(StudyCommand):
    def test_rows_are_those_of_single_runs(self):
        done = self.fragility("--runner", "ensemble", submittal={"question": "Does the edge hold?"}, struck=STRUCK, **ALIKE)
        self.assertIn("one pair presses up to", done.stdout)
        rows = rows_of(self.place / "out" / "struck.csv")
        found = {seed: self.alone(seed) for seed in (1, 2)}
        self.assertEqual([(row["contact"], row["over"]) for row in rows],
                         [(contact, over) for contact in ("floor1", "floor2") for over in ("0.1 m2", "0.5 m2", "1 m of edge")])
        self.assertTrue(any(float(row["largest"]) > 0 for row in rows))
        for number, row in enumerate(rows):
            values = {seed: one[number // 3, number % 3] for seed, one in found.items()}
            size = (0.1, 0.5, 1)[number % 3]
            most = max(values, key=lambda seed: values[seed][0])
            self.assertAlmostEqual(float(row["mean"]), np.mean([one[0] for one in values.values()]) / size, delta=1e-9 * max(1, values[most][0] / size))
            if not values[most][0]:
                continue
            self.assertEqual(row["motions"], f"x: seed {most}")
            self.assertLess(abs(float(row["largest"]) * size / values[most][0] - 1), 1e-9)
            for name, value in zip(("time [s]", "x [m]", "y [m]", "z [m]"), values[most][1:]):
                self.assertAlmostEqual(float(row[name]), value, delta=1e-6)
            strength = {0.1: 51e6, 0.5: 0.85 * 30e6 * np.sqrt(1.8), 1: 4e5 if row["contact"] == "floor1" else 2e5}[size]
            self.assertAlmostEqual(float(row["strength"]) / strength, 1, delta=1e-8)
            self.assertAlmostEqual(float(row["largest over strength"]), float(row["largest"]) / strength, delta=1e-7)
        passed = [row["contact"] for row in rows if float(row["largest over strength"]) > 1]
        for contact in ("floor1", "floor2"):
            self.assertEqual(f"Doubt: contact {contact} is struck beyond its strength" in done.stdout, contact in passed)
        for page in ("fragility.html", "submittal.html"):
            self.assertIn("Places that are struck", (self.place / "out" / page).read_text())

    def alone(self, seed):
        with tempfile.TemporaryDirectory() as folder:
            run = two_buildings.run(os.path.join(folder, "run"), **{
                **STUDY["options"], **AREAS, "motion_x_seed": seed, "motion_x_pga": 4.0, "motion_x_duration": 6, "motion_x_envelope": "0.3,4",
                **{f"{name}_{key}": value for name in ("left", "right") for key, value in STUDY["reduction"][name].items()},
                "gap": 0.01, "spectra_frequencies": "1,2,5,10,20,50,100", "spectra_damping": 0.05, "csv_digits": 17})
            return of_run(run)[1]

    def test_mistakes(self):
        for words, struck in (("struck: give areas, in m2, or edges, in m", {"strength": 30e6}),
                              ("struck: areas: [0, 1] has a number that is not above 0", {**STRUCK, "areas": [0, 1]}),
                              ("struck: level: 3 is none of the study's 4", {**STRUCK, "level": 3}),
                              ("struck: give strength, f'c in Pa, or edge_strength", {"areas": [1]}),
                              ("struck: contacts: roof is no contact of the scene; it has floor1, floor2", {**STRUCK, "contacts": {"roof": {"strength": 4e7}}}),
                              ("struck: contacts: floor1: strength: 40 is below 100000 Pa", {**STRUCK, "contacts": {"floor1": {"strength": 40}}})):
            with self.subTest(words), self.assertRaises(UserError) as refused:
                (self.place / "study.yaml").write_text(yaml.safe_dump({**STUDY, "struck": struck}))
                study.check_names(study.read(self.place / "study.yaml"), ["left_roof"], ["floor1", "floor2"])
            self.assertIn(words, str(refused.exception))


if __name__ == "__main__":
    unittest.main()
