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

sys.path[:0] = [os.path.join(program.SOURCE, "run"), os.path.join(program.SOURCE, "python")]
sys.dont_write_bytecode = True
from parts.plot import scene_mesh, view  # noqa: E402
from pounding.results import Missing  # noqa: E402

CASE = [*program.COARSE_PAIR, "-modes", 3, "-write_modes", "-write_model", "-s1_initial_velocity", "1.5,0,0",
        "-end_time", 0.04, "-fields_interval", 0.002]
SCRIPT = """
window.onerror = (text) => { failures.push(text); };
const failures = [], seen = {}, view = window.poundingView;
const look = (name) => { seen[name] = view.picture(); };
look("model");
document.querySelectorAll("#view input[type=checkbox]")[6].click();
look("without the first slab");
document.querySelectorAll("#view input[type=checkbox]")[6].click();
look("model again");
view.show("mode 0"); look("mode 1");
view.show("mode 1"); look("mode 2");
view.strike.click(); look("strongest impact");
for (const button of document.querySelectorAll("#view button")) if (button.textContent === "plan") button.click();
look("plan");
const line = document.createElement("pre");
line.id = "seen";
line.textContent = JSON.stringify({seen, failures, modes: view.modes, frames: view.frames, nodes: view.nodes,
  time: view.state.time, options: [...document.querySelectorAll("#view option")].map((one) => one.textContent)});
document.body.append(line);
"""


def unpacked(text, kind):
    return np.frombuffer(base64.b64decode(text), dtype=kind)


class View(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-view-")
        result = program.run([*CASE, "-output", cls.folder], 2)
        assert result.returncode == 0, result.stderr
        drawn = program.command("plot", cls.folder)
        assert drawn.returncode == 0, drawn.stderr
        cls.said = drawn.stdout
        cls.page = Path(cls.folder, "report.html").read_text(encoding="utf-8")
        cls.data = json.loads(re.search(r'id="view-data">(.*?)</script>', cls.page, re.DOTALL)[1])

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
        self.assertEqual([mark["name"] for mark in self.data["marks"]],
                         ["supports", "contact floor1", "contact floor2", "probes"])
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

    def test_places_of_the_impacts_are_drawn(self):
        self.assertTrue(os.path.exists(os.path.join(self.folder, "impact_places.png")))
        self.assertIn("Where they hit", self.page)

    def test_what_is_too_large_for_a_page_is_left_out_with_a_word(self):
        for module, limit in ((view, "MOST_NODES"), (scene_mesh, "MOST_CELLS")):
            with unittest.mock.patch.object(module, limit, 100), self.assertRaisesRegex(Missing, "more than the 100"):
                view.data(Path(self.folder))
        with unittest.mock.patch.object(view, "MOST_BYTES", 6 * 392 * 5):
            motion = view.data(Path(self.folder))["motion"]
        self.assertGreater(motion["stride"], 1)
        self.assertLessEqual(len(motion["times"]), 6)
        whole = self.data["motion"]
        self.assertEqual(motion["times"][motion["strongest"]], whole["times"][whole["strongest"]])

    def test_a_folder_without_a_mesh_gives_a_page_without_a_view(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("summary.json", "history.h5", "impacts.csv", "energy.csv", "spectra.csv"):
                shutil.copy(os.path.join(self.folder, name), folder)
            drawn = program.must_do(self, "plot", folder)
            self.assertIn("view skipped: no fields.h5", drawn.stdout)
            self.assertNotIn('id="view"', Path(folder, "report.html").read_text(encoding="utf-8"))
            Path(folder, "fields.h5").write_bytes(b"no HDF5 at all")
            drawn = program.must_do(self, "plot", folder)
            self.assertIn("cannot be read", drawn.stdout)

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
        for name, picture in seen.items():
            self.assertGreater(picture["part"], 0.02, name)
            self.assertEqual(picture["error"], 0, name)
        self.assertEqual(seen["model"], seen["model again"])
        self.assertLess(seen["without the first slab"]["part"], 0.8 * seen["model"]["part"])
        different = [picture["sum"] for name, picture in seen.items() if name != "model again"]
        self.assertEqual(len(set(different)), len(different))


if __name__ == "__main__":
    unittest.main()
