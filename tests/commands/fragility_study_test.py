"""run/fragility over two small buildings: members, tables, parts, going on, repeats at full order, mistakes."""
import os
import re
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np
import program
import two_buildings
import yaml
from study_command import refused_where_it_is_read
from two_buildings import pounding
from pounding import fragility
from pounding.fragility import design, matching, motions, study

PROCESSORS = 2  # it starts runs

STUDY = {
    "scene": str(two_buildings.SCENE),
    # With columns that shear, the left roof moves up and down by less than a twentieth of its sway: no main channel.
    "options": {**two_buildings.SHORT, "probes": "left_roof", "output_interval": 2e-4,
                "left_columns_element": "euler_beam", "right_columns_element": "euler_beam"},
    "reduction": {name: {"model": "modal", "modal_vectors": 12} for name in ("left", "right")},
    "motions": {"choose": 3, "correlation": 0.4, "between_samples": True,
                "x": {"target": str(two_buildings.FOLDER / "ground.csv"),
                      "options": {"duration": 6, "envelope": "0.3,4"}}},
    "levels": [2.0, 5.0],
    "gaps": [0.01],
    "joints": {"floor1": {"shape": "0.001,0", "deviation": {"deviation": 0.001}}, "floor2": {}},
    "capacities": [{"probe": "left_roof", "direction": "x", "band": "20,60", "damping": 0.05, "acceleration": 8}],
    "full_order": {"share": 0.1},
    "frequencies": [1, 2, 5, 10, 20, 50, 100],
    "dampings": [0.02, 0.05],
}
MEMBERS = 3 * 2 * 2 + 1


class Study(unittest.TestCase):
    def setUp(self):
        self.place = Path(tempfile.mkdtemp(prefix="pounding-"))

    def fragility(self, *words, status=0, out="out", **changes):
        """Runs the command in the folder, with results in `out` there."""
        with self.start(*words, out=out, **changes) as job:
            said, failed = job.communicate(timeout=600)
        done = subprocess.CompletedProcess(job.args, job.returncode, said, failed)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def start(self, *words, out="out", **changes):
        (self.place / "study.yaml").write_text(yaml.safe_dump({**STUDY, **changes}))
        line = [os.path.join(program.SOURCE, "run", "fragility"), "study.yaml", *words, "--out", out]
        return subprocess.Popen(line, cwd=self.place, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                env={**os.environ, "POUNDING_BUILD": os.path.abspath(program.BUILD)})

    def tables(self, folder="out"):
        return {path.name: path.read_bytes() for path in sorted((self.place / folder).rglob("*.csv"))
                if "runs" not in path.parts}

    def refuse(self, part, *words, **changes):
        (self.place / "study.yaml").write_text(yaml.safe_dump({**STUDY, **changes}))
        said = refused_where_it_is_read(self.place / "study.yaml") or self.fragility(*words, status=1, **changes).stderr
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertIn(part, said)

    @program.long
    def test_parts_make_the_whole_and_tables_say_what_the_members_did(self):
        self.fragility("--part", "1/2", "--runner", "single", "--jobs", "2")
        self.refuse("are not there yet", "--collect")
        self.fragility("--part", "2/2", "--runner", "single", "--jobs", "2")
        said = self.fragility("--collect").stdout
        self.assertIn(f"{MEMBERS} runs: 3 samples of motion and building at 2 levels", said)
        for end in ("Doubt: structure left: its modes end at", "Doubt: structure left: its mesh carries waves up to"):
            self.assertIn(end, said)
            self.assertIn(end, (self.place / "out" / "fragility.html").read_text())
        self.check_tables()
        self.check_full_order()
        before = self.tables()
        again = self.fragility("--runner", "single")  # nothing to do, and the same to the bit
        self.assertNotIn("at a time", again.stdout)
        self.assertEqual(self.tables(), before)
        self.check_ensemble()
        # Another level: its members only, and those of the two before stay.
        more = self.fragility("--runner", "single", "--jobs", "2", levels=[2.0, 5.0, 6.0], full_order={"share": 0})
        self.assertIn("6 runs, 0 finished before", more.stdout)
        self.assertIn("The runs apart say of 9 of 9", more.stdout)

    @program.long
    def test_ensembles_give_one_table_on_any_ranks_and_interrupted(self):
        """Sixteen members and more, so that there are groups of eight for both ranks."""
        study = {"levels": [2.0, 5.0, 6.0], "full_order": {"share": 0},
                 "factors": {"left_stiffness_factor": {"distribution": "lognormal", "cov": 0.1}}}
        self.fragility("--runner", "ensemble", "--ranks", "1", out="one", **study)
        self.fragility("--runner", "ensemble", "--ranks", "2", out="two", **study)
        expected = self.tables("one")
        self.assertIn("probability.csv", expected)
        self.assertEqual(self.tables("two"), expected)
        # Stopped when a part of the members is done, or before any is, or not in time at all: the same in the end.
        with self.start("--runner", "ensemble", out="stopped", **study) as job:
            deadline = time.monotonic() + 300
            while job.poll() is None and time.monotonic() < deadline and not self.finished("stopped"):
                time.sleep(0.02)
            job.send_signal(signal.SIGTERM)
            failed = job.communicate(timeout=120)[1]
        if job.returncode:
            self.assertIn("the same command goes on from here", failed)
        self.assertEqual(subprocess.run(["pgrep", "-f", str(self.place / "stopped")], check=False).returncode, 1,
                         "a run goes on without the command")
        self.fragility("--runner", "ensemble", "--ranks", "2", out="stopped", **study)
        self.assertEqual(self.tables("stopped"), expected)

    def check_ensemble(self):
        """Members of an ensemble are what the single runs were."""
        self.fragility("--runner", "ensemble", out="many", full_order={"share": 0})
        single = [row for row in program.rows_of(self.place / "out" / "members.csv") if row["disturbed"] == "0"]
        many = program.rows_of(self.place / "many" / "members.csv")
        self.assertEqual(len(many), len(single))
        for own, other in zip(many, single):
            self.assertEqual(own["impacts"], other["impacts"])
            for key in ("impulses [N s]", "smallest gap floor1 [m]", "smallest gap floor2 [m]"):
                self.assertAlmostEqual(float(own[key]), float(other[key]), delta=1e-7 + 1e-6 * float(other[key]))

    def finished(self, folder):
        """Whether an ensemble has written of a member that is done."""
        return any("about" in log.read_text() for log in (self.place / folder).glob("runs/*/ensemble-*/log.txt"))

    def check_tables(self):
        out = self.place / "out"
        members = [row for row in program.rows_of(out / "members.csv") if row["disturbed"] == "0"]
        self.assertEqual(len(members), MEMBERS - 1)
        for row in program.rows_of(out / "probability.csv"):
            if row["event"] != "contact":
                continue
            hits = sum(int(one["impacts"]) > 0 for one in members
                       if (one["gap [m]"], one["pga [m/s2]"]) == (row["gap [m]"], row["pga [m/s2]"]))
            self.assertEqual((int(row["hits"]), int(row["of"])), (hits, 3))
            low, high = fragility.binomial_interval(hits, 3)
            self.assertAlmostEqual(float(row["low"]), low)
            self.assertAlmostEqual(float(row["high"]), high)
        touched = [int(row["impacts"]) > 0 for row in members if row["gap [m]"] == "0.01"]
        self.assertTrue(any(touched))
        self.assertFalse(any(int(row["impacts"]) for row in members if row["gap [m]"] == "apart"))
        # Spectra: against single runs of the three samples, made here.
        found = program.rows_of(out / "spectra" / "gap-0.01_pga-5.csv")
        design = program.rows_of(out / "design.csv")
        spectra = []
        for sample, row in enumerate(design):
            off = float(row["floor1_gap deviation [m]"])
            options = {**STUDY["options"], "motion_x_seed": row["motion x"], "motion_x_duration": 6,
                       "motion_x_envelope": "0.3,4", "motion_x_pga": 5,
                       "floor1_gap": f"{0.011 + off:.9g},{0.01 + off:.9g}", "floor2_gap": 0.01,
                       "spectra_frequencies": STUDY["frequencies"], "spectra_damping": STUDY["dampings"],
                       **{f"{name}_{key}": value for name, one in STUDY["reduction"].items()
                          for key, value in one.items()}}
            run = pounding.run(two_buildings.SCENE, self.place / f"own-{sample}", 1, **options)
            spectra.append(run.spectrum("left_roof", "x", 0.05)[1])
        mine = [row for row in found if row["channel"] == "left_roof x" and row["damping"] == "0.05"]
        for key, values in (("mean", np.mean(spectra, 0)), ("median", np.median(spectra, 0)),
                            ("p84", np.quantile(spectra, 0.84, 0)), ("envelope", np.max(spectra, 0)),
                            ("cov", np.std(spectra, 0, ddof=1) / np.mean(spectra, 0))):
            np.testing.assert_allclose([float(row[key]) for row in mine], values, rtol=2e-5, err_msg=key)
        # The joint that a run apart asks for is what its roofs moved towards each other.
        joint = [row for row in program.rows_of(out / "joint.csv") if row["joint"] == "floor2"]
        self.assertGreater(float(joint[1]["50 % [m]"]), 0.01)
        self.assertAlmostEqual(float(joint[1]["50 % [m]"]) / float(joint[0]["50 % [m]"]), 2.5, delta=1e-3)
        self.assertGreater(float(joint[1]["ABS [m]"]), float(joint[1]["SRSS [m]"]))
        self.assertAlmostEqual(float(joint[1]["EN 1998-1, level floors [m]"]), 0.7 * float(joint[1]["SRSS [m]"]))
        for name in ("fragility.png", "curves.png", "enough.png", "joint.png"):
            self.assertTrue((out / name).read_bytes().startswith(b"\x89PNG"), name)
        page = (out / "fragility.html").read_text()
        self.assertIn("<table", page)
        self.assertLess(page.index('<div class="answer'), page.index("So that no joint closes"))
        self.assertLess(page.index("So that no joint closes"), page.index("<nav>"))
        caption = re.search(r"<caption>84 % of the members in a joint of (\S+) mm at (\S+) m/s², 5 % damping, widened by 15 %.*?</table>",
                            page, re.DOTALL)
        cell = program.rows_of(out / "spectra" / f"gap-{float(caption[1]) / 1e3:g}_pga-{caption[2]}.csv")
        widened = {f"{float(row['frequency']):g}": float(row["p84_widened"]) for row in cell
                   if row["channel"] == "left_roof x" and row["damping"] == "0.05"}
        head = re.findall("<th[^>]*>(.*?)</th>", caption[0])[1:]
        shown = re.search("<td>left_roof x, with pounding</td>(.*?)</tr>", caption[0])[1]
        shown = dict(zip(head, re.findall("<td>(.*?)</td>", shown)))
        self.assertEqual({f: shown[f] for f in widened}, {f: f"{value:.3g}" for f, value in widened.items()})
        rows = [row for row in program.rows_of(out / "joint.csv") if row["joint"] == "any"]
        widths = " mm at 2 m/s2 .*; ".join(f"{1e3 * float(row['5 % [m]']):.3g}" for row in rows)
        self.assertRegex(page, f"So that no joint closes in 95 % of the cases it must be as wide as {widths} mm at 5 m/s2")

    def test_equipment_fails_as_in_single_runs_and_joints_differ_by_sample(self):
        (self.place / "relay.csv").write_text("1,20\n100,20\n")
        item = {"equipment": "relay", "relay_probe": "left_roof", "relay_direction": "x", "relay_capacity_unit": "m/s2",
                "relay_capacity": str(self.place / "relay.csv"), "relay_dip": 0.05}
        field = {"deviation": 0.002, "length": 1.5}
        study = {"options": {**STUDY["options"], **item}, "full_order": {"share": 0}, "capacities": [], "levels": [5.0],
                 "joints": {"floor1": {"field": field}, "floor2": {"field": field}}, "exchange": True,
                 "field_factors": [[3, 1], [1, 0.5]]}
        said = self.fragility("--runner", "ensemble", "--ranks", "2", **study).stdout
        rows = [row for row in program.rows_of(self.place / "out" / "probability.csv") if row["event"].startswith("relay fails")]
        found = {row["gap [m]"]: int(row["hits"]) for row in rows}

        def joint_of(owner, deviation):
            return {f"{floor}_{key}": value for floor in ("floor1", "floor2") for key, value in (
                ("gap", 0.01), ("gap_deviation", deviation), ("gap_length", 1.5), ("gap_seed", 100000 + owner))}

        failed, gaps, spectra, wider = 0, set(), {}, []
        for sample, row in enumerate(program.rows_of(self.place / "out" / "design.csv")):
            motion = {**study["options"], "motion_x_seed": row["motion x"], "motion_x_duration": 6, "motion_x_pga": 5,
                       "motion_x_envelope": "0.3,4", "spectra_frequencies": STUDY["frequencies"],
                       "spectra_damping": STUDY["dampings"],
                       **{f"{name}_{key}": value for name, one in STUDY["reduction"].items()
                          for key, value in one.items()}}
            run = pounding.run(two_buildings.SCENE, self.place / f"{sample}-wider", 1, **motion, **joint_of(sample, 0.006))
            wider.append(run.spectrum("left_roof", "x", 0.05)[1])
            for owner in (sample, (sample + 1) % 3):
                joint = joint_of(owner, 0.002)
                run = pounding.run(two_buildings.SCENE, self.place / f"{sample}-{owner}", 1, **motion, **joint)
                spectra[sample, owner] = np.log(run.spectrum("left_roof", "x", 0.05)[1])
                if owner != sample:
                    continue
                failed += not run.verdicts["relay"]["passes"]
                gaps.add(tuple(run.summary["contacts"]["floor1"]["initial_gap"]))
        self.assertRegex(said, f"relay fails at 5 m/s2 in {100 * failed / 3:.3g} % in a joint of 10 mm .*, "
                         f"{100 * found['apart'] / 3:.3g} % apart")
        self.assertEqual(found["0.01"], failed)
        self.assertGreater(failed, found["apart"])
        self.assertEqual(len(gaps), 3)
        # The scatter that joints and motions make alone is that of the single runs.
        rows = [row for row in program.rows_of(self.place / "out" / "scatter.csv")
                if row["channel"] == "left_roof x" and row["damping"] == "0.05"]
        ring = [(sample, (sample + 1) % 3) for sample in range(3)]
        joint = sum((spectra[a, a] - spectra[a, b]) ** 2 for a, b in ring) / 6
        motion = sum((spectra[b, b] - spectra[a, b]) ** 2 for a, b in ring) / 6
        for name, expected in (("joint", joint), ("motion", motion)):
            np.testing.assert_allclose([float(row[name]) for row in rows], expected**0.5, rtol=2e-3, atol=1e-6, err_msg=name)
        self.assertGreater(max(joint), 1e-4)
        self.assertIn("the joint's own width makes", said)
        members = program.rows_of(self.place / "out" / "members.csv")
        self.assertEqual([row["exchanged"] for row in members], 3 * ["0", "0", "1"] + 6 * ["0", "1"])
        # Other fields: the 84 % spectra of single runs in fields of thrice the deviation.
        rows = [row for row in program.rows_of(self.place / "out" / "fields.csv") if row["channel"] == "left_roof x"]
        self.assertEqual([(row["deviation times"], row["length times"]) for row in rows[::len(rows) // 3]],
                         [("1.0", "1.0"), ("3.0", "1.0"), ("1.0", "0.5")])
        own = np.quantile([np.exp(spectra[a, a]) for a in range(3)], 0.84, 0)
        frequencies = run.spectrum("left_roof", "x", 0.05)[0]
        for row in (row for row in rows if row["deviation times"] == "3.0"):
            low, high = map(float, row["band [Hz]"].split("-"))
            ratio = (np.quantile(wider, 0.84, 0) / own)[(frequencies >= low) & (frequencies <= high)]
            self.assertAlmostEqual(float(row["84 % ratio, median"]), np.median(ratio), delta=2e-3)
            self.assertAlmostEqual(float(row["84 % ratio, furthest"]), ratio[abs(np.log(ratio)).argmax()], delta=2e-3)
        self.assertTrue(any(abs(float(row["84 % ratio, furthest"]) - 1) > 0.02 for row in rows))
        self.assertRegex(said, "Fields of 3 times the deviation and 1 times the length make the 84 % spectra")
        self.assertTrue((self.place / "out" / "scatter.png").is_file())
        self.refuse("joints: floor1: field: length", joints={"floor1": {"field": {"deviation": 0.002}}})
        self.refuse("relay.csv", options={**study["options"], "relay_capacity": "other/relay.csv"})

    def check_full_order(self):
        rows = program.rows_of(self.place / "out" / "full_order.csv")
        error = {row["channel"]: float(row["rms"]) for row in rows}
        self.assertEqual(set(error), {"left_roof x", "left_roof z"})  # y only trembles
        self.assertGreater(error["left_roof x"], 1e-4)  # 12 modes are not the model
        self.assertLess(error["left_roof x"], 0.1)
        self.assertGreater(error["left_roof z"], 1.0)  # they hold none of what the slab does up and down
        self.assertLess(max(float(row["rms of noise"]) for row in rows), 0.2)

    def test_mistakes_are_one_line(self):
        self.refuse("levls is unknown", levls=[1])
        self.refuse("levels: [3, 2] does not increase", levels=[3, 2])
        self.refuse("scene: nothing.yaml: no such file", scene="nothing.yaml")
        self.refuse("band: '1000,2000' is not two frequencies",
                    capacities=[{**STUDY["capacities"][0], "band": "1000,2000"}])
        self.refuse("joints is missing", joints={})
        self.refuse("exchange: 1 is neither true nor false", exchange=1)
        self.refuse("makes no difference: no joint has a deviation", exchange=True, joints={"floor1": {}})
        self.refuse("makes no difference: no joint has a field", field_factors=[[2, 1]])
        self.refuse("is not two factors", field_factors=[[1, 1]])
        self.refuse("output is the study's own", options={"output": "x"})
        self.refuse("needs either records or a target", motions={"x": {}})
        self.refuse("goes with another distribution", joints={"floor1": {"deviation": {"cov": 0.1}}})
        self.refuse("neither <structure>_stiffness_factor", factors={"left_mass": {"deviation": 1}})
        self.assertFalse((self.place / "out").exists())

    def test_motions_are_judged_by_a_table_of_rules(self):
        """A table flags motions and is not in the way of the study; one that is none is told in a line."""
        one = {"x": {**STUDY["motions"]["x"], "seeds": [1, 2]}, "correlation": 0.9}
        table = self.place / "rules.csv"
        for least, words in ((1, "The motions are accepted by the rules of rules.csv"),
                             (100, "Doubt: motions are refused by the rules of rules.csv (the test): long: 6 for >= 100, 2 of 2 refused, worst 5.9")):
            table.write_text(("# source: the test\n" if least > 1 else "") + f"name,kind,least\nlong,length,{least}\n")
            said = self.fragility("--dry-run", motions=one, motion_rules="rules.csv").stdout
            self.assertIn(words[:90], said)
        row = program.rows_of(self.place / "out" / "motion_rules.csv")[0]
        self.assertEqual((row["verdict"], row["looked_at"], row["refused"]), ("refused", "2", "2"))
        table.write_text("name,kind\nlong,width\n")
        self.refuse("motion_rules: rules.csv, line 2: kind 'width' is none of", motions=one, motion_rules="rules.csv")
        self.refuse("motion_rules: none.csv: no such table of rules", motions=one, motion_rules="none.csv")

    def test_motions_are_matched_to_the_targets_of_the_rules(self):
        """Synthetic motions that a target refuses are accepted once they are matched to it, and members get their peaks."""
        one = {"x": {**STUDY["motions"]["x"], "seeds": [1, 2]}, "correlation": 0.9}
        (self.place / "rules.csv").write_text("name,kind,least,most,grid,target,pga,directions\n"
                                              "below,largest_below,,10,1:20:30log,rg160_horizontal,anchor,x\n")
        said = self.fragility("--dry-run", motions=one, motion_rules="rules.csv").stdout
        self.assertIn("Doubt: motions are refused by the rules of rules.csv", said)
        for turn in range(2):  # matched once
            said = self.fragility("--dry-run", motions=one, motion_rules="rules.csv", match={}).stdout
            self.assertEqual(said.count(" matched, accepted"), 2 if turn == 0 else 0)
            self.assertIn("The motions are matched to the targets of rules.csv, match.csv.", said)
            self.assertIn("The motions are accepted by the rules of rules.csv", said)
        rows = program.rows_of(self.place / "out" / "match.csv")
        self.assertEqual([row["motion"] for row in rows], ["1", "2"])
        for row in rows:
            self.assertLess(abs(float(row["change of peak displacement [%]"])), 5)
        read = study.read(self.place / "study.yaml")
        matching.make(read, motions.Motions(read, self.place / "out" / "motions", 1), motions.STEP, None)
        for number, row in enumerate(rows):
            record, pga = design.motion_values(read, number, 2.0)
            found = np.loadtxt(record, delimiter=",", skiprows=2)[:, 1]
            self.assertAlmostEqual(float(pga) / (2 / 5 * abs(found).max()), 1, delta=1e-8)  # as much over 5 m/s2 as over 2
            self.assertAlmostEqual(float(row["peak over that of the level"]) / float(pga) * 2, 1, delta=1e-5)
        self.refuse("match: goes with motion_rules", match={})
        self.refuse("match: least is unknown", motion_rules="rules.csv", match={"least": 1})

    @program.long
    def test_motions_that_depend_on_each_other_are_told(self):
        seeds = {"correlation": 1e-4, "between_samples": True, "x": {**STUDY["motions"]["x"], "seeds": [1, 2]}}
        self.refuse("1 of 1 pairs are correlated by 0.0001 or more, x 1 and x 2 by", "--dry-run", motions=seeds)
        self.refuse("joints: roof", "--dry-run", joints={"roof": {"shape": "1,2,3"}})
        # Without a word it is the limit of components that act together: two samples may depend on each other.
        free = {"correlation": 1e-4, "x": {**STUDY["motions"]["x"], "seeds": [1, 2]}}
        said = self.fragility("--dry-run", out="free", motions=free).stdout
        self.assertRegex(said, "largest correlation of two motions of different samples 0\\.[0-9]+;")
        self.assertNotIn("motions made", said)  # two are made at once
        many = {"correlation": 0.16, "choose": 6, "x": STUDY["motions"]["x"]}
        self.assertIn("fragility: 6 of 12 motions made", self.fragility("--dry-run", out="many", motions=many).stdout)
        both = {**free, "y": {**STUDY["motions"]["x"], "seeds": [2, 1]}}
        self.refuse("2 of 2 pairs are correlated by 0.0001 or more", "--dry-run", motions=both)
        told = {"correlation": 0.9, "x": {**STUDY["motions"]["x"], "seeds": [1, 2]}}
        factor = {"left_stiffness_factor": {"distribution": "lognormal", "cov": 0.1}}
        self.refuse("floor9_gap", "--dry-run", motions=told, joints={"floor9": {}})
        self.refuse("left_p_delta", "--dry-run", motions=told, factors=factor, reduction={},
                    options={**STUDY["options"], "left_p_delta": True})
        self.refuse("'cab' is no probe", "--dry-run", motions=told, reduction={},
                    capacities=[{**STUDY["capacities"][0], "probe": "cab"}])
        record = program.write_samples(np.sin(np.arange(300) / 9), 0.01)
        twice = {"between_samples": True, "x": {"records": [record, record], "options": {"unit": "m/s2"}}}
        self.refuse("x " + os.path.basename(record), "--dry-run", motions=twice)


if __name__ == "__main__":
    unittest.main()
