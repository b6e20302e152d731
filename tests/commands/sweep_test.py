"""run/sweep over two small buildings: members, table, resuming, failures."""
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import program
import two_buildings
from two_buildings import pounding

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
from pounding.sweep import members, table  # noqa: E402

PROCESSORS = 2  # it starts runs

FIXED = " ".join(f"-{name} {value}" for name, value in two_buildings.SHORT.items()) + " -probes left_roof"
BRIEF = FIXED.replace("-end_time 1.2", "-end_time 0.1")
GAPS = "floor1_gap,floor2_gap=0.01,0.06"


def sweep(folder, *words, scene="two-buildings.yaml", options=FIXED, more=()):
    """Runs the command in the folder, with results in `out` there."""
    line = [os.path.join(program.SOURCE, "run", "sweep"), scene, "--options", options, "--out", "out", *more]
    for word in words:
        line += ["--set", word]
    return subprocess.run(line, cwd=folder, capture_output=True, text=True, timeout=300, check=False,
                          env={**os.environ, "POUNDING_BUILD": os.path.abspath(program.BUILD)})


class Sweep(unittest.TestCase):
    def setUp(self):
        self.place = Path(tempfile.mkdtemp(prefix="pounding-"))
        for path in two_buildings.FOLDER.iterdir():
            shutil.copy(path, self.place)

    def times(self):
        return {path.parent.name: path.stat().st_mtime_ns for path in self.place.glob("out/*/summary.json")}

    def test_table_resuming_and_changed_files(self):
        done = sweep(self.place, GAPS, "motion_x_pga=4", more=["--ranks", "2", "--jobs", "1"])
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        rows = program.rows_of(self.place / "out" / "sweep.csv")
        self.assertEqual([row["floor1_gap,floor2_gap"] for row in rows], ["0.01", "0.06"])
        for row in rows:
            run = pounding.load(self.place / "out" / row["folder"])
            self.assertEqual(run.summary["options"]["floor2_gap"], row["floor1_gap,floor2_gap"])
            self.assertEqual(int(row["impacts"]), len(run.impacts["impulse"]))
            strongest = max(run.impacts["impulse"], default=0)  # of nine digits
            self.assertAlmostEqual(float(row["strongest impulse [N s]"]), strongest, delta=1e-8 * strongest)
            frequency, values = run.spectrum("left_roof", "x")
            self.assertAlmostEqual(float(row["peak PSA left_roof.x [m/s2]"]), values.max(), delta=1e-9)
            self.assertAlmostEqual(float(row["at left_roof.x [Hz]"]), frequency[values.argmax()], delta=1e-9)
        self.assertGreater(int(rows[0]["impacts"]), 0)
        self.assertEqual(int(rows[1]["impacts"]), 0)
        self.assertTrue((self.place / "out" / "sweep.png").read_bytes().startswith(b"\x89PNG"))
        page = (self.place / "out" / "sweep.html").read_text()
        wide = pounding.load(self.place / "out" / rows[1]["folder"])
        margin = min(wide.closing_factors().values())
        self.assertAlmostEqual(float(rows[1]["closing factor"]) / margin, 1, delta=1e-9)
        self.assertEqual(rows[0]["closing factor"], "")
        opening = (f"The joint floor1_gap,floor2_gap: at motion_x_pga 4 it closes up to 10 mm and stays open from 60 mm with a "
                   f"margin of {margin:.3g} on the motion; one motion gives no confidence.")
        self.assertIn(opening, page)
        self.assertIn(opening, done.stdout)
        self.assertLess(page.index(opening), page.index("<table"))
        before = self.times()
        # One more value, on another number of ranks: the finished ones stay.
        again = sweep(self.place, GAPS + ",0.03", "motion_x_pga=4")
        self.assertIn("3 runs, 2 finished before", again.stdout)
        after = self.times()
        self.assertEqual({name: after[name] for name in before}, before)
        # Another mesh or another target of the motion is another run.
        for name in ("building.geo", "ground.csv"):
            with open(self.place / name, "a") as file:
                file.write("// changed\n" if name.endswith(".geo") else "# changed\n")
            self.assertIn("1 runs, 0 finished before", sweep(self.place, "floor1_gap,floor2_gap=0.06",
                                                             "motion_x_pga=4").stdout)

    def test_several_motions_have_a_confidence(self):
        """Rows as of a sweep: of four motions one closes the joint of 10 mm."""
        axes = [members.read_axis("floor1_gap=0.01,0.02"), members.read_axis("motion_x_seed=1,2,3,4")]
        rows = [{"floor1_gap": gap, "motion_x_seed": seed, "status": "ok", "impacts": int((gap, seed) == ("0.01", "3")),
                 "closing factor": 1.5 if gap == "0.01" else 3.0} for gap in axes[0].values for seed in axes[1].values]
        said, = table.sentences(rows, axes)
        self.assertEqual(said, "The joint floor1_gap: closes up to 10 mm in 1 of 4 motions (0.63 to 81 % at 95 % confidence) and "
                               "stays open from 20 mm with a margin of 3 on the motion.")
        said, = table.sentences(rows[:4], axes[1:])
        self.assertEqual(said, "The buildings touch in 1 of 4 motions (0.63 to 81 % at 95 % confidence) with a margin of 1.5 on "
                               "the motion.")
        self.assertEqual(table.sentences([{**row, "status": "failed"} for row in rows], axes), [])

    def test_a_failed_member_is_told_and_stops_no_other(self):
        done = sweep(self.place, "floor1_gap=0.06,wide,0.05", options=BRIEF)
        self.assertEqual(done.returncode, 1)
        self.assertIn("3 members, 1 failed", done.stdout)
        self.assertIn("option -floor1_gap wide", done.stdout)
        rows = program.rows_of(self.place / "out" / "sweep.csv")
        self.assertEqual([row["status"] == "ok" for row in rows], [True, False, True])
        self.assertIn("floor1_gap", rows[1]["status"])
        self.assertEqual(rows[1]["impacts"], "")

    def test_zip_pairs_the_values_and_semicolons_part_lists(self):
        done = sweep(self.place, "floor2_gap=0.03,0.02;0.06", "motion_x_pga=1;2", options=BRIEF, more=["--zip"])
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual([(row["floor2_gap"], row["motion_x_pga"]) for row in program.rows_of(self.place / "out" / "sweep.csv")],
                         [("0.03,0.02", "1"), ("0.06", "2")])

    def test_mistakes_are_one_line(self):
        for words, part in (((["floor1_gap"]), "expected NAME="), (["floor1_gap="], "empty value"),
                            (["floor1_gap=1,,2"], "empty value"), (["output=a,b"], "not with output"), (["floor1_gap=1,-end_time"], "would be an option"),
                            (["floor1_gap=1,1"], "stands twice"), (["floor1_gap=1", "floor1_gap=2"], "set twice")):
            done = sweep(self.place, *words)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), done.stderr)
            self.assertIn(part, done.stderr)
        done = sweep(self.place, "floor1_gap=1,2", "floor2_gap=1,2,3", more=["--zip"])
        self.assertIn("floor2_gap has 3", done.stderr)
        self.assertIn("nothing.yaml: no such file", sweep(self.place, "floor1_gap=1", scene="nothing.yaml").stderr)
        self.assertFalse((self.place / "out").exists())

    def test_stopped_it_goes_on_where_it_was(self):
        line = [os.path.join(program.SOURCE, "run", "sweep"), "two-buildings.yaml", "--options", f"{FIXED} -end_time 3",
                "--out", "out", "--jobs", "1", "--set", "floor2_gap=0.05,0.06,0.07"]
        environment = {**os.environ, "POUNDING_BUILD": os.path.abspath(program.BUILD)}
        process = subprocess.Popen(line, cwd=self.place, env=environment, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not list(self.place.glob("out/*/request.json")):
            time.sleep(0.05)
        process.send_signal(2)
        _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1)
        self.assertIn("the same command goes on", said)
        finished = len(list(self.place.glob("out/*/request.json")))
        self.assertIn(finished, (1, 2))
        done = subprocess.run(line, cwd=self.place, env=environment, capture_output=True, text=True, timeout=300,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"3 runs, {finished} finished before", done.stdout)


if __name__ == "__main__":
    unittest.main()
