"""run/fragility over what goes from one building to another: rows and histories found again from single runs, spectra, mistakes."""
import os
import subprocess
import tempfile
import unittest

import numpy as np
import program
import two_buildings
from pounding.spans import MOTIONS
from study_command import STUDY, StudyCommand


TRAY = {"from": {"structure": "left", "at": "6,2,6"}, "to": {"structure": "right", "at": [6.02, 2, 6]}}
SPANS = {"spans": {"tray": TRAY, "line": {"from": "left_roof", "to": {"structure": "right", "group": "west_2"}}}, "states": None}
BY_HAND = {"probes": "left_roof,tray_a,tray_b,line_b", "spans": "tray,line", "tray_from": "tray_a", "tray_to": "tray_b", "line_from": "left_roof",
           "line_to": "line_b", "tray_a_structure": "left", "tray_a_at": "6,2,6", "tray_b_structure": "right", "tray_b_at": "6.02,2,6",
           "line_b_structure": "right", "line_b_group": "west_2"}


class Spans(StudyCommand):
    def test_rows_are_those_of_single_runs(self):
        said = self.fragility("--runner", "ensemble", submittal={"question": "Does the tray hold?"}, **SPANS).stdout
        self.assertIn("span_tray.csv: history of sample", said)
        self.assertNotIn("Doubt: tray", said)
        runs = {(soil, seed): self.alone(seed, own) for soil, own in (("best", {}), ("upper", {"left_soil_vs": 225})) for seed in (1, 2)}
        rows = program.rows_of(self.place / "out" / "spans.csv")
        self.assertEqual(len(rows), 2 * len(MOTIONS))
        for row in rows:
            k = MOTIONS.index(row["motion"].split()[0])
            found = {at: run.spans[row["span"]].largest for at, run in runs.items()}
            values = {at: one[0][k] for at, one in found.items()}
            if max(values.values()) < 1e-7:  # round-off has no largest value
                continue
            most = max(values, key=values.get)
            self.assertEqual((row["soil"], row["motions"]), (most[0], f"x: seed {most[1]}"))
            self.assertLess(abs(float(row["largest"]) / values[most] - 1), 1e-6, row)
            self.assertAlmostEqual(float(row["time [s]"]), found[most][1][k], delta=1e-6)
            means = [np.mean([values[soil, seed] for seed in (1, 2)]) for soil in ("best", "upper")]
            self.assertLess(abs(float(row["mean"]) / max(means) - 1), 1e-6)
        for span in ("tray", "line"):
            history = {name: np.array([row[name] for row in program.rows_of(self.place / "out" / f"span_{span}.csv")], float)
                       for name in ("time", "relative_ux", "relative_uy", "relative_uz", "relative_ry")}
            row = next(row for row in rows if row["span"] == span and row["motion"] == "u [m]")
            apart = np.linalg.norm([history[f"relative_u{way}"] for way in "xyz"], axis=0)
            self.assertLess(abs(apart.max() / float(row["largest"]) - 1), 1e-2)  # a line every millisecond
            self.assertAlmostEqual(history["time"][1], 1e-3)
        spectra = [row for row in program.rows_of(self.place / "out" / "span_line_spectra.csv") if row["direction"] == "x"]
        self.assertEqual(len(spectra), 7)
        for row in spectra:
            self.assertAlmostEqual(float(row["envelope"]), max(float(row["from"]), float(row["to"])))
            self.assertGreaterEqual(float(row["widened"]), float(row["envelope"]))
        for page in ("fragility.html", "submittal.html"):
            text = (self.place / "out" / page).read_text()
            for part in ("What spans the joint", "ux [mm]", "The ends of tray move "):
                self.assertTrue(part in text, f"{page}: {part}")
        again = self.fragility("--collect", submittal={"question": "Does the tray hold?"}, **SPANS).stdout
        self.assertNotIn("history of a member", again)

    def alone(self, seed, options):
        with tempfile.TemporaryDirectory() as folder:
            run = two_buildings.run(os.path.join(folder, "run"), **{
                **STUDY["options"], **BY_HAND, "motion_x_seed": seed, "motion_x_pga": 4.0, "motion_x_duration": 6, "motion_x_envelope": "0.3,4",
                **{f"{name}_{key}": value for name in ("left", "right") for key, value in STUDY["reduction"][name].items()},
                "gap": 0.01, "spectra_frequencies": "1,2,5,10,20,50,100", "spectra_damping": 0.05, **options})
            self.assertEqual(set(run.spans), {"tray", "line"})
            return run

    def test_mistakes(self):
        for words, spans in (("is no list of named spans", ["tray"]),
                             ("spans: tray: to is missing", {"tray": {"from": "left_roof"}}),
                             ("spans: tray: from: structure: 'west' is no structure of the scene; it has left, right",
                              {"tray": {"from": {"structure": "west", "at": "0,0,0"}, "to": "left_roof"}}),
                             ("both ends are on structure left", {"tray": {"from": "left_roof", "to": {"structure": "left", "at": "6,2,6"}}}),
                             ("tray: to: 'right_roof' is no probe of the scene; it has left_roof", {"tray": {"from": "left_roof", "to": "right_roof"}}),
                             ("from: at: '6,2' is not a point x,y,z", {"tray": {"from": {"structure": "left", "at": "6,2"}, "to": "left_roof"}}),
                             ("give one of at, a point x,y,z, and group", {"tray": {"from": {"structure": "left"}, "to": "left_roof"}}),
                             ("spans: tray: via is unknown", {"tray": {**TRAY, "via": 1}}),
                             ("m away from the nearest node of structure right", {"tray": {**TRAY, "to": {"structure": "right", "at": "60,2,6"}}})):
            with self.subTest(words):
                self.must_be_refused(words, spans=spans)
        (self.place / "twice.yaml").write_text("spans:\n  tray: {}\n  tray: {}\n")
        self.assertIn("tray stands twice", self.refused("twice.yaml"))

    def refused(self, study):
        done = subprocess.run([os.path.join(program.SOURCE, "run", "fragility"), study], cwd=self.place, capture_output=True, text=True,
                              timeout=60, check=False)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), done.stderr)
        return done.stderr


if __name__ == "__main__":
    unittest.main()
