"""run/benchmark and run/scaling on tiny models: every row is there and every figure positive, the
model adds up. How long a step takes is not tested."""
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import program

sys.path.insert(0, os.path.join(program.SOURCE, "run"))
sys.dont_write_bytecode = True
from parts.benchmark import ensembles, instructions, scenes, workers  # noqa: E402
from parts.benchmark.comparison import check_agreement  # noqa: E402
from parts.benchmark.machine import Series  # noqa: E402
from parts.benchmark.scaling_model import CostCurve, Messages, Model, Network, undivided  # noqa: E402
from parts.benchmark.workers import MeasuringError, block_cells, slab_cells, storey_dofs  # noqa: E402

PROCESSORS = 2  # it measures on two ranks

WAYS = ["element", "aij", "sbaij", "octave"]
SHORT = ["--quick", "--rounds", "1", "--seconds", "0.02"]


def script(name, *words):
    return subprocess.run([os.path.join(program.SOURCE, "run", name), *[str(word) for word in words]],
                          env={**os.environ, "POUNDING_BUILD": os.path.abspath(program.BUILD)},
                          capture_output=True, text=True, timeout=1200)


def measured_once(test, kind, value, ranks):
    """Rows of what run/benchmark --KIND VALUE leaves after one round; its table is printed as well."""
    folder = tempfile.mkdtemp(prefix="pounding-")
    result = script("benchmark", f"--{kind}", value, "--ranks", ranks, "--rounds", 1, "--output", folder)
    test.assertEqual(result.returncode, 0, result.stderr[-3000:])
    with open(os.path.join(folder, f"{kind}.md")) as file:
        test.assertIn(file.read(), result.stdout)
    return program.rows_of(os.path.join(folder, f"{kind}.csv"))


class Measured(unittest.TestCase):
    def run_script(self, name, *words):
        self.folder = tempfile.mkdtemp(prefix="pounding-")
        result = script(name, *SHORT, "--output", self.folder, *words)
        self.assertEqual(result.returncode, 0, result.stderr[-3000:])
        with open(os.path.join(self.folder, "table.md")) as file:
            self.assertIn(file.read(), result.stdout)
        with open(os.path.join(self.folder, f"{name}.json")) as file:
            return program.rows_of(os.path.join(self.folder, "table.csv")), json.load(file)

    def assert_positive(self, row, *columns):
        for column in columns:
            self.assertGreater(float(row[column] or "nan"), 0, (column, row))


class Benchmark(Measured):
    def test_every_way_on_one_rank_and_the_programs_on_two(self):
        rows, result = self.run_script("benchmark", "--sizes", "3k")
        dofs = 3 * 22 * 23 * 2
        self.assertEqual([(int(row["dofs"]), int(row["ranks"]), row["way"]) for row in rows],
                         [(dofs, 1, way) for way in WAYS] + [(dofs, 2, way) for way in WAYS[:3]])
        for row in rows:
            if row["way"] == "octave" and row["note"].startswith("not installed"):
                continue
            self.assert_positive(row, "microseconds_per_step", "nanoseconds_per_dof", "lowest",
                                 "highest", "ratio_to_element", "ratio_to_triad")
            self.assertAlmostEqual(float(row["microseconds_per_step"]) * 1e3 / dofs,
                                   float(row["nanoseconds_per_dof"]), delta=1e-6 * dofs)
            if row["way"] == "element":
                self.assert_positive(row, "memory_per_dof")
        machine = result["machine"]
        self.assertEqual(sorted(machine["multiply_adds"]), ["1", "2"])
        self.assertEqual(len(machine["triad"]), 2)
        for figure in [*machine["multiply_adds"].values(), *machine["triad"]]:
            self.assertTrue(all(value > 0 for value in figure["rounds"]), figure)

    def test_wrong_options_are_refused(self):
        for words in (["--sizes", "0"], ["--rounds", "none"], ["--ranks", "1,-2"], ["--fast"]):
            self.assertEqual(script("benchmark", *words).returncode, 2, words)


class Instructions(unittest.TestCase):
    def test_kinds(self):
        for line, kinds in (("vfmadd231pd 0x40(%rax),%zmm1,%zmm2", {"arithmetic", "loads"}), ("vaddpd %zmm0,%zmm1,%zmm2", {"arithmetic"}),
                            ("vmovupd %zmm1,0x8(%rax,%rbx,8){%k1}", {"stores"}), ("vmovupd (%rax),%zmm1{%k1}{z}", {"loads"}),
                            ("vmulpd 0x8(%rax){1to8},%zmm0,%zmm1", {"arithmetic", "loads"}), ("valignq $0x7,%zmm1,%zmm2,%zmm3", {"shuffles and masks"}),
                            ("mov %rax,(%rsp)", {"stores"}), ("lea 0x8(%rax),%rcx", set()), ("cmp %rax,0x8(%rsp)", {"loads"})):
            mnemonic, operands = line.split()
            self.assertEqual(set(instructions.kinds_of(mnemonic, operands)) - {"instructions"}, kinds, line)

    def test_a_small_slab(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(instructions.CASES, {"slab": instructions.Shape("slab", (6, 6, 1))}), \
                mock.patch.dict(os.environ, {"POUNDING_BUILD": os.path.abspath(program.BUILD)}):
            place = Path(folder)
            try:
                rows = instructions.measure(workers.build(), place, workers.write_motion(place / "motion.txt"), "slab", 1, 0.01)
            except MeasuringError as error:
                if "tracing is forbidden" in str(error) or "on x86-64 alone" in str(error):
                    self.skipTest(str(error))
                raise
            for unit in {row["unit"] for row in rows}:
                whole, *functions = (row for row in rows if row["unit"] == unit)
                self.assertEqual(whole["dofs"], 6 * 7 * 2 * 3)
                for kind in instructions.KINDS:
                    self.assertAlmostEqual(whole[kind], sum(row[kind] for row in functions), delta=1e-9 * whole[kind])
                self.assertIn("StructureStep::advance_in_order", {row["function"] for row in functions})
                self.assertLess(0.5, whole["arithmetic"])
                self.assertLess(whole["arithmetic"], whole["instructions"])
            wholes = [row["instructions"] for row in rows if row["function"] == instructions.WHOLE]
            self.assertEqual(sorted(set(wholes)), wholes)  # fewer by wider vectors
            self.assertIn("instructions per dof", instructions.write(place, rows))


class Scenes(unittest.TestCase):
    def test_numbers_of_dry_runs(self):
        few = scenes.Group("few", scenes.STEP, {"small": scenes.scene("plant/small", "-modes", 0)})
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(scenes.GROUPS, {"few": few}), \
                mock.patch.dict(os.environ, {"POUNDING_BUILD": os.path.abspath(program.BUILD)}):
            rows = scenes.measure(Path(program.BUILD).resolve(), "few", [1, 2], 1)
            text = scenes.write(Path(folder), "few", rows)
        self.assertEqual([(row["scene"], row["ranks"]) for row in rows], [("small", 1), ("small", 2)])
        for row in rows:
            self.assertGreater(row["minutes"], 0)
            self.assertGreater(row["step"], row["mesh"] / 10)
            self.assertGreater(row["gmsh"], 0)
            self.assertGreater(row["seconds"], row["modes_seconds"])
        self.assertEqual(rows[0]["dofs"], 5322)
        self.assertLess(rows[0]["undamped_over_stable"], 1.3)  # what uniform damping promises
        self.assertGreater(rows[0]["undamped_over_stable"], 1)
        self.assertIn("| small | 5322 | ", text)
        self.assertEqual(text.splitlines()[4].count(" / "), 3, text)  # what ranks change

    def test_what_dry_runs_do_not_say_is_a_fault(self):
        with self.assertRaisesRegex(MeasuringError, "no '.*microseconds per step' in what the dry run says"):
            scenes.read("time step 1e-5 s (0.900 of the stable one), 100 steps to 1 s\n")

    def test_unknown_groups_are_refused(self):
        self.assertEqual(script("benchmark", "--scenes", "house").returncode, 2)


class Ensembles(unittest.TestCase):
    def test_tables_of_members_hold_every_level_of_a_motion(self):
        path = Path(tempfile.mkdtemp(prefix="pounding-"), "members.csv")
        ensembles.write_members(path, 5, [0.5, 1.0])
        self.assertEqual(path.read_text().splitlines(), ["motion_x_seed,motion_level", "1,0.5", "1,1.0", "2,0.5", "2,1.0",
                                                         "3,0.5"])

    @program.long
    def test_members_beside_single_runs(self):
        rows = measured_once(self, "ensembles", "8", 1)
        self.assertEqual([row["scene"] for row in rows], list(ensembles.CASES))
        for row in rows:
            self.assertLess(float(row["member_stepped_seconds"]), float(row["member_seconds"]))
            self.assertGreater(float(row["members_for_one_run"]), 0)


class Faces(unittest.TestCase):
    @program.long
    def test_faces_that_close_at_once(self):
        rows = measured_once(self, "faces", "5,12", 2)
        self.assertEqual([(int(row["rows"]), int(row["coupled_rows"])) for row in rows],
                         [(25, 25), (144, 144)])
        for row in rows:
            self.assertLess(float(row["residual"]), 1e-13, row)
            self.assertTrue(math.isfinite(float(row["contact_microseconds"])), row)  # few rows: below the noise


class Shapes(unittest.TestCase):
    @program.long
    def test_a_general_mesh_beside_one_in_rows(self):
        folder = tempfile.mkdtemp(prefix="pounding-")
        result = script("benchmark", "--shapes", "rectangles,triangles,skewed", "--ranks", 1, "--rounds", 1,
                        "--seconds", 0.01, "--output", folder)
        self.assertEqual(result.returncode, 0, result.stderr[-3000:])
        with open(os.path.join(folder, "shapes.md")) as file:
            self.assertIn(file.read(), result.stdout)
        rows = program.rows_of(os.path.join(folder, "shapes.csv"))
        self.assertEqual([(row["shape"], row["way"]) for row in rows],
                         [(shape, way) for shape in ("rectangles", "triangles", "skewed")
                          for way in ("element", "aij", "sbaij")])
        for row in rows:
            self.assertGreater(float(row["nanoseconds_per_dof"]), 0, row)
            self.assertGreater(float(row["ratio_to_element"]), 0, row)

    def test_unknown_shapes_are_refused(self):
        self.assertEqual(script("benchmark", "--shapes", "round").returncode, 2)


class Scaling(Measured):
    @program.long
    def test_measured_and_modelled_points(self):
        rows, result = self.run_script("scaling", "--apart", "1000,3000", "--pair", 8000, "--parts", "2,4,8",
                                       "--large", "100k", "--large-parts", "8,16", "--cores", 4, "--latency", 1e-6)
        measured = [row for row in rows if row["source"] == "measured"]
        self.assertEqual([(row["kind"], int(row["ranks"])) for row in measured],
                         [(kind, ranks) for kind in ("pair", "apart", "apart")
                          for ranks in (1, 2)])
        for row in measured:
            self.assert_positive(row, "dofs", "microseconds_per_step", "speed_up", "efficiency")
        large = [row for row in rows if row["kind"] == "large"]
        self.assertEqual([(int(row["ranks"]), int(row["divided"])) for row in large],
                         [(32, 1), (128, 1), (32, 5), (128, 5), (8, 5), (16, 5)])
        for row in large:
            self.assertEqual(int(row["dofs"]), storey_dofs(20 if int(row["ranks"]) >= 32 else 5))
            self.assert_positive(row, "between_microseconds", "mean_outer")
            self.assertLess(float(row["overlapped_microseconds"]), float(row["microseconds_per_step"]))
            self.assertEqual(int(row["contact_rows"]), 5103 if int(row["ranks"]) >= 32 else 378)
        for whole, fives in zip(large[:2], large[2:4]):
            for column in ("mean_held", "imbalance"):
                self.assertAlmostEqual(float(fives[column]) / float(whole[column]), 1, delta=0.1)
        modelled = [row for row in rows if row["source"] == "modelled" and row["kind"] == "pair"]
        self.assertEqual([int(row["ranks"]) for row in modelled], [1, 2, 4, 8])
        pair = {int(row["ranks"]): row for row in measured if row["kind"] == "pair"}
        self.assertEqual(int(pair[1]["dofs"]), storey_dofs(2))
        for row in modelled:
            parts = int(row["ranks"])
            terms = [float(row[f"{name}_microseconds"])
                     for name in ("compute", "within", "between", "exchange", "rows", "agreement")]
            self.assertAlmostEqual(sum(terms) / float(row["microseconds_per_step"]), 1, delta=1e-9)
            self.assertEqual((terms[1] > 0, terms[2] > 0, terms[5] > 0), (parts > 1, parts > 4, parts > 1))
            self.assertEqual(row["dofs"], pair[1]["dofs"])
            self.assertEqual(row["measured_microseconds"],
                             pair[parts]["microseconds_per_step"] if parts in pair else "")
        self.assertAlmostEqual(float(modelled[0]["microseconds_per_step"])
                               / float(pair[1]["microseconds_per_step"]), 1, delta=1e-9)
        self.check_partitions(result["partitions"][0]["parts"])

    @program.long
    def test_large_pairs_need_one_that_is_run(self):
        result = script("scaling", *SHORT, "--apart", "1000", "--pair", "500M", "--large", "100k")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, "--large needs a pair that is run on one rank; pair, .*: not run, needs about")

    def check_partitions(self, lines):
        for line in lines:
            parts = line["parts"]
            self.assertAlmostEqual(line["dofs_per_part"]["mean"] * parts, line["dofs"])
            self.assertAlmostEqual(line["received"]["mean"], line["sent"]["mean"])
            self.assertGreaterEqual(line["contact_rows_per_part"] * line["contact_members"], line["contact_rows"])
            self.assertLessEqual(line["contact_rows_per_part"], line["contact_rows"])
            self.assertEqual(line["contact_dofs_sent"] > 0, line["contact_partners"] > 0)
            self.assertLess(line["contact_partners"], parts)
            self.assertLess(line["neighbours"]["largest"], parts)
            self.assertLessEqual(line["messages"]["largest"], 2 * line["neighbours"]["largest"])
            held = line["elements_per_part"]["mean"] * parts
            (self.assertGreater if parts > 1 else self.assertEqual)(held, line["elements"])
            of_parts = line["of_parts"]
            self.assertEqual(sum(of_parts["elements"]), round(held))
            self.assertEqual(max(of_parts["rows"]), line["contact_rows_per_part"])
            self.assertEqual(sum(of_parts["messages_away"]) > 0, parts > 4)


class Parts(unittest.TestCase):
    def test_quiet_rounds_count_if_there_are_any(self):
        series = Series([5.0, 1.0, 2.0, 9.0], [False, True, True, False])
        self.assertEqual((series.median, series.lowest, series.highest), (1.5, 1, 2))
        self.assertFalse(series.disturbed)
        series.quiet = [False] * 4
        self.assertEqual((series.median, series.highest, series.disturbed), (3.5, 9, True))

    def test_ways_that_do_not_agree_are_refused(self):
        check_agreement({("element", 1): 2.0, ("aij", 2): 2.0 + 1e-12})
        for wrong in (2.0 + 1e-6, math.nan):
            with self.assertRaisesRegex(MeasuringError, "aij on 2 ranks"):
                check_agreement({("element", 1): 2.0, ("aij", 2): wrong})

    def test_sizes(self):
        self.assertEqual(slab_cells(36_036), (77, 77, 1))
        self.assertEqual(block_cells(104_544), (32, 32, 32))

    def test_the_model_by_hand(self):
        messages = Messages([{"bytes": [8, 1000, 2000], "seconds": [1e-6, 2e-6, 4e-6]},
                             {"bytes": [8, 1000, 2000], "seconds": [3e-6, 2e-6, 4e-6]}])
        self.assertAlmostEqual(float(messages.time(1500)), 3e-6)
        self.assertAlmostEqual(float(messages.time(20000)), 4e-6 + 18000 / 5e8)
        curve = CostCurve([100, 10000], [1e-9, 3e-9])
        self.assertAlmostEqual(float(curve.step(1000)), 2e-6)
        self.assertAlmostEqual(float(curve.step(10)), 1e-8)
        model = Model(curve, curve, messages, factor=2, row_seconds=1e-8)
        part = {"parts": 4, "dofs": 3000, "elements": 900, "contact_rows": 50, "contact_members": 3, "of_parts": {
            "elements": [300, 240, 240, 240], "inner": [200, 200, 200, 200], "sent": [200, 90, 90, 90],
            "received": [250, 80, 80, 80], "messages": [2, 1, 1, 1], "sent_away": [125, 0, 0, 20],
            "messages_away": [1, 0, 0, 1], "rows": [20, 20, 20, 0], "contact_sent": [12, 0, 0, 0],
            "partners": [3, 0, 0, 0]}}
        on_one_node = {**part, "of_parts": {**part["of_parts"], "sent_away": [0] * 4, "messages_away": [0] * 4}}
        times = model.predict(on_one_node)
        self.assertAlmostEqual(times["compute"], 2 * 2e-6)
        self.assertAlmostEqual(times["within"], 2 * 2e-6)
        self.assertEqual(times["between"], 0)
        self.assertAlmostEqual(times["exchange"], 2 * 3 * 1e-6 + 12 * 24 / 5e8)
        self.assertAlmostEqual(times["rows"], 20 * 1e-8)
        self.assertAlmostEqual(times["agreement"], 2 * 1e-6 + 0.02 * 2 * 1e-6)
        self.assertEqual(times["step"], times["overlapped"])
        model.network = Network(1e-5, 1e9, 2)
        times = model.predict(part)
        self.assertAlmostEqual(times["within"], 2e-6)  # 1000 bytes
        self.assertAlmostEqual(times["between"], 1e-5 + 8 * 125 / 1e9)
        self.assertAlmostEqual(times["exchange"], 2 * 3 * 1e-5 + 12 * 24 / 1e9)
        self.assertAlmostEqual(times["step"] - times["overlapped"], 2 * 2e-6 * 200 / 300)
        self.assertEqual(undivided(part)["of_parts"]["inner"], [900])
        alone = model.predict(undivided(part))
        self.assertAlmostEqual(alone["step"], 2 * float(curve.step(3000)) + 50 * 1e-8)
        self.assertAlmostEqual(alone["overlapped"], alone["step"])


if __name__ == "__main__":
    unittest.main()
