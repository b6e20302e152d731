"""run/fragility over soils and states: each pair of them, the envelope and the conditions that govern it, mistakes."""
import os
import tempfile
import unittest

import numpy as np
import program
import two_buildings
import yaml
from pounding import UserError, fragility
from pounding.fragility import design, runs, study
from study_command import STUDY, StudyCommand


BY_HAND = {"soil": {"best": {}, "upper": {"left_soil_vs": 225}}, "state": {"sound": {}, "cracked": {"left_columns_stiffness_factor": 0.5}}}


class Conditions(StudyCommand):
    @program.long
    def test_envelope_is_the_largest_of_single_runs(self):
        said = self.fragility("--runner", "ensemble").stdout
        self.assertIn("soil upper, state cracked (4 of 4)", said)
        needed, spectra = {}, {}
        for soil, of_soil in BY_HAND["soil"].items():
            for state, of_state in BY_HAND["state"].items():
                needed[soil, state], spectra[soil, state] = zip(*(self.alone(seed, {**of_soil, **of_state}) for seed in (1, 2)))
        largest = max(needed, key=lambda at: np.quantile(needed[at], 0.5))
        row = next(row for row in program.rows_of(self.place / "out" / "joint.csv") if row["joint"] == "any" and row["exceeded in"] == "50 %")
        self.assertEqual((row["soil"], row["state"]), largest)
        self.assertLess(abs(float(row["needed [m]"]) / np.quantile(needed[largest], 0.5) - 1), 1e-8)
        high = {at: np.quantile(values, 0.84, axis=0) for at, values in spectra.items()}
        for row in program.rows_of(self.place / "out" / "spectra" / "gap-apart_pga-4.csv"):
            if row["channel"] == "left_roof x":
                at = STUDY["frequencies"].index(float(row["frequency"]))
                governing = max(high, key=lambda one: high[one][at])
                self.assertEqual((row["soil"], row["state"]), governing)
                self.assertLess(abs(float(row["p84"]) / high[governing][at] - 1), 1e-5)
        moved = {row["moved by"]: row for row in program.rows_of(self.place / "out" / "sensitivity.csv") if row["quantity"] == "joint needed [m]"}
        self.assertEqual(set(moved), {"soil", "state", "motion"})
        states = {state: np.quantile(needed["best", state], 0.84) for state in ("sound", "cracked")}
        self.assertLess(abs(float(moved["state"]["high"]) / max(states.values()) - 1), 1e-8)
        page = (self.place / "out" / "fragility.html").read_text()
        self.assertIn("conditions/upper_cracked/fragility.html", page)
        again = self.fragility("--collect").stdout
        self.assertIn("So that no joint closes", again)

    def alone(self, seed, options):
        """Joint needed and floor spectrum of a run apart with options given by hand."""
        with tempfile.TemporaryDirectory() as folder:
            run = two_buildings.run(os.path.join(folder, "run"), **{
                **STUDY["options"], "gap": 1.0, "motion_x_seed": seed, "motion_x_pga": 4.0, "motion_x_duration": 6, "motion_x_envelope": "0.3,4",
                **{f"{name}_{key}": value for name in ("left", "right") for key, value in STUDY["reduction"][name].items()},
                "spectra_frequencies": "1,2,5,10,20,50,100", "spectra_damping": 0.05, **options})
            return 1.0 - np.nanmin(run.history["gap"]), run.spectrum("left_roof", "x", damping=0.05)[1]

    def test_mistakes(self):
        for words, changes in (("has no soil: no structure of two-buildings.yaml has a soil_mat",
                                {"options": {**two_buildings.SHORT, "probes": "left_roof"}}),
                               ("soils: 'a b' is no name", {"soils": {"a b": {}}}),
                               ("left_soil_factor is given by soil upper and by state stiff",
                                {"states": {"stiff": {"left": {"soil_factor": 2}}}}),
                               ("soils: upper: factors is unknown", {"soils": {"upper": {"factors": 2}}}),
                               ("soils: upper: factor: 0 is not above 0", {"soils": {"upper": {"factor": 0}}}),
                               ("is no list of named states", {"states": ["cracked"]}),
                               ("between 100 and 120 m lies no pair", {"soils": None, "states": None, "elevations": [100, 120]}),
                               ("has other axes", {"soils": {"own": {"motions": {"y": STUDY["motions"]["x"]}}}})):
            with self.subTest(words):
                self.must_be_refused(words, **changes)


class Surveyed(StudyCommand):
    """Joints as they were measured: gaps of the study are changes of the survey, made by its static closing."""

    def setUp(self):
        super().setUp()
        (self.place / "survey.csv").write_text("x,y,z,gap\n6,0,2.8,0.012\n6,4,2.8,0.009\n6,0,3.2,0.012\n6,4,3.2,0.009\n")

    def study(self, **joint):
        changes = {"soils": None, "states": None, "joints": {"floor1": joint or {"survey": "survey.csv", "static_closing": "0:0,6:0.002"}}, "gaps": [0, 0.01]}
        (self.place / "study.yaml").write_text(yaml.safe_dump({**STUDY, **changes}, sort_keys=False))
        return study.read(self.place / "study.yaml")

    def test_members_shift_the_closing(self):
        found = self.study()
        plan = design.build(found)
        at = plan.columns.index("floor1_static_closing")
        texts = {member.gap: member.values[at] for member in plan.members}
        self.assertEqual(texts, {None: f"0:{-found.apart:g},6:{0.002 - found.apart:.9g}", 0.0: "0:0,6:0.002", 0.01: "0:-0.01,6:-0.008"})
        self.assertAlmostEqual(found.joints["floor1"].shape[0], 0.007)
        self.assertEqual(found.joint_named(0.01), "joint as surveyed and 10 mm wider")

    def test_the_program_takes_the_survey(self):
        found = self.study()
        plan = design.build(found)
        options = {**runs.scene_options(found, "reduced", self.place), "end_time": 0.01}
        options |= {column: value for column, value in zip(plan.columns, next(one for one in plan.members if one.gap == 0).values)}
        options.pop("include")
        words = [word for name, value in options.items() for word in (f"-{name}", value)]
        _, summary = program.must_run(self, ["-options_file", two_buildings.SCENE, *words])
        self.assertAlmostEqual(summary["contacts"]["floor1"]["survey"]["smallest"], 0.009 - 0.001)  # of which half is closed at 3 m

    def test_mistakes(self):
        for words, joint in (("is no file", {"survey": "none.csv"}), ("is that of the survey", {"survey": "survey.csv", "shape": [0.01]}),
                             ("goes with a survey", {"static_closing": "0:0"}), ("is not elevation:closing", {"survey": "survey.csv", "static_closing": "2"})):
            with self.subTest(words), self.assertRaisesRegex(UserError, words):
                self.study(**joint)


class Capacity(unittest.TestCase):
    """High confidence and low probability of failure against the formulas."""

    def test_of_one_curve(self):
        self.assertAlmostEqual(fragility.hclpf([3.0], [0.4])["HCLPF [m/s2]"], 3 * np.exp(-2.326 * 0.4))
        self.assertAlmostEqual(fragility.hclpf([3.0], [0.3], 0.25)["HCLPF [m/s2]"], 3 * np.exp(-1.645 * 0.55))

    def test_of_conditions(self):
        found = fragility.hclpf([2.0, 4.0], [0.3, 0.4])
        between = np.log(2) / 2
        self.assertAlmostEqual(found["beta_U"], between)
        self.assertAlmostEqual(found["HCLPF [m/s2]"], np.sqrt(8) * np.exp(-1.645 * (np.sqrt(0.125) + between)))
        self.assertAlmostEqual(fragility.hclpf([2.0, 4.0], [0.3, 0.4], 0.2)["beta_U"], np.hypot(between, 0.2))


if __name__ == "__main__":
    unittest.main()
