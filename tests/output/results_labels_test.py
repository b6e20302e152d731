"""What the results say of themselves is true of them: times, units, columns, totals.

Two oscillators (one hexahedron each, clamped at its far face) under 0.3 g sin(2 pi 2.6 t), 20 mm apart,
recorded at every step and at every second one. Every label is compared with the motion itself:
derivatives of what is recorded, the ground's own formula, forces step by step.
"""
import math
import os
import csv
import re
import shutil
import tempfile
import unittest

import h5py
import numpy
from scipy.interpolate import CubicSpline

import program
from decks import oscillators
from recorded import write_sine

MASS = (9200.0, 7000.0)
STIFFNESS = (1601718.3590439898, 3783216.759025573)
ALPHA = (0.3958406743523139, 0.697433569096934)
ACCELERATION, FREQUENCY = 0.30 * 9.81, 2.6
TIME_STEP, END = 5e-4, 1.5
FREE_FLIGHT = 0.3  # s: nothing touches before
FILES = {"history.h5", "spectra.csv", "impacts.csv", "contact_points.csv", "joint_pairs.csv", "energy.csv", "summary.json", "resolved.yaml"}


def scene(record, interval, merge_time=1e-3):
    return [*oscillators(MASS, STIFFNESS, ALPHA), "-end_time", END, "-time_step", TIME_STEP, "-modes", 0,
            "-output_interval", interval, "-impact_merge_time", merge_time, "-energy_interval", 7, "-gap_gap", 0.02,
            "-motion_x_record", record, "-motion_x_unit", "m/s2", "-title", "two oscillators",
            "-spectra_frequencies", "1,5,20", "-spectra_damping", "0.02,0.05"]


class Results:
    """What one run left, with the attributes of its history."""

    def __init__(self, test, arguments, ranks):
        folder, self.summary = program.must_run(test, arguments, ranks)
        self.files = set(os.listdir(folder))
        self.csv = {name: program.read_csv(os.path.join(folder, name)) for name in self.files
                    if name.endswith(".csv")}
        self.text = {}
        for name in self.csv:
            with open(os.path.join(folder, name)) as file:
                self.text[name] = file.read()
        with h5py.File(os.path.join(folder, "history.h5"), "r") as file:
            self.data = {name: file[name][()] for name in file}
            self.labels = {name: {key: value.decode() if isinstance(value, bytes) else value
                                  for key, value in file[name].attrs.items()} for name in file}
            self.title = file.attrs["title"]
            self.schema = float(file.attrs["schema"]), self.summary["schema"]
        shutil.rmtree(folder)
        self.time = self.data["time"]

    def column(self, file, name):
        return numpy.array([float(value) for value in self.csv[file][name]])

    def offset(self, name):
        """Time of a sample after that of its row [s]."""
        return float(self.labels[name].get("time_offset", 0.0))


class Labels(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.record = write_sine(ACCELERATION, FREQUENCY, END)
        test = unittest.TestCase()
        cls.fine = Results(test, scene(cls.record, TIME_STEP / 2), 2)
        cls.coarse = Results(test, scene(cls.record, 2 * TIME_STEP), 1)

    @classmethod
    def tearDownClass(cls):
        os.remove(cls.record)

    def agree(self, found, reference, shift, rate, label):
        """Two histories agree far better than they would if one were labelled `shift` seconds off."""
        difference = abs(found - reference).max()
        self.assertLess(difference, 0.1 * abs(rate).max() * shift, label)

    def test_rows_come_at_the_output_interval(self):
        for results, interval in ((self.fine, TIME_STEP), (self.coarse, 2 * TIME_STEP)):
            self.assertAlmostEqual(results.summary["output_interval"], interval, delta=1e-15)
            numpy.testing.assert_allclose(results.time, interval * numpy.arange(len(results.time)), atol=1e-12)
            self.assertGreaterEqual(results.time[-1], END - interval)

    def test_times_of_velocities_are_those_of_the_displacements_slope(self):
        for results in (self.fine, self.coarse):
            self.assertEqual(results.offset("displacement"), 0)
            free = results.time < FREE_FLIGHT
            time = results.time[free]
            for channel in (0, 3):
                motion = CubicSpline(time, results.data["displacement"][free, channel])
                inside = slice(2, -2)
                at = time[inside] + results.offset("velocity")
                self.agree(results.data["velocity"][free, channel][inside], motion(at, 1), TIME_STEP / 2,
                           motion(at, 2), channel)

    def test_times_of_accelerations_are_those_of_the_velocities_slope(self):
        omega = 2 * math.pi * FREQUENCY
        for results in (self.fine, self.coarse):
            free = results.time < FREE_FLIGHT
            time = results.time[free]
            for channel in (0, 3):
                velocity = CubicSpline(time + results.offset("velocity"), results.data["velocity"][free, channel])
                inside = slice(2, -2)
                at = time[inside] + results.offset("acceleration")
                absolute = velocity(at, 1) + ACCELERATION * numpy.sin(omega * at)
                self.agree(results.data["acceleration"][free, channel][inside], absolute, TIME_STEP / 2,
                           velocity(at, 2), channel)

    def test_times_of_the_ground_are_those_of_its_formula(self):
        omega = 2 * math.pi * FREQUENCY
        for results in (self.fine, self.coarse):
            at = results.time[1:-1] + results.offset("ground_acceleration")
            self.agree(results.data["ground_acceleration"][1:-1, 0], ACCELERATION * numpy.sin(omega * at),
                       TIME_STEP / 2, numpy.array([ACCELERATION * omega]), "ground")
            self.assertEqual(abs(results.data["ground_acceleration"][:, 1:]).max(), 0)

    def test_units_and_names_in_the_history(self):
        units = {"time": "s", "ground_acceleration": "m/s2", "displacement": "m", "velocity": "m/s",
                 "acceleration": "m/s2", "gap": "m", "contact_force": "N"}
        found = {name: labels.get("unit") for name, labels in self.fine.labels.items() if "unit" in labels}
        self.assertEqual(found, units)
        self.assertEqual(self.fine.labels["displacement"]["frame"], "relative to the ground")
        self.assertEqual(self.fine.labels["velocity"]["frame"], "relative to the ground")
        self.assertEqual(self.fine.labels["acceleration"]["frame"], "absolute, mean over the output interval")
        self.assertEqual([name.decode() for name in self.fine.data["channels"]],
                         ["face1.x", "face1.y", "face1.z", "face2.x", "face2.y", "face2.z"])
        self.assertEqual([name.decode() for name in self.fine.data["contacts"]], ["gap"])
        self.assertEqual(self.fine.schema, (1, 1))
        self.assertIn("two oscillators", (self.fine.title.decode() if isinstance(self.fine.title, bytes)
                                          else self.fine.title))

    def test_gap_is_that_of_the_faces(self):
        u = self.fine.data["displacement"]
        numpy.testing.assert_allclose(self.fine.data["gap"][:, 0], 0.02 + u[:, 3] - u[:, 0], atol=1e-12)

    def test_help_about_a_word(self):
        told = program.run(["-help", "passes"], 1)
        rows = [line for line in told.stdout.splitlines() if line.startswith("  -")]
        self.assertEqual((told.returncode, rows[0].split()[0]), (0, "-<contact>_passes"))
        self.assertTrue(all("passes" in line for line in rows), rows)
        whole = program.run(["-help"], 1).stdout
        self.assertTrue(set(rows) < set(whole.splitlines()))
        self.assertEqual(program.run(["-help", "qqq"], 1).stdout, "no option has 'qqq' in its line\n")

    def test_files_and_columns(self):
        self.assertEqual(self.fine.files, FILES)
        self.assertEqual(list(self.fine.csv["impacts.csv"]),
                         ["contact", "start", "end", "duration", "impulse", "peak_force", "points", "energy_lost",
                          "max_penetration", "lateral", "vertical", "contact_time", "left", "bottom",
                          "tangential_impulse", "slip", "friction_loss", "window_force"])
        self.assertEqual(list(self.fine.csv["energy.csv"]),
                         ["time", "kinetic", "strain", "damping_loss", "contact_work", "friction_loss", "input_work",
                          "gravity_work", "load_work", "device_work", "plastic_loss", "switch_loss", "residual"])
        self.assertEqual(list(self.fine.csv["spectra.csv"]),
                         ["probe", "direction", "treatment", "damping", "frequency", "period", "displacement",
                          "pseudo_velocity", "pseudo_acceleration", "interval", "valid_up_to", "start", "broadening"])
        for name, text in self.fine.text.items():  # a spreadsheet takes the first line for the names
            self.assertNotIn("#", text, name)
            self.assertEqual(text.splitlines()[0], ",".join(self.fine.csv[name]))

    def episodes(self, merge_time):
        """Impacts from the force of every step: first and last step of each."""
        steps = numpy.nonzero(self.fine.data["contact_force"][:, 0] > 0)[0]
        silence = (numpy.diff(steps) - 1) * TIME_STEP  # from the end of one step to the next force
        cuts = numpy.nonzero(silence > merge_time)[0] + 1
        return [(group[0], group[-1]) for group in numpy.split(steps, cuts)]

    def test_impacts_are_merged_within_the_merge_time_and_no_more(self):
        steps = numpy.nonzero(self.fine.data["contact_force"][:, 0] > 0)[0]
        silence = numpy.unique((numpy.diff(steps) - 1) * TIME_STEP)
        silence = silence[silence > TIME_STEP / 2]
        self.assertGreaterEqual(len(silence), 2)
        for merge_time in (0.75 * silence[0], 0.75 * silence[-1], 1.25 * silence[-1]):
            results = Results(self, scene(self.record, TIME_STEP / 2, merge_time), 1)
            expected = self.episodes(merge_time)
            numpy.testing.assert_allclose(results.column("impacts.csv", "start"),
                                          [TIME_STEP * first for first, _ in expected], atol=1e-9)
            self.assertEqual(results.summary["impacts"]["episodes"], len(expected))

    def test_impacts_are_those_of_the_forces(self):
        force = self.fine.data["contact_force"][:, 0]
        expected = self.episodes(1e-3)
        column = {name: self.fine.column("impacts.csv", name) for name in self.fine.csv["impacts.csv"]
                  if name != "contact"}
        self.assertGreater(len(expected), 1)
        numpy.testing.assert_allclose(column["start"], [TIME_STEP * a for a, _ in expected], atol=1e-9)
        numpy.testing.assert_allclose(column["end"], [TIME_STEP * (b + 1) for _, b in expected], atol=1e-9)
        numpy.testing.assert_allclose(column["duration"], column["end"] - column["start"], atol=1e-9)
        numpy.testing.assert_allclose(column["impulse"], [force[a:b + 1].sum() * TIME_STEP for a, b in expected],
                                      rtol=1e-9)
        numpy.testing.assert_allclose(column["peak_force"], [force[a:b + 1].max() for a, b in expected], rtol=1e-9)
        numpy.testing.assert_allclose(column["contact_time"],
                                      [(force[a:b + 1] > 0).sum() * TIME_STEP for a, b in expected], atol=1e-9)
        self.assertEqual(set(column["points"]), {4})
        self.assertEqual(set(self.fine.csv["impacts.csv"]["contact"]), {"gap"})
        numpy.testing.assert_allclose(column["left"], 0.5, atol=1e-6)
        numpy.testing.assert_allclose(column["bottom"], 0.5, atol=1e-6)
        points = {name: self.fine.column("contact_points.csv", name) for name in ("x", "y", "z", "impulse")}
        self.assertEqual(len(points["x"]), 4)  # the pairs of the faces, each with a quarter
        numpy.testing.assert_allclose(points["impulse"], column["impulse"].sum() / 4, rtol=1e-6)
        places = numpy.stack([points[axis] for axis in "xyz"], 1)
        self.assertEqual(sorted(map(tuple, places)), [(0, y, z) for y in (0, 1) for z in (0, 1)])
        boxes = {name: one["extent"] for name, one in self.fine.summary["structures"].items()}
        self.assertEqual(boxes, {"left": [[-1, 0, 0], [0, 1, 1]], "right": [[0, 0, 0], [1, 1, 1]]})

    def test_contact_whose_pairs_are_not_all_alike(self):
        """A face of 3 x 3 nodes that reaches past one of 2 x 2, gaps that differ, a slide: summary, report, history.
        Of six pairs two are node to node, three nodes face nothing."""
        folder = tempfile.mkdtemp(prefix="pounding-")
        self.addCleanup(shutil.rmtree, folder)
        words = scene(self.record, TIME_STEP) + [
            "-gap_gap", "0.02,0.05", "-left_mesh_set", "x0=-1,ly=1.5,ny=2,nz=2", "-right_mesh_set", "x0=0.005",
            "-left_initial_velocity", "0,0.5,0", "-end_time", 0.01, "-output", folder]
        result = program.run(words, 1)
        self.assertEqual(result.returncode, 0, result.stderr)
        contact = program.summary(folder)["contacts"]["gap"]
        numpy.testing.assert_allclose(contact["initial_gap"], [0.02, 0.035], atol=1e-12)
        numpy.testing.assert_allclose(contact["geometric_gap"], [0.005, 0.005], atol=1e-12)
        numpy.testing.assert_allclose(contact["normal"], [1, 0, 0], atol=1e-12)
        self.assertEqual((contact["pairs"], contact["matched"], contact["unmatched_nodes"]), (6, 2, 3))
        self.assertIn("contact gap: 6 pairs (2 node to node), 3 secondary nodes face nothing, initial gap 20 to 35 mm, "
                      "normal (1, ", result.stdout)
        with h5py.File(os.path.join(folder, "history.h5")) as file:
            self.assertAlmostEqual(file["gap"][0, 0], 0.02, delta=1e-12)
        said = re.search(r"gap +slid along itself by at most ([0-9.]+) mm, on a facet of ([0-9.]+) mm", result.stdout)
        self.assertGreater(contact["largest_slide"], 1e-3)
        self.assertAlmostEqual(float(said.group(1)), 1e3 * contact["largest_slide"], delta=6e-3)
        self.assertAlmostEqual(float(said.group(2)), 1e3 * contact["slide_facet_size"], delta=1)

    def test_force_of_a_record_is_the_mean_over_its_interval(self):
        """Whatever the interval, its sum is the impulse of the run."""
        for results in (self.fine, self.coarse):
            impulse = results.data["contact_force"][:, 0].sum() * results.summary["output_interval"]
            self.assertAlmostEqual(impulse / results.summary["impacts"]["total_impulse"], 1, delta=1e-9)

    def test_ledger_is_that_of_the_oscillators(self):
        """At the step of each line: v_{n+1/2}, and u_n, u_{n+1}, of the two faces."""
        step = numpy.rint(self.fine.column("energy.csv", "time") / TIME_STEP).astype(int)
        self.assertEqual(list(step[:3]), [6, 13, 20])  # after 7, 14, 21 steps
        step = step[step + 1 < len(self.fine.time)]
        kinetic, strain = numpy.zeros(len(step)), numpy.zeros(len(step))
        for body, channel in ((0, 0), (1, 3)):
            v = self.fine.data["velocity"][step, channel]
            u, after = (self.fine.data["displacement"][step + k, channel] for k in (0, 1))
            kinetic += MASS[body] * (1 - TIME_STEP / 2 * ALPHA[body]) * v * v / 2
            strain += STIFFNESS[body] * after * u / 2
        count = len(step)
        for name, expected in (("kinetic", kinetic), ("strain", strain)):
            found = self.fine.column("energy.csv", name)[:count]
            self.assertLess(abs(found - expected).max(), 1e-9 * abs(expected).max(), name)

    def test_residual_closes_the_columns_beside_it(self):
        """Up to the energy at the start the residual is what the other columns leave; the summary has its largest."""
        column = {name: self.fine.column("energy.csv", name) for name in self.fine.csv["energy.csv"]}
        residual = column["residual"]
        terms = [column[name] for name in ("kinetic", "strain", "damping_loss", "device_work", "plastic_loss", "friction_loss",
                                           "switch_loss", "contact_work", "input_work")]
        left = sum(terms[:7]) - terms[7] - terms[8] - residual
        largest = abs(numpy.array(terms)).max()
        self.assertLess(abs(left - left[0]).max(), 1e-12 * largest)
        self.assertLess(abs(residual).max(), 1e-10 * largest)
        self.assertAlmostEqual(self.fine.summary["energy"]["relative_residual"] * largest / abs(residual).max(), 1,
                               delta=1e-9)

    def test_summary_is_that_of_the_files(self):
        for results in (self.fine, self.coarse):
            summary = results.summary
            for key, column in (("kinetic", "kinetic"), ("strain", "strain"), ("damping", "damping_loss"),
                                ("contact", "contact_work"), ("friction", "friction_loss"), ("input", "input_work"), ("devices", "device_work"),
                                ("plastic", "plastic_loss"), ("switch", "switch_loss")):
                last = results.column("energy.csv", column)[-1]
                self.assertAlmostEqual(summary["energy"][key], last, delta=1e-9 * abs(last) + 1e-12, msg=key)
            column = {name: results.column("impacts.csv", name)
                      for name in ("impulse", "energy_lost", "max_penetration")}
            for totals in (summary["impacts"], summary["impacts"]["gap"]):
                self.assertEqual(totals["episodes"], len(column["impulse"]))
                self.assertAlmostEqual(totals["total_impulse"], column["impulse"].sum(), delta=1e-6)
                self.assertAlmostEqual(totals["largest_impulse"], column["impulse"].max(), delta=1e-6)
                self.assertAlmostEqual(totals["energy_lost"], column["energy_lost"].sum(), delta=1e-6)
                self.assertAlmostEqual(totals["max_penetration"], column["max_penetration"].max(), delta=1e-12)
            for probe, first in (("face1", 0), ("face2", 3)):
                for key, name in (("sampled_peak_acceleration", "acceleration"), ("peak_displacement", "displacement")):
                    peaks = abs(results.data[name][:, first:first + 3]).max(axis=0)
                    numpy.testing.assert_allclose(summary["probes"][probe][key], peaks, rtol=1e-12)
                self.assertEqual(summary["probes"][probe]["nodes"], 4)
            self.assertEqual(summary["probes"]["face1"]["structure"], "left")
            self.assertEqual(summary["time_step"], TIME_STEP)
            self.assertEqual(summary["steps"], round(END / TIME_STEP))
            self.assertEqual(summary["end_time"], END)
            self.assertLessEqual(sum(summary["phases"].values()), 1.05 * summary["wall_time"])
            self.assertEqual(summary["contacts"]["gap"]["initial_gap"], [0.02, 0.02])
            self.assertEqual(summary["contacts"]["gap"]["pairs"], 4)

    def check_memory(self, memory, peak, ranks):
        """Of the start-up and the steps, on all ranks and on the largest; the libraries alone take some megabytes."""
        self.assertEqual(list(memory), ["mesh", "partition", "assembly", "modes", "step", "mesher"])
        self.assertGreater(memory.pop("mesher"), 5e6)
        for name, use in memory.items():
            self.assertGreater(use["at_end"], 5e6 * ranks, name)
            self.assertGreaterEqual(use["peak"], use["at_end"], name)
            self.assertLessEqual(use["largest_rank"], use["peak"], name)
            self.assertGreaterEqual(use["largest_rank"] * ranks, use["peak"], name)
            self.assertLessEqual(use["peak"], peak, name)

    def test_summary_of_the_structures(self):
        for i, name in enumerate(("left", "right")):
            structure = self.fine.summary["structures"][name]
            self.assertEqual((structure["nodes"], structure["dofs"], structure["dofs_before_clamping"]), (8, 12, 24))
            self.assertEqual((structure["elements"], structure["groups"]), (1, {"body": 1}))
            self.assertAlmostEqual(structure["mass"], 2 * MASS[i], delta=1e-6)
            self.assertEqual(structure["damping"], {"alpha": ALPHA[i], "beta": 0})
            self.assertAlmostEqual(structure["stable_time_step_undamped"] * structure["omega_max"], 2, delta=1e-9)
        smallest = min(one["stable_time_step"] for one in self.fine.summary["structures"].values())
        self.assertEqual(self.fine.summary["stable_time_step"], smallest)
        self.assertEqual((self.fine.summary["ranks"], self.coarse.summary["ranks"]), (2, 1))
        self.assertGreater(self.fine.summary["peak_memory"], 1.5 * self.coarse.summary["peak_memory"])
        for summary in (self.fine.summary, self.coarse.summary):
            self.check_memory(summary["memory"], summary["peak_memory"], summary["ranks"])
        self.assertEqual(self.coarse.summary["partition"]["edge_cut"], 0)
        self.assertGreaterEqual(self.coarse.summary["partition"]["imbalance"], 1)

    def test_spectra_say_what_they_are(self):
        for results in (self.fine, self.coarse):
            interval = results.summary["output_interval"]
            floors = results.column("spectra.csv", "valid_up_to")[:2 * 3 * 2 * 3]
            numpy.testing.assert_allclose(results.column("spectra.csv", "interval")[:len(floors)], interval, rtol=1e-12)
            highest, = set(floors)
            mean = math.sin(math.pi * highest * interval) / (math.pi * highest * interval)
            self.assertLess(1 - mean, 0.01)   # a sine at that frequency, averaged over the interval
            self.assertGreater(1 - mean, 0.002)
            column = {name: results.column("spectra.csv", name) for name in results.csv["spectra.csv"]
                      if name not in ("probe", "direction", "treatment")}
            omega = 2 * math.pi * column["frequency"]
            numpy.testing.assert_allclose(column["period"], 1 / column["frequency"], rtol=1e-9)
            numpy.testing.assert_allclose(column["pseudo_velocity"], omega * column["displacement"], rtol=1e-9)
            numpy.testing.assert_allclose(column["pseudo_acceleration"], omega ** 2 * column["displacement"],
                                          rtol=1e-9)
            rows = list(zip(results.csv["spectra.csv"]["probe"], results.csv["spectra.csv"]["direction"],
                            column["damping"], column["frequency"]))
            self.assertEqual(rows, [(probe, direction, damping, frequency) for probe in ("face1", "face2")
                                    for direction in "xyz" for damping in (0.02, 0.05)
                                    for frequency in (1, 5, 20)]
                             + [("ground", "x", damping, frequency) for damping in (0.02, 0.05)
                                for frequency in (1, 5, 20)])

    def test_what_is_printed_is_what_is_written(self):
        """Units of the report: ms, kN, mm, per cent."""
        folder = tempfile.mkdtemp(prefix="pounding-")
        self.addCleanup(shutil.rmtree, folder)
        result = program.run(scene(self.record, 2 * TIME_STEP) + ["-output", folder], 1)
        self.assertEqual(result.returncode, 0, result.stderr)
        printed, written = result.stdout, self.coarse
        for name, table in written.csv.items():  # the same numbers, to nine digits
            with open(os.path.join(folder, name)) as file:
                header, *lines = csv.reader(file)
            self.assertEqual((header, len(lines)), (list(table), len(table[header[0]])))
            for line, exact in zip(lines, zip(*table.values())):
                self.assertEqual(line, [text if re.search("[a-df-z]", text) else f"{float(text):.9g}" for text in exact])

        said = re.search(r"initial gap ([0-9.]+) to ([0-9.]+) mm", printed)
        self.assertEqual([float(word) for word in said.groups()], [20, 20])
        rows = re.findall(r"^  gap +([0-9.]+) +([0-9.]+) +([0-9.]+) +([0-9.]+) +([0-9.]+) +(\d+) +([0-9.-]+)$", printed,
                          re.MULTILINE)
        columns = [written.column("impacts.csv", name) * factor for name, factor in
                   (("start", 1), ("duration", 1e3), ("impulse", 1), ("window_force", 1e-3),
                    ("peak_force", 1e-3), ("points", 1), ("energy_lost", 1))]
        numpy.testing.assert_allclose(numpy.array(rows, dtype=float), numpy.array(columns).T[:20], atol=0.051)
        totals = re.search(r"impacts: (\d+) episodes, total impulse ([0-9.]+) N s, largest ([0-9.]+) N s", printed)
        self.assertEqual(int(totals.group(1)), written.summary["impacts"]["episodes"])
        self.assertAlmostEqual(float(totals.group(2)), written.summary["impacts"]["total_impulse"], delta=0.051)
        self.assertAlmostEqual(float(totals.group(3)), written.summary["impacts"]["largest_impulse"], delta=0.051)
        for probe in ("face1", "face2"):
            said = re.search(rf"^  {probe}\.x +([0-9.]+) +([0-9.]+) +([0-9.]+) .*?at ([0-9.]+) \(2 %\).*\(5 %\)$", printed,
                             re.MULTILINE)
            peaks = written.summary["probes"][probe]
            self.assertAlmostEqual(float(said.group(1)), peaks["peak_acceleration"][0], delta=6e-4)
            self.assertAlmostEqual(float(said.group(2)), peaks["sampled_peak_acceleration"][0], delta=6e-4)
            self.assertAlmostEqual(float(said.group(3)), 1e3 * peaks["peak_displacement"][0], delta=6e-4)
        said = re.search(r"kinetic ([^,]+), strain ([^,]+), damping loss ([^,]+), contact work ([^,]+), "
                         r"input work (\S+)", printed)
        for word, name in zip(said.groups(), ("kinetic", "strain", "damping", "contact", "input")):
            value = written.summary["energy"][name]
            self.assertAlmostEqual(float(word), value, delta=1e-3 * abs(value), msg=name)
        said = re.search(r"time step (\S+) s \(([0-9.]+) of the stable one\), (\d+) steps to (\S+) s", printed)
        self.assertEqual([float(word) for word in said.groups()[::2]], [TIME_STEP, written.summary["steps"]])
        self.assertAlmostEqual(float(said.group(2)), TIME_STEP / written.summary["stable_time_step"], delta=6e-4)

    def test_continued_run_says_where_it_goes_on_and_what_its_own_steps_cost(self):
        folder = tempfile.mkdtemp(prefix="pounding-")
        self.addCleanup(shutil.rmtree, folder)
        words = scene(self.record, 2 * TIME_STEP) + ["-output", folder]
        checkpoint = os.path.join(folder, "checkpoint.h5")
        self.assertEqual(program.run(words + ["-checkpoint_steps", 2900], 1).returncode, 0)
        result = program.run(words + ["-restart", checkpoint], 1)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"continuing {checkpoint} after step 2900, t = {2900 * TIME_STEP:g} s\n", result.stdout)
        summary = program.summary(folder)
        self.assertEqual(summary["steps"], 3000)
        # A hundred steps were made, not three thousand: together they take what their phases take.
        phases = sum(summary["phases"][name] for name in ("step", "contact", "energy", "output"))
        self.assertGreater(100e-6 * summary["microseconds_per_step"], 0.5 * phases)

    def test_modes_that_turn_have_moments_of_inertia(self):
        """A tower of 1 x 1 x 4 m clamped at its foot: in torsion 8 / pi^2 of the polar inertia of its lumped masses."""
        words = ["-structures", "it", "-it_mesh", "tests/meshes/box.geo", "-it_mesh_set", "lz=4,nx=2,ny=2,nz=8",
                 "-it_body_element", "hex8", "-it_body_material", "concrete", "-material_concrete_young", 3e9,
                 "-material_concrete_poisson", 0.2, "-material_concrete_density", 2400, "-it_clamp", "z_min", "-end_time",
                 1e-4, "-modes", 3, "-dry_run"]
        result = program.run(words)
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = re.findall(r"\n +(\d) +[0-9.]+ +(\w+) +(\d+) (kg\w* .*), +[0-9.]+ % about/along", result.stdout)
        self.assertEqual(sorted((way, unit) for _, way, _, unit in rows),
                         [("rz", "kg m2 about z"), ("x", "kg along x"), ("y", "kg along y")])
        inertia, = (float(value) for _, way, value, _ in rows if way == "rz")
        polar = 2400 * 4 * (1 + 2 / 2**2) / 6
        self.assertAlmostEqual(inertia / (8 / math.pi**2 * polar), 1, delta=0.01)

    def test_what_is_printed_of_the_model_is_what_the_summary_says(self):
        """Structures, modes, limits of the step, places of the probes, and the spectra of the end."""
        folder = tempfile.mkdtemp(prefix="pounding-")
        self.addCleanup(shutil.rmtree, folder)
        words = scene(self.record, TIME_STEP) + ["-modes", 3, "-left_damping_beta", 1e-4, "-end_time", 0.3,
                                                 "-probes", "near,right_face", "-near_structure", "left",
                                                 "-near_at", "0.01,0,1.02", "-right_face_structure", "right",
                                                 "-right_face_group", "x_min", "-output", folder]
        words[words.index("-face1_structure"):words.index("-face2_group") + 2] = []
        result = program.run(words, 1)
        self.assertEqual(result.returncode, 0, result.stderr)
        printed, summary = result.stdout, program.summary(folder)

        def numbers(pattern, text):
            found = re.search(pattern.replace("#", r"([-+0-9.e]+)"), text)
            self.assertIsNotNone(found, pattern)
            return [float(word) for word in found.groups()]

        for name in ("left", "right"):
            of = summary["structures"][name]
            text = printed[printed.index(f"\nstructure {name}: "):]
            self.assertEqual(numbers(r": # nodes, # dofs \(# before clamping\), mass # kg", text),
                             [of["nodes"], of["dofs"], of["dofs_before_clamping"], round(of["mass"])])
            numpy.testing.assert_allclose(
                numbers(r"damping ratio at 1, 10, 100, 400 Hz: # % # % # % # %", text),
                [100 * (of["damping"]["alpha"] / (4 * math.pi * f) + of["damping"]["beta"] * math.pi * f)
                 for f in (1, 10, 100, 400)], atol=6e-4)
            numpy.testing.assert_allclose(numbers(r"omega_max # rad/s \(bound from single elements #\)", text),
                                          [of["omega_max"], of["element_frequency_bound"]], rtol=1e-4)
            numpy.testing.assert_allclose(
                numbers(r"stable time step # s \(bound from single elements #\), without damping # s", text),
                [of["stable_time_step"], of["element_time_step_bound"], of["stable_time_step_undamped"]], rtol=1e-4)
            self.assertLess(of["omega_max"], of["element_frequency_bound"] * 0.999)
            self.assertGreater(of["stable_time_step"], of["element_time_step_bound"] * 1.001)
            self.assertEqual(len(of["frequencies"]), 3)
            for number, mode in enumerate(of["frequencies"], 1):
                way = mode["direction"]
                kind = f"kg m2 about {way[1]}" if way[0] == "r" else f"kg along {way}"
                row = numbers(rf"\n +{number} +# +{way} +# {kind}, +# % about/along {way}, body has # % of the motion\n", text)
                mass = mode["effective_modal_mass"][("x", "y", "z", "rx", "ry", "rz").index(way)]
                self.assertEqual((mode["group"], round(mode["group_share"], 9)), ("body", 1))  # the only one
                numpy.testing.assert_allclose(row, [mode["frequency"], mass, 100 * mode["fraction"], 100], atol=0.51, rtol=1e-3)
                self.assertEqual(mode["effective_mass"], max(mode["effective_modal_mass"][:3]))
        places = {"near": ([0, 0, 1], math.hypot(0.01, 0.02)), "right_face": ([0, 0.5, 0.5], 0)}
        for name, (place, distance) in places.items():
            self.assertEqual(summary["probes"][name]["position"], place)
            *at, off = numbers(rf"probe {name}: \d+ nodes? of \w+ at \(#, #, #\), at most # mm", printed)
            numpy.testing.assert_allclose(at, place, atol=1e-6)
            self.assertAlmostEqual(off, 1e3 * distance, delta=0.06)
            table = program.read_csv(os.path.join(folder, "spectra.csv"))
            row = numbers(rf"\n  {name}.x +# +# +# +# at # \(2 %\) +# at # \(5 %\)\n", printed)[3:]
            for ratio, peak, frequency in ((0.02, *row[:2]), (0.05, *row[2:])):
                spectrum = {float(a): float(f) for a, f, probe, direction, damping in
                            zip(table["pseudo_acceleration"], table["frequency"], table["probe"], table["direction"],
                                table["damping"])
                            if probe == name and direction == "x" and float(damping) == ratio}
                self.assertAlmostEqual(peak, max(spectrum), delta=6e-3)
                self.assertEqual(frequency, spectrum[max(spectrum)])
        self.assertEqual(numbers(r"partition: imbalance #, cut edges #\n", printed),
                         [summary["partition"]["imbalance"], summary["partition"]["edge_cut"]])
        long = program.run(scene(self.record, TIME_STEP) + ["-end_time", 1000, "-dry_run"], 1).stdout  # 2e6 steps
        seconds, each = numbers(r"expected wall time of the steps: # s \(# microseconds per step", long)
        self.assertAlmostEqual(seconds, 2 * each, delta=0.16)  # both are rounded to a tenth
        first = long[:long.index("in detail:")]  # the answer comes before the details
        self.assertLess(first.count("\n"), 20)
        whole, *parts = numbers(r"expected time of the whole run: # s: # until its first step, # of steps, # of spectra", first)
        self.assertAlmostEqual(whole / sum(parts), 1, delta=0.1)  # of two digits each
        self.assertAlmostEqual(parts[1] / seconds, 1, delta=0.1)
        self.assertIn("would step 2 structures with 4 pairs of contacts to 1000 s, in 2000000 steps", first)
        self.assertLess(long.index("\ndoubts, " if "\ndoubts, " in long else "\nno doubts"), long.index("\nstructure left"))
        said = numbers(r"wall time # s, # microseconds per step", printed)
        self.assertAlmostEqual(said[0], summary["wall_time"], delta=6e-3)
        self.assertAlmostEqual(said[1], summary["microseconds_per_step"], delta=6e-4)
        steps = 1e-6 * summary["microseconds_per_step"] * summary["steps"]  # a part of the whole, not a thousandth
        self.assertLess(steps, summary["wall_time"])
        self.assertGreater(steps, 0.5 * summary["phases"]["step"])


if __name__ == "__main__":
    unittest.main()
