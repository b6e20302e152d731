"""The report that is filed: the answer in its first lines, the run without pounding beside it, tables that say what the
console and the files say, and paper.

Two small buildings for 1.2 s: at a gap of 10 mm they hit, at 60 mm they do not, and without contacts they are alone."""
import csv
import html
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy

import browser
import program
import two_buildings
from two_buildings import pounding

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
from pounding.plot import answer, design_spectra, force_figures, markup, model_tables, twin  # noqa: E402

MORE = {"modes": 4, "spectra_damping": "0.02,0.05", "forces": "base,corner", "base_structure": "left",
        "base_kind": "reactions", "corner_structure": "left", "corner_kind": "members", "corner_group": "columns",
        "corner_at": "0,0,1"}


def page(folder):
    return (Path(folder) / "report.html").read_text(encoding="utf-8")


def text_of(markup):
    return html.unescape(re.sub(r"<[^>]*>", " ", markup))


def table(markup, caption):
    """Cells of the first table whose caption begins like that, row by row, the header first."""
    found = next(one for one in re.findall(r"<table.*?</table>", markup, re.DOTALL)
                 if html.unescape(re.search("<caption>(.*?)</caption>", one)[1]).startswith(caption))
    rows = re.findall("<tr>(.*?)</tr>", found, re.DOTALL)
    return [[html.unescape(cell) for cell in re.findall("<t[hd][^>]*>(.*?)</t[hd]>", row)] for row in rows]


def answer_of(folder):
    return text_of(re.search(r'<div class="answer.*?</div>', page(folder), re.DOTALL)[0])


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = Path(tempfile.mkdtemp(prefix="pounding-report-"))
        cls.hit = two_buildings.run(cls.place / "hit", gap=0.01, **MORE)
        cls.alone = two_buildings.run(cls.place / "alone", contacts="none", **MORE)
        cls.wide = two_buildings.run(cls.place / "wide", 1, gap=0.06, **MORE)
        drawn = program.command("plot", cls.place / "hit", "--without", cls.place / "alone", *(["--pdf"] if browser.found()[0] else []))
        assert drawn.returncode == 0, drawn.stderr
        cls.said = drawn.stdout

    def plot(self, *words):
        done = program.must_do(self, "plot", *words)
        return done.stdout

    @staticmethod
    def console(ranks, *more):
        """Lines of a dry run of the same model."""
        given = [word for name, value in two_buildings.SHORT.items() for word in (f"-{name}", value)]
        return program.run(["-options_file", two_buildings.SCENE, "-dry_run", *given, *more], ranks,
                           folder=two_buildings.FOLDER).stdout

    def refused(self, *words):
        done = program.command("plot", *words)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), done.stderr)
        self.assertTrue(done.stderr.startswith("run/plot: "), done.stderr)
        return done.stderr

    def test_the_answer_has_the_numbers_of_the_files(self):
        said = answer_of(self.place / "hit")
        impacts = self.hit.impacts
        strongest = impacts["impulse"].argmax()
        self.assertGreater(len(impacts["impulse"]), 0)
        asked = 1e3 * self.hit.summary["separations"]["floor2"]["srss"]
        self.assertGreater(asked, 10)
        self.assertTrue(said.split(">")[-1].strip().startswith(
            f"The joint floor2 of 10 mm closes, with {len(impacts['impulse'])} impacts in all, where response spectra ask for "
            f"{asked:.3g} mm (SRSS); one motion in one joint gives no confidence."), said[:200])
        self.assertIn(f"The buildings touched: {len(impacts['impulse'])} impact", said)
        self.assertIn(f"The hardest came at {impacts['start'][strongest]:.4g} s at {impacts['contact'][strongest]}: "
                      f"{markup.readable(impacts['impulse'][strongest])} N s", said)
        self.assertIn(f"was {markup.readable(1e-3 * impacts['window_force'].max())} kN", said)
        # the largest ratio, looked for anew
        best = (0,)
        own, other = (run.spectra["pseudo_acceleration"] for run in (self.hit, self.alone))
        floors = self.hit.spectra["probe"] != "ground"
        lines = floors & (self.hit.spectra["damping"] == 0.02)
        for i in numpy.flatnonzero(lines):
            if own[i] >= 0.05 * own[lines].max() and other[i] >= 0.01 * other[lines].max():
                best = max(best, (own[i] / other[i], i))
        ratio, i = best
        self.assertIn(f"grow at most {ratio:.3g} times at {self.hit.spectra['frequency'][i]:.3g} Hz at "
                      f"{self.hit.spectra['probe'][i]} along {self.hit.spectra['direction'][i]}", said)
        residual = self.hit.summary["energy"]["relative_residual"]
        self.assertIn(f"closes: its largest residual is {markup.readable(residual, 2)} of", said)
        self.assertNotIn("command", said)
        # and nothing of it stands behind tables
        whole = page(self.place / "hit")
        self.assertLess(whole.index('class="answer'), whole.index("<table"))
        self.assertLess(whole.index("In one picture"), whole.index("<table"))

    def test_floor_spectra_stand_at_regulatory_frequencies(self):
        at = design_spectra.frequencies(0.1, 500)
        self.assertEqual(len(at), 28 + 4 + 7 + 12 + 14 + 3 + 2 + 4 + 1 + len(design_spectra.BEYOND))
        self.assertEqual(len(set(at)), len(at))
        for frequency in (0.2, 3.0, 3.15, 3.6, 5.0, 8.0, 14.5, 17.0, 20.0, 31.0, 34.0, 400.0):
            self.assertIn(frequency, at)
        with open(self.place / "hit" / "floor_spectra.csv", newline="") as file:
            rows = [row for row in csv.DictReader(file) if (row["probe"], row["direction"], row["damping"]) == ("left_roof", "x", "0.05")]
        f, own = self.hit.spectrum("left_roof", "x", 0.05)
        _, other = self.alone.spectrum("left_roof", "x", 0.05)
        fine = numpy.exp(numpy.linspace(numpy.log(f[0]), numpy.log(f[-1]), 20001))
        for row in rows:
            near = (fine >= float(row["frequency"]) / 1.15) & (fine <= float(row["frequency"]) / 0.85)
            for name, spectrum in (("PSA with pounding [m/s2]", own), ("PSA without [m/s2]", other)):
                largest = numpy.exp(numpy.interp(numpy.log(fine[near]), numpy.log(f), numpy.log(spectrum))).max()
                self.assertAlmostEqual(float(row[name]) / largest, 1, delta=0.03, msg=row["frequency"])  # between the spectra's own
            self.assertEqual(float(row["PSA envelope [m/s2]"]), max(float(row[name]) for name in list(row)[4:6]))
        shown = table(page(self.place / "hit"), "Envelope of the runs, widened by 15 %, 5 % damping")
        there = {row[0]: dict(zip(shown[0][1:], row[1:])) for row in shown[1:]}
        envelope = {f"{float(row['frequency']):g}": float(row["PSA envelope [m/s2]"]) for row in rows}
        for frequency, value in there["left_roof, x"].items():
            self.assertEqual(value, f"{envelope[frequency]:.3g}")

    def test_checks_that_do_not_close_are_said(self):
        summary = {**self.hit.summary, "energy": {"relative_residual": 1e-3}, "warnings": ["odd"],
                   "impacts": {**self.hit.summary["impacts"], "complementarity_residual": 0.1}}
        said = " ".join(answer.checks(pounding.results.Result(self.hit.folder, summary)))
        self.assertIn("DOES NOT CLOSE", said)
        self.assertIn("NOT solved", said)
        self.assertIn("warned 1 time;", said)

    def test_a_joint_that_stays_open_has_its_margin(self):
        self.plot(self.place / "wide")
        said = answer_of(self.place / "wide")
        gap = self.wide.history["gap"]
        row, column = numpy.unravel_index(numpy.nanargmin(gap), gap.shape)
        first = min(self.wide.closing_factors(), key=self.wide.closing_factors().get)
        self.assertIn(f"The joint {first} of 60 mm stays open with a margin of {self.wide.closing_factors()[first]:.3g} on the "
                      "motion; one motion in one joint gives no confidence.", said)
        self.assertIn("The buildings did not touch.", said)
        smallest, rest = gap[row, column], 0.06
        self.assertIn(f"The smallest gap was {1e3 * smallest:.3g} mm at {self.wide.contacts[column]} at "
                      f"{self.wide.history['time'][row]:.4g} s, of 60 mm at rest", said)
        self.assertIn(f"{100 * smallest / rest:.3g} % of it is left", said)
        self.assertIn(f"a motion {rest / (rest - smallest):.3g} times as strong", said)
        self.assertIn("No contacts: each building moves on its own", answer.sentences(self.alone, None)[0])

    def test_the_first_joint_to_close_has_the_margin(self):
        """Least gap left at `narrow`, which hardly moves; `wide` is the first that a stronger motion closes."""
        history = {"time": numpy.array([0.0, 1.0]), "contacts": ["narrow", "wide"],
                   "gap": numpy.array([[0.010, 0.045], [0.0098, 0.0121]])}
        contacts = {"narrow": {"initial_gap": [0.010, 0.010]}, "wide": {"initial_gap": [0.045, 0.045]}}
        told = {name: {**one, "largest_closing": closing, "closing_factor": one["initial_gap"][0] / closing}
                for (name, one), closing in zip(contacts.items(), (0.0002, 0.0329))}
        for found in (contacts, told):
            run = pounding.results.Result(self.wide.folder, {**self.wide.summary, "contacts": found}, history)
            said = " ".join(answer.sentences(run, None))
            self.assertIn("The smallest gap was 9.8 mm at narrow", said)
            self.assertIn("a motion 1.37 times as strong would close wide, the first of the joints", said)
        # of pairs with different gaps the history knows the smallest alone: no more than what surely stays open
        uneven = {**contacts, "wide": {"initial_gap": [0.045, 0.050]}}
        run = pounding.results.Result(self.wide.folder, {**self.wide.summary, "contacts": uneven}, history)
        self.assertAlmostEqual(run.closing_factors()["wide"], 0.050 / (0.050 - 0.0121), delta=1e-12)

    def test_a_closed_joint_that_opens_alone(self):
        history = {"time": numpy.array([0.0, 1.0]), "contacts": ["closed"], "gap": numpy.array([[0.0], [0.001]])}
        summary = {**self.wide.summary, "contacts": {"closed": {"initial_gap": [0.0, 0.0]}}}
        said = " ".join(answer.sentences(pounding.results.Result(self.wide.folder, summary, history), None))
        self.assertIn("The smallest gap was 0 mm at closed at 0 s, of 0 mm at rest: the joint closed by 0 mm.", said)

    def test_a_run_with_a_wide_joint_is_a_run_without_pounding(self):
        found, why = twin.find(self.hit, self.place / "wide")
        self.assertEqual((found.folder.name, why), ("wide", ""))
        change = answer.largest_change(self.hit, found)
        self.assertAlmostEqual(change.ratio, answer.largest_change(self.hit, self.alone).ratio, delta=1e-6 * change.ratio)

    @program.long
    def test_the_command_of_the_report_makes_the_run_that_is_then_found(self):
        place = self.place / "found"
        shutil.copytree(self.place / "hit", place / "hit")
        self.plot(place / "hit")
        self.assertIn("No run without pounding is beside this one", answer_of(place / "hit"))
        line = html.unescape(re.search("<code>(.*?)</code>", page(place / "hit"))[1])
        self.assertIn("cd ", line)
        self.assertIn(shlex.quote(program.PROGRAM), line)
        done = subprocess.run(["bash", "-c", line], cwd=tempfile.gettempdir(), env=program.ENVIRONMENT, capture_output=True, text=True, timeout=300,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stdout[-500:] + done.stderr)
        said = self.plot(place / "hit")
        self.assertNotIn("without pounding:", said)
        self.assertIn("Beside the run without pounding (hit-without)", answer_of(place / "hit"))
        made = pounding.load(place / "hit-without")
        self.assertEqual(made.summary["time_step"], self.hit.summary["time_step"])
        os.rename(place / "hit-without", place / "apart")  # where run/plant has it
        self.assertEqual(twin.find(pounding.load(place / "hit"), None)[0].folder.name, "apart")

    def test_another_model_is_refused(self):
        hit = self.place / "hit"
        two_buildings.run(self.place / "stronger", 1, **{"contacts": "none", **MORE, "modes": 0, "motion_x_pga": 3,
                                                         "end_time": 0.02})
        self.assertRegex(self.refused(hit, "--without", self.place / "stronger"), "option (motion_x_pga is 3|end_time is 0.02),")
        shutil.copytree(hit, self.place / "close")
        self.assertIn("its buildings touched", self.refused(hit, "--without", self.place / "close"))
        options = self.alone.summary["options"]
        for changed, part in (({"options": {**options, "end_time": "1.3"}}, "option end_time is 1.3"),
                              ({"options": {**options, "motion_x_pga": "3"}}, "option motion_x_pga is 3"),
                              ({"options": {**options, "material_concrete_young": "34e9"}}, "material_concrete_young is 34e9"),
                              ({"time_step": 1e-5}, "has another time step: 1e-05 s"),
                              ({"end_time": 1.3}, "has another end time: 1.3 s")):
            other = pounding.results.Result(self.alone.folder, {**self.alone.summary, **changed})
            with self.assertRaisesRegex(twin.NoTwin, part):
                twin.check(self.hit, other)
        self.assertIn("is the run itself", self.refused(hit, "--without", hit))
        self.assertIn("is not a folder", self.refused(hit, "--without", self.place / "nowhere"))

    def test_a_mesh_of_other_contents_is_another_model(self):
        other = pounding.results.Result(self.alone.folder, {**self.alone.summary, "inputs": [
            {**one, "sha256": "0" * 64} if one["option"] == "left_mesh" else one for one in self.alone.summary["inputs"]]})
        twin.check(self.hit, self.alone)
        with self.assertRaisesRegex(twin.NoTwin, "the file of left_mesh has other contents"):
            twin.check(self.hit, other)

    def test_every_file_of_an_option_counts_and_those_of_either_run(self):
        def beside(ours, theirs):
            runs = [pounding.results.Result(run.folder, {**run.summary, "inputs": [
                {"option": option, "file": "any", "sha256": value} for option, value in inputs]})
                for run, inputs in ((self.hit, ours), (self.alone, theirs))]
            twin.check(*runs)

        matrices = [("left_matrices", "rows"), ("left_matrices", "stiffness"), ("left_matrices", "mass")]
        beside(matrices, matrices)
        for ours, theirs, part in (
                (matrices, [matrices[0], ("left_matrices", "softer"), matrices[2]], "the file of left_matrices"),
                ([("motion_x_record", "a")], [("motion_x_record", "a"), ("motion_y_record", "b")], "motion_y_record"),
                ([("included", "a")], [("included", "b")], "a file that geometries include")):
            with self.assertRaisesRegex(twin.NoTwin, part):
                beside(ours, theirs)

    def test_one_that_is_found_but_unlike_is_left_out_with_a_word(self):
        place = self.place / "unlike"
        shutil.copytree(self.place / "hit", place / "hit")
        shutil.copytree(self.place / "hit", place / "hit-without")
        found, why = twin.find(pounding.load(place / "hit"), None)
        self.assertIsNone(found)
        self.assertIn("hit-without is no run without pounding: its buildings touched", why)
        self.assertIn(why, " ".join(answer.sentences(self.hit, None, why)))

    def test_modes_are_those_of_the_console(self):
        printed = self.console(1, "-modes", 4)
        for name in ("left", "right"):
            part = printed[printed.index(f"\nstructure {name}:"):]
            console = re.findall(r"^ +(\d+) +([\d.]+) +(\w+) +(\d+) (kg(?: m2)? (?:along|about) \w), +([\d.]+) % about/along (\w+), damped "
                                 r"([\d.]+) Hz", part, re.MULTILINE)[:4]
            shown = table(page(self.place / "hit"), f"Modes of {name}")[1:]
            self.assertEqual(len(console), 4)
            for line, row in zip(console, shown):
                self.assertEqual(row[:4] + [row[4].replace("²", "2"), row[5], row[2], row[6]], list(line))
            groups = re.findall(r"(\w+) has ([\d.]+) % of the motion$", part, re.MULTILINE)[:4]
            self.assertEqual([row[7] for row in shown], [f"{group}, {share} %" for group, share in groups])
            self.assertEqual(groups[0][0], "slabs")  # which carry the mass

    def test_damping_is_that_of_the_console(self):
        shown = numpy.array(model_tables.SHOWN)
        omega = 2 * numpy.pi * shown
        numpy.testing.assert_allclose(model_tables.ratio_of({"alpha": 0.3, "beta": 2e-4}, shown),
                                      0.3 / (2 * omega) + 2e-4 * omega / 2, rtol=1e-12)
        found = model_tables.ratio_of(self.hit.summary["structures"]["left"]["damping"], shown)
        printed = self.console(1)
        said = re.search(r"ratio at 1, 10, 100, 400 Hz: ([\d.]+) % ([\d.]+) % ([\d.]+) % ([\d.]+) %", printed)
        self.assertEqual([f"{100 * ratio:.3f}" for ratio in found], list(said.groups()))

    def test_tables_of_model_motion_and_origin(self):
        whole = page(self.place / "hit")
        motion = {row[0]: row[1] for row in table(whole, "Ground motion as it was understood")}
        self.assertEqual(float(motion["PGA [m/s²]"]), 4)
        self.assertAlmostEqual(float(motion["PGA [g]"]), 4 / 9.80665, delta=2e-3)
        self.assertIn("synthetic, seed 1", motion["read as"])
        materials = {row[0]: row[1:] for row in table(whole, "Materials as used")}
        self.assertEqual(materials["concrete"], ["33", "0.2", "2900"])
        self.assertEqual(materials["S355"][2], "7850")  # by name, with its numbers
        sections = {row[0]: row[1:] for row in table(whole, "Sections as used")}
        self.assertAlmostEqual(float(sections["left_column"][0]), 54.25, delta=0.01)  # HEB160 of EN 10365
        joints = {row[0]: row for row in table(whole, "Joints as they were computed")}
        faces, rest, unloaded, meshes = joints["floor2"][1], *joints["floor2"][5:8]
        self.assertEqual((faces, rest, unloaded, meshes), ("left:east_2 on right:west_2", "10", "10", "20"))
        inputs = {row[0]: row[3] for row in table(whole, "Inputs")[1:]}
        self.assertEqual(inputs, {one["file"]: one["sha256"] for one in self.hit.summary["inputs"]})
        self.assertGreaterEqual(len(inputs), 3)
        run = dict(row[:2] for row in table(whole, "Date, machine, program"))
        self.assertEqual(run["PETSc"], self.hit.summary["versions"]["PETSc"])
        self.assertEqual(run["machine"], os.uname().nodename)
        self.assertEqual(re.findall(r"""(?:src|href)\s*=\s*["'](?!data:|#)""", whole), [])

    def test_the_title_follows_the_command_line(self):
        title = html.unescape(re.search("<h1>(.*?)</h1>", page(self.place / "hit"))[1])
        self.assertTrue(title.startswith("Two frame buildings side by side, with "), title)
        self.assertIn(" more options", title)  # than a title holds
        changed = {row[0] for row in table(page(self.place / "hit"), "Options of the command line")}
        self.assertTrue({"floor1_gap", "floor2_gap", "end_time"} <= changed, changed)

    def test_forces_have_a_table_and_histories(self):
        rows = {(row[0], row[1]): row for row in table(page(self.place / "hit"), "Forces")[1:]}
        column = self.hit.history["forces"].index("base.Fx")
        force = self.hit.history["force"][:, column]
        at = abs(force).argmax()
        row = rows["base", "Fx"]
        self.assertAlmostEqual(float(row[2]) / (1e-3 * force[at]), 1, delta=1e-3)
        self.assertAlmostEqual(float(row[4]), self.hit.history["time"][at], delta=1e-3)
        self.assertEqual(row[3], "kN")
        other = self.alone.forces
        here = (other["item"] == "base") & (other["component"] == "Fx")
        self.assertAlmostEqual(float(row[6]) / (1e-3 * other["peak"][here][0]), 1, delta=1e-3)
        for item in ("base", "corner"):
            self.assertTrue((self.place / "hit" / f"forces_{item}.png").exists())
        found = force_figures.items(["base.Fx", "corner.17.My1", "corner.18.My1"])
        self.assertEqual(found, {"base": {"Fx": {"": 0}}, "corner": {"My1": {"17": 1, "18": 2}}})
        self.assertEqual([force_figures.unit_of(name) for name in ("Fx", "My1", "T", "N12", "M12", "Q1")],
                         ["kN", "kN m", "kN m", "kN/m", "kN", "kN/m"])

    def test_it_is_printed(self):
        browser.needed(self)
        self.assertIn("report.pdf", self.said)
        content = (self.place / "hit" / "report.pdf").read_bytes()
        self.assertTrue(content.startswith(b"%PDF-"))
        sizes = set(re.findall(rb"/MediaBox \[0 0 (\d+)[.\d]* (\d+)", content))
        self.assertTrue(all(abs(int(w) - 595) <= 1 and abs(int(h) - 842) <= 1 for w, h in sizes) and sizes, sizes)
        self.assertGreater(content.count(b"/MediaBox"), 4)  # pages of paper
        whole = page(self.place / "hit")
        self.assertRegex(whole, r'<details class="screen"><summary>All options in force')  # behind a click, and not on paper
        self.assertIn(".screen { display: none; }", whole[whole.index("@media print"):])

    def test_no_table_leaves_the_page(self):
        """On a screen and on a telephone: what is wider than its page is moved within it."""
        script = """<script>
        const wide = [...document.querySelectorAll("body *")].filter((one) => !one.closest(".rows") && one.tagName !== "CANVAS"
          && one.getBoundingClientRect().right > document.documentElement.clientWidth + 1);
        const line = document.createElement("pre");
        line.id = "seen";
        line.textContent = JSON.stringify([document.documentElement.scrollWidth, document.documentElement.clientWidth, wide.length]);
        document.body.append(line);</script></body>"""
        used = browser.needed(self)
        for width in (1280, 500):  # a window is not narrower
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder, "page.html")
                path.write_text(page(self.place / "hit").replace("</body>", script), encoding="utf-8")
                seen = browser.open_page(used, path, f"--window-size={width},800").stdout
            scrolled, shown, beyond = json.loads(html.unescape(re.search(r'<pre id="seen">(.*?)</pre>', seen)[1]))
            self.assertLess(abs(shown - width), 20)
            self.assertEqual((scrolled, beyond), (shown, 0), width)


if __name__ == "__main__":
    unittest.main()
