"""run/tradeoff on several scenes: estimated errors beside true ones, of the mesh by two splits, and where there is no estimate."""
import csv
import math
import os
import tempfile
import unittest

import program
from two_buildings import pounding

PROCESSORS = 2  # it starts runs

STICK = """
structures: stick
contacts: stop
probes: middle
end_time: 0.6
modes: 0
stick:
  mesh: {meshes}/trade-stick.geo
  mesh_set: "count=2,height=3,cells=3"
  clamp: base
  damping: {{alpha: 1, beta: 1e-4}}
  shaft: {{element: beam, material: concrete, section: shaft}}
  levels: {{element: point_mass, mass: 2e4, rotary_inertia: "1e4,1e4,1e4"}}
  {more}
material: {{concrete: {{young: 30e9, poisson: 0.2, density: 2500}}}}
section: {{shaft: {{area: 0.3, inertia_y: 8e-3, inertia_z: 8e-3, torsion: 0.016, z_axis: "1,0,0"}}}}
stop: {{secondary: "stick:0,0,6", primary: wall, along: "1,0,0", gap: 0.002}}
middle: {{structure: stick, at: "0,0,4"}}
motion: {{x: {{target: {spectra}/near_field_rock.csv, pga: 3, seed: 5, duration: 12, envelope: "0.1,4"}}}}
"""


class SplitScenes(unittest.TestCase):
    """Two sticks, one of which begins to slide on its foot: told and true errors, the mesh by two splits."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pounding-")
        slides = 'base: {element: grounded_spring, stiffness: "1e9,1e9,1e10", yield_force: "2e4,2e4,0", yield_circle: x+y}'
        cls.scenes = []
        for name, more in (("elastic", ""), ("sliding", slides)):
            cls.scenes.append(os.path.join(cls.folder, f"{name}.yaml"))
            text = STICK.format(meshes=os.path.join(program.SOURCE, "meshes"), more=more,
                                spectra=os.path.join(program.SOURCE, "petsc-options", "spectra"))
            with open(cls.scenes[-1], "w") as file:
                file.write(text if not more else text.replace("clamp: base", "clamp: base:rx+ry+rz"))
        cls.out = os.path.join(cls.folder, "study")
        cls.done = program.command("tradeoff", "--scene", *cls.scenes, "--only", "modal-25", "--estimate", 0.2, "--ranks", 1,
                                   "--accuracy", 0.5, "--output", cls.out)

    def test_told_and_true_errors_stand_in_one_table(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        with open(os.path.join(self.out, "certificates.csv"), newline="") as file:
            elastic, sliding = csv.DictReader(file)
        self.assertEqual((elastic["scene"], elastic["setting"], elastic["why"]), ("elastic", "modal-25", ""))
        runs = {name: pounding.load(os.path.join(self.out, "elastic", "scene", name)) for name in ("full", "split-2", "modal-25")}
        frequency, finest = runs["split-2"].spectrum("middle", "x")
        logs = [math.log(a / b) for f, a, b in zip(frequency, runs["modal-25"].spectrum("middle", "x")[1], finest)]
        rms = math.sqrt(sum(value**2 for value in logs) / len(logs))
        self.assertAlmostEqual(float(elastic["rms"]) / rms, 1, delta=0.01)
        told = runs["modal-25"].summary["fidelity"]
        self.assertAlmostEqual(float(elastic["estimate"]) / told["whole_rms"]["1-400"], 1, delta=1e-9)
        self.assertGreater(runs["split-2"].summary["structures"]["stick"]["elements"],
                           3 * runs["full"].summary["structures"]["stick"]["elements"])
        self.assertLess(abs(math.log(float(elastic["estimate"]) / float(elastic["rms"]))), math.log(2))
        self.assertEqual(sliding["setting"], "full")  # no run tells its error: finer ones do
        self.assertIn("group base of stick is not linear", sliding["why"])
        self.assertLess(abs(math.log(float(sliding["estimate"]) / float(sliding["rms"]))), math.log(2))

    def test_each_has_a_figure_and_a_recommendation(self):
        for name in ("elastic", "sliding"):
            with open(os.path.join(self.out, name, "tradeoff.md")) as file:
                self.assertIn("| 50 % | ", file.read())
            self.assertGreater(os.path.getsize(os.path.join(self.out, name, "tradeoff.png")), 20000)


if __name__ == "__main__":
    unittest.main()
