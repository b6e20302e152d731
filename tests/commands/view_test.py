"""The view of report.html: what is embedded is the model and its motion, and a browser draws it."""
import base64
import html
import json
import os
import re
import shutil
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import h5py
import numpy as np

import browser
import program

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
sys.dont_write_bytecode = True
from pounding.plot import report, scene_mesh, view  # noqa: E402
from pounding.results import Missing, load  # noqa: E402

CASE = [*program.COARSE_PAIR, "-modes", 3, "-write_modes", "-write_model", "-s1_initial_velocity", "1.5,0,0",
        "-end_time", 0.04, "-fields_interval", 0.002, "-forces", "legs,posts", "-legs_structure", "s1", "-legs_kind", "members",
        "-legs_group", "column", "-posts_structure", "s1", "-posts_kind", "members", "-posts_group", "joint_column",
        "-posts_at", "0,0,0.2; 3.36,0,0.2", "-equipment", "relay,pump", "-relay_probe", "s1_floor1", "-relay_capacity_unit", "g",
        "-pump_probe", "s2_floor2", "-pump_capacity_unit", "g"]
SCRIPT = """
window.onerror = (text) => { failures.push(text); };
const failures = [], seen = {}, view = window.poundingView;
const look = (name) => { seen[name] = view.picture(); };
look("model");
document.querySelectorAll("#view input[type=checkbox]")[7].click();
look("without the first slab");
document.querySelectorAll("#view input[type=checkbox]")[7].click();
look("model again");
view.show("mode 0"); look("mode 1");
view.show("mode 1"); look("mode 2");
view.strike.click(); look("strongest impact");
seen.now = document.querySelectorAll("#view .bar")[1].textContent;
const paint = [...document.querySelectorAll("#view label")].find((one) => one.textContent.startsWith("colours")).firstChild;
paint.click(); look("strongest impact without colours"); paint.click();
view.state.force = "My"; view.refresh(); look("strongest impact with a diagram");
seen.force = view.forces().value; view.state.force = ""; view.refresh();
for (const button of document.querySelectorAll("#view button")) if (button.textContent === "plan") button.click();
look("plan");
const line = document.createElement("pre");
line.id = "seen";
line.textContent = JSON.stringify({seen, failures, modes: view.modes, frames: view.frames, nodes: view.nodes,
  time: view.state.time, options: [...document.querySelectorAll("#view select:first-child option")].map((one) => one.textContent)});
document.body.append(line);
"""


def unpacked(text, kind):
    return np.frombuffer(base64.b64decode(text), dtype=kind)


class View(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-view-")
        capacities = []
        for name, capacity in (("relay", 1e-3), ("pump", 1e6)):  # fails, and holds
            path = Path(cls.folder, f"{name}.csv")
            path.write_text(f"1,{capacity}\n100,{capacity}\n")
            capacities += [f"-{name}_capacity", path]
        result = program.run([*CASE, *capacities, "-output", cls.folder], 2)
        assert result.returncode == 0, result.stderr
        drawn = program.command("plot", cls.folder)
        assert drawn.returncode == 0, drawn.stderr
        cls.said = drawn.stdout
        cls.page = Path(cls.folder, "report.html").read_text(encoding="utf-8")
        cls.data = json.loads(re.search(r'id="view-data">(.*?)</script>', cls.page, re.DOTALL)[1])

    def test_yielding_is_marked_by_demand_over_the_first_corner(self):
        result = load(Path(self.folder))
        points = unpacked(self.data["points"], "<f4").reshape(-1, 3)
        places, demands = points[[0, 3, 3, 9, 17]] + 1e-3, [0.4, 3.0, 1.5, 1.0, 12.0]  # two laws of one element
        result.yielding = {"law": np.array(["s1:wall:shear"] * 5), "ductility": np.array(demands),
                           **{axis: places[:, d] for d, axis in enumerate("xyz")}}
        marks = [(mark["name"], mark["colour"], unpacked(mark["nodes"], "<u4").tolist())
                 for mark in view.data(result)["marks"] if mark["name"].startswith("yielding")]
        self.assertEqual(marks, [
            ("yielding: no farther than 1 times the first corner", view.HOLDS, [0, 9]),
            ("yielding: 2 to 4 times the first corner", view.DEMANDS[2][1], [3]),
            ("yielding: beyond 4 times the first corner", view.FAILS, [17])])

    def test_the_page_holds_the_surface_and_the_motion(self):
        self.assertNotIn("skipped: no fields", self.said)
        groups = {group["name"]: group for group in self.data["groups"]}
        points = unpacked(self.data["points"], "<f4").reshape(-1, 3)
        # Two slabs of 7 x 5 and of 5 x 5 bricks: their outer faces, two triangles each.
        for name, (nx, ny) in {"s1:slab": (7, 5), "s2:slab": (5, 5)}.items():
            triangles = unpacked(groups[name]["triangles"], "<u4").reshape(-1, 3)
            self.assertEqual(len(triangles), 2 * 2 * (2 * nx * ny + 2 * nx + 2 * ny))
            a, b, c = (points[triangles[:, i]] for i in range(3))
            area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
            lx = {"s1:slab": 3.36, "s2:slab": 2.16}[name]
            self.assertAlmostEqual(area, 2 * (2 * lx * 2.28 + 2 * 0.22 * (lx + 2.28)), places=3)
        equipment = load(self.folder).verdicts
        demand = {name: one["needed"] / one["ratio"] for name, one in equipment.items()}
        self.assertGreater(demand["relay"], 1)
        self.assertLess(demand["pump"], 1)
        self.assertEqual([(mark["name"], mark["colour"]) for mark in self.data["marks"]][3:], [
            ("probes", "#0a6e0a"), (f"relay: {demand['relay']:.2f} of its capacity", view.FAILS),
            (f"pump: {demand['pump']:.2f} of its capacity", view.HOLDS)])
        self.assertEqual([mark["name"] for mark in self.data["marks"]][:3], ["supports", "contact floor1", "contact floor2"])
        self.assertEqual(len(unpacked(self.data["marks"][0]["nodes"], "<u4")), 8)
        motion = self.data["motion"]
        values = unpacked(motion["values"], "<i2").reshape(21, -1, 3) * motion["largest"] / 32767
        with h5py.File(os.path.join(self.folder, "fields.h5"), "r") as file:
            for name in ("s1", "s2"):
                for node, place in enumerate(file[name]["coordinates"][()]):
                    row = np.flatnonzero(np.linalg.norm(points - place, axis=1) < 1e-5)
                    moved = file[name]["displacement/000020"][node]
                    self.assertLess(min(abs(values[20][i] - moved).max() for i in row), motion["largest"] / 32767)
        total = program.summary(self.folder)["impacts"]["total_impulse"]
        self.assertAlmostEqual(sum(motion["impulse"]) / total, 1, delta=1e-9)
        self.assertEqual(motion["strongest"], int(np.argmax(motion["impulse"])))
        self.assertEqual(len(self.data["modes"]), 6)

    def test_gaps_and_forces_are_those_of_the_history(self):
        run = load(self.folder)
        self.assertEqual([gap["name"] for gap in self.data["gaps"]], run.contacts)
        for gap, column in zip(self.data["gaps"], run.history["gap"].T):
            self.assertAlmostEqual(min(gap["gap"]), 1e3 * np.nanmin(column), delta=1e-4)
        history = [beam for beam in self.data["members"] if beam["values"]["My"][0]["at"]]
        self.assertEqual(len(history), 2)
        self.assertGreater(len(self.data["members"]), 2)  # of the others the largest values alone
        peaks = {(str(item), int(element), str(component)): peak for item, element, component, peak in zip(
            *(run.forces[key] for key in ("item", "element", "component", "peak")))}
        points = unpacked(self.data["points"], "<f4").reshape(-1, 3)
        for beam in self.data["members"]:
            item, element = beam["name"].split(", element ")
            for quantity, component in (("My", "My2"), ("Vz", "Vz")):
                told = beam["values"][quantity][1]
                self.assertEqual(told["largest"], peaks[item, int(element), component])
                if beam in history:
                    _, force = run.force(f"{item}.{element}.{component}")
                    np.testing.assert_allclose(told["at"], np.interp(self.data["motion"]["times"], run.history["time"], force))
            along = points[beam["nodes"][1]] - points[beam["nodes"][0]]
            axes = np.array([along / np.linalg.norm(along), beam["y"], beam["z"]])
            np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-6)
            self.assertGreater(np.linalg.det(axes), 0)

    def test_a_run_that_sags_is_shown_from_its_rest(self):
        """A copy whose frames all have a displacement more: it is in the places, not in the motion."""
        with tempfile.TemporaryDirectory() as folder:
            for name in ("summary.json", "history.h5", "fields.h5", "model.h5"):
                shutil.copy(os.path.join(self.folder, name), folder)
            with h5py.File(os.path.join(folder, "fields.h5"), "r+") as file:
                for name in ("s1", "s2"):
                    for frame in file[name]["displacement"].values():
                        frame[...] = frame[...] + [0, 0, -0.25]
            sagged = view.data(load(folder))
        self.assertAlmostEqual(sagged["sag"], 0.25, delta=1e-12)
        self.assertEqual(self.data["sag"], 0)
        before, after = (unpacked(one["points"], "<f4").reshape(-1, 3) for one in (self.data, sagged))
        np.testing.assert_allclose(after, before + [0, 0, -0.25], atol=1e-6)
        self.assertAlmostEqual(sagged["motion"]["largest"] / self.data["motion"]["largest"], 1, delta=1e-9)

    def test_places_of_the_impacts_are_drawn(self):
        self.assertTrue(os.path.exists(os.path.join(self.folder, "impact_places.png")))
        self.assertIn("Where they hit", self.page)

    def test_what_is_too_large_for_a_page_is_left_out_with_a_word(self):
        for module, limit in ((view, "MOST_NODES"), (scene_mesh, "MOST_CELLS")):
            with unittest.mock.patch.object(module, limit, 100), self.assertRaisesRegex(Missing, "more than the 100"):
                view.data(load(self.folder))
        with unittest.mock.patch.object(view, "MOST_BYTES", 6 * 392 * 5):
            motion = view.data(load(self.folder))["motion"]
        self.assertGreater(motion["stride"], 1)
        self.assertLessEqual(len(motion["times"]), 6)
        whole = self.data["motion"]
        self.assertEqual(motion["times"][motion["strongest"]], whole["times"][whole["strongest"]])

    def test_a_folder_without_a_mesh_gives_a_page_without_a_view(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("summary.json", "history.h5", "impacts.csv", "energy.csv", "spectra.csv"):
                shutil.copy(os.path.join(self.folder, name), folder)
            with unittest.mock.patch.object(report._Drawn, "html", return_value=""):  # figures take seconds
                _, skipped, page = report.write(load(Path(folder)))
            self.assertEqual(len(skipped), 1)
            self.assertIn("view skipped: no fields.h5", skipped[0])
            self.assertNotIn('id="view"', Path(page).read_text(encoding="utf-8"))
            Path(folder, "fields.h5").write_bytes(b"no HDF5 at all")
            with self.assertRaisesRegex(Missing, "cannot be read"):
                view.texts(load(Path(folder)))

    def test_a_browser_draws_it(self):
        used = browser.needed(self)
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder, "page.html")
            page.write_text(self.page.replace("</body>", f"<script>{SCRIPT}</script></body>"), encoding="utf-8")
            result = browser.open_page(used, page)
        self.assertEqual([line for line in result.stderr.splitlines() if ":CONSOLE" in line], [])
        found = re.search(r'<pre id="seen">(.*?)</pre>', result.stdout, re.DOTALL)
        self.assertIsNotNone(found, result.stderr[-2000:])
        told = json.loads(html.unescape(found[1]))
        self.assertEqual(told["failures"], [])
        self.assertEqual((told["modes"], told["frames"]), (6, 21))
        self.assertEqual(len(told["options"]), 8)
        self.assertEqual(told["time"], self.data["motion"]["strongest"])
        seen = told["seen"]
        run, at = load(self.folder), self.data["motion"]["strongest"]
        self.assertIn(f"Gaps: {run.contacts[0]} ", seen.pop("now"))
        now = [end["at"][at] if end["at"] else end["largest"] for beam in self.data["members"] for end in beam["values"]["My"]]
        self.assertAlmostEqual(seen.pop("force") / max(now, key=abs), 1, delta=1e-12)
        for name, picture in seen.items():
            self.assertGreater(picture["part"], 0.02, name)
            self.assertEqual(picture["error"], 0, name)
        for name in ("model", "plan", "mode 1"):  # it fills its canvas
            self.assertGreater(max(seen[name]["across"], seen[name]["tall"]), 0.85, name)
        self.assertEqual(seen["model"], seen["model again"])
        self.assertLess(seen["without the first slab"]["part"], 0.8 * seen["model"]["part"])
        different = [picture["sum"] for name, picture in seen.items() if name != "model again"]
        self.assertEqual(len(set(different)), len(different))


if __name__ == "__main__":
    unittest.main()
