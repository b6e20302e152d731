"""Accidental torsion of a study, a factor on the closings of its joints: numbers by hand, the study beside that without, mistakes."""
import os
import types
import unittest

import numpy

import program
import two_buildings  # noqa: F401
from study_command import StudyCommand

from pounding import joint
from pounding.fragility import torsion
from pounding.fragility.analysis import Analysis


PLACES = numpy.array([[0, 0, 3.0], [0, 4, 3], [0, 0, 6]])
GAPS = numpy.array([[.05, .04, .03]])
CLOSINGS = numpy.array([[.01, .02, .015]])
OUTCOMES = types.SimpleNamespace(
    contacts=["low", "high", "far"], pair_contact=numpy.array([0, 0, 1.0]), pair_place=PLACES, pair_gap=GAPS, pair_least=GAPS - CLOSINGS,
    pair_time=numpy.zeros((1, 3)), pair_moved=numpy.stack([CLOSINGS, 2 * CLOSINGS, 3 * CLOSINGS], -1),
    smallest_gap=numpy.array([[.02, .015, numpy.inf]]))


class ByHand(unittest.TestCase):
    def test_factor_of_an_eccentricity(self):
        self.assertAlmostEqual(torsion.of_eccentricity(.05), 1.3, delta=1e-15)
        self.assertAlmostEqual(torsion.of_eccentricity(.05, .25), 1.15, delta=1e-15)
        self.assertAlmostEqual(torsion.of_eccentricity(.1, .5), 1.6, delta=1e-15)
        # equal walls side by side turn as even stiffness does: k times the mean of their x^2, which is L^2 / 12
        walls = (numpy.arange(1000) + .5) / 1000 - .5
        self.assertAlmostEqual(1 + .05 * .5 / (walls**2).mean(), torsion.of_eccentricity(.05), delta=1e-6)

    def test_table_by_elevation(self):
        low, high = joint.by_elevation(OUTCOMES, [0, 5, 10], torsion=1.5)
        self.assertAlmostEqual(low["closing largest [m]"], .03, delta=1e-15)
        self.assertAlmostEqual(low["ratio"], .75, delta=1e-12)
        self.assertAlmostEqual(low["margin [m]"], .01, delta=1e-15)
        self.assertAlmostEqual(low["relative z mean [m]"], .09, delta=1e-15)
        self.assertAlmostEqual(high["margin [m]"], .03 - .0225, delta=1e-15)
        self.assertEqual(low["gap [m]"], .04)
        self.assertEqual(joint.by_elevation(OUTCOMES, [0, 5, 10], torsion=1.0), joint.by_elevation(OUTCOMES, [0, 5, 10]))
        self.assertEqual(joint.by_elevation(OUTCOMES, [0, 5, 10], torsion=2.5)[0]["touching"], 1)  # 40 mm that close 50

    def test_what_is_left_of_the_joint(self):
        one = types.SimpleNamespace(outcomes=OUTCOMES)
        numpy.testing.assert_allclose(Analysis.left(one, 1.5), [[.01, .0075, numpy.inf]], rtol=0, atol=1e-15)
        self.assertIs(Analysis.left(one, 1), OUTCOMES.smallest_gap)


class InAStudy(StudyCommand):
    def test_factor_is_on_the_joint_alone(self):
        alone = {"soils": None, "states": None, "submittal": {"question": "Is it wide enough?"}}
        self.fragility("--runner", "ensemble", **alone)
        names = ("joint", "joint_by_elevation", "probability", "members", "first_contact")
        before = {name: program.rows_of(self.place / "out" / f"{name}.csv") for name in names}
        bytes_before = {name: (self.place / "out" / f"{name}.csv").read_bytes() for name in names}
        said = self.fragility("--collect", **alone, accidental_torsion={"eccentricity": .05}).stdout
        self.assertIn("closings are 1.3 times those of the runs, for accidental torsion", said)
        after = {name: program.rows_of(self.place / "out" / f"{name}.csv") for name in names}
        for name in names[2:]:
            self.assertEqual(after[name], before[name], name)
        for old, new in zip(before["joint"], after["joint"]):  # joints by drawing without deviations need what they close
            for key in ("50 % [m]", "16 % [m]"):
                self.assertLess(abs(float(new[key]) / float(old[key]) - 1.3), 1e-6, new)
        for old, new in zip(before["joint_by_elevation"], after["joint_by_elevation"]):
            for key in ("closing largest [m]", "closing mean [m]", "relative x largest [m]", "ratio"):
                self.assertLess(abs(float(new[key]) - 1.3 * float(old[key])), 1e-6 * float(old[key]) + 1e-12, key)
            self.assertEqual(new["gap [m]"], old["gap [m]"])
        page = (self.place / "out" / "submittal.html").read_text()
        self.assertIn("Accidental torsion", page)
        self.assertIn("an eccentricity e of 5 % of the plan dimension L", page)
        self.fragility("--collect", **alone, accidental_torsion=1)
        self.assertEqual({name: (self.place / "out" / f"{name}.csv").read_bytes() for name in names}, bytes_before)
        self.assertNotIn("Accidental torsion", (self.place / "out" / "submittal.html").read_text())

    def test_mistakes(self):
        for words, value in (("accidental_torsion: 0.9 is below 1", .9), ("accidental_torsion: 'much' is not a number", "much"),
                             ("accidental_torsion: eccentricity is missing", {"at": .5}),
                             ("accidental_torsion: eccentricity: 5 is not below 0.5", {"eccentricity": 5}),
                             ("accidental_torsion: at: 0.7 is beyond the edge", {"eccentricity": .05, "at": .7}),
                             ("accidental_torsion: e is unknown", {"e": .05})):
            with self.subTest(words):
                self.must_be_refused(words, accidental_torsion=value)


if __name__ == "__main__":
    unittest.main()
