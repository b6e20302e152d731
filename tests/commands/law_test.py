"""run/law: the loops of a scene's laws, followed by the program, with their energy."""
import csv
import os
import tempfile
import unittest

import numpy

import program

SCENE = """
structures: chain
end_time: 1
chain:
  mesh: tests/meshes/chain.geo
  first: {element: point_mass, mass: 50}
  second: {element: point_mass, mass: 1}
  support: {element: grounded_spring, stiffness: "2e5,0,0", rule: peak, skeleton: "0.005,1000,0.02,1000"}
"""


class Law(unittest.TestCase):
    def test_table_and_figure(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = os.path.join(folder, "scene.yaml")
            with open(scene, "w") as file:
                file.write(SCENE)
            result = program.must_do(self, "law", scene, "--amplitudes", "0.5,4", "--out", folder)
            self.assertGreater(os.path.getsize(os.path.join(folder, "laws.png")), 5000)
            with open(os.path.join(folder, "laws.csv"), newline="") as file:
                rows = list(csv.DictReader(file))
        self.assertEqual({row["law"] for row in rows}, {"chain:support:x"})
        e, f, lost = (numpy.array([float(row[name]) for row in rows]) for name in ("elongation", "force", "lost_J"))
        self.assertEqual(abs(e).max(), 0.02)
        self.assertEqual(abs(f).max(), 1000)
        small = numpy.flatnonzero(abs(e) > 0.0025)[0]
        self.assertLess(lost[small - 1], 1e-12)
        # What is under the loops was lost or is held.
        area = numpy.sum((f[1:] + f[:-1]) / 2 * numpy.diff(e))
        self.assertAlmostEqual(area, lost[-1] + float(rows[-1]["stored_J"]), delta=1e-6)
        self.assertIn("lost", result.stdout)

    def test_nothing_that_yields(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = os.path.join(folder, "scene.yaml")
            with open(scene, "w") as file:
                file.write(SCENE.replace(', rule: peak, skeleton: "0.005,1000,0.02,1000"', ""))
            result = program.command("law", scene, "--out", folder)
        self.assertEqual(result.returncode, 1)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertIn("nothing in the scene yields", result.stderr)


if __name__ == "__main__":
    unittest.main()
