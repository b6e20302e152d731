"""The table by elevation of a joint, against numbers by hand: two members, two contacts, pairs at four elevations."""
import os
import tempfile
import types
import unittest

import numpy

import program  # noqa: F401: the package's place
import two_buildings  # noqa: F401
from pounding import joint

PLACES = numpy.array([[0, 0, 3.0], [0, 4, 3], [0, 0, 6], [0, 4, 9], [1, 0, 6]])
GAPS = numpy.array([[.05, .04, .03, .02, .06]] * 2)
CLOSINGS = numpy.array([[.01, .02, .015, .019, .001], [.005, .03, .012, .025, .002]])


def outcomes():
    moved = numpy.stack([CLOSINGS, 2 * CLOSINGS, 3 * CLOSINGS], -1)
    return types.SimpleNamespace(contacts=["low", "bridge"], pair_contact=numpy.array([0, 0, 0, 0, 1.0]), pair_place=PLACES, pair_gap=GAPS,
                                 pair_least=GAPS - CLOSINGS, pair_time=numpy.arange(10.0).reshape(2, 5), pair_moved=moved)


class JointByElevation(unittest.TestCase):
    def test_rows_by_hand(self):
        rows = joint.by_elevation(outcomes(), [0, 5, 10])
        self.assertEqual([(row["contact"], row["from [m]"], row["to [m]"], row["pairs"]) for row in rows],
                         [("low", 0, 5, 2), ("low", 5, 10, 2), ("bridge", 5, 10, 1)])
        below, above, bridge = rows
        self.assertEqual((below["gap [m]"], below["gap at y [m]"]), (.04, 4))
        self.assertAlmostEqual(below["closing mean [m]"], (.02 + .03) / 2, delta=1e-15)
        self.assertAlmostEqual(below["closing 84 % [m]"], .02 + .84 * .01, delta=1e-15)
        self.assertAlmostEqual(below["closing largest [m]"], .03, delta=1e-15)
        self.assertEqual((below["closing at y [m]"], below["closing time [s]"], below["closing member"]), (4, 6, 2))
        self.assertAlmostEqual(below["relative z largest [m]"], .09, delta=1e-15)
        self.assertAlmostEqual(below["relative y mean [m]"], .05, delta=1e-15)
        self.assertAlmostEqual(below["ratio"], .75, delta=1e-12)
        self.assertAlmostEqual(below["margin [m]"], .01, delta=1e-15)
        self.assertEqual((below["touching"], below["first"]), (0, 0))
        self.assertAlmostEqual(above["ratio"], 1.25, delta=1e-12)
        self.assertAlmostEqual(above["margin [m]"], -.005, delta=1e-15)
        self.assertEqual((above["touching"], above["first"]), (.5, 2))  # of both members the pair at 9 m is the nearest
        self.assertEqual(bridge["first"], 0)

    def test_some_members_and_gaps_of_the_joint_as_built(self):
        rows = joint.by_elevation(outcomes(), [0, 5, 10], members=[0], built=GAPS[:1] / 2)
        self.assertAlmostEqual(rows[0]["gap [m]"], .02, delta=1e-15)
        self.assertAlmostEqual(rows[0]["margin [m]"], 0, delta=1e-15)  # 20 mm that close 20 mm
        self.assertEqual(rows[1]["closing member"], 1)
        self.assertAlmostEqual(rows[1]["ratio"], 1.9, delta=1e-12)

    def test_no_pair_is_lost(self):
        rows = joint.by_elevation(outcomes(), [5, 8])
        self.assertEqual([(row["from [m]"], row["to [m]"]) for row in rows if row["contact"] == "low"],
                         [(-numpy.inf, 5), (5, 8), (8, numpy.inf)])
        self.assertEqual(sum(row["pairs"] for row in rows), len(PLACES))
        of_their_own = joint.by_elevation(outcomes())
        self.assertEqual([row["pairs"] for row in of_their_own if row["contact"] == "low"], [2, 1, 1])
        on_edge = joint.by_elevation(outcomes(), [3, 6, 9])
        self.assertEqual([row["pairs"] for row in on_edge if row["contact"] == "low"], [2, 2])

    def test_refused(self):
        with self.assertRaisesRegex(joint.JointError, "between 10 and 15 m lies no pair of a contact; the joints go from 3 to 9 m"):
            joint.by_elevation(outcomes(), [0, 10, 15])
        for wrong in ([3], [5, 4], [1, 1]):
            with self.assertRaisesRegex(joint.JointError, "two or more that rise"):
                joint.by_elevation(outcomes(), wrong)
        with self.assertRaisesRegex(joint.JointError, "no member"):
            joint.by_elevation(outcomes(), [0, 10], members=[])

    def test_table_and_figure(self):
        rows = joint.by_elevation(outcomes(), [5, 8])
        with tempfile.TemporaryDirectory() as folder:
            joint.write(folder, {"pounding": rows, "apart": rows})
            table = program.read_csv(os.path.join(folder, joint.TABLE))
            self.assertEqual(table["runs"], ["pounding"] * len(rows) + ["apart"] * len(rows))
            self.assertAlmostEqual(float(table["margin [m]"][2]), -.005, delta=1e-12)
            page, = joint.draw(folder, {"pounding": rows, "apart": rows})
            self.assertGreater(os.path.getsize(os.path.join(folder, page["file"])), 5000)


if __name__ == "__main__":
    unittest.main()
