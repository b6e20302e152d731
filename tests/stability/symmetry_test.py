"""The same pair seen differently: mirrored, turned, moved, renumbered, with its sides swapped.

None of that changes what the houses do; the histories agree to round-off, and to the last bit where
the arithmetic is the same. Lumped rotary inertia is diagonal along x, y and z: a beam that is turned
out of these axes is, by a little, another beam. So the pair turned by any angles stands on bars; on
beams it is turned by quarter turns.
"""
import unittest

import numpy

from history import History, scenes
from houses import Pair, Run, assert_same

ROUND_OFF = 1e-11


def rotation(*degrees):
    """Turns about x, then y, then z."""
    matrix = numpy.eye(3)
    for axis, angle in enumerate(numpy.radians(degrees)):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turn = numpy.eye(3)
        turn[i, i] = turn[j, j] = numpy.cos(angle)
        turn[j, i], turn[i, j] = numpy.sin(angle), -numpy.sin(angle)
        matrix = turn @ matrix
    return matrix


def moved(shift, scale=1.0):
    pair = Pair()
    pair.left, pair.right = (mesh.placed(lambda nodes: nodes * scale + shift) for mesh in (pair.left, pair.right))
    return pair


class Symmetry(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.reference = Run(unittest.TestCase(), Pair())

    def test_mirrored(self):
        pair = Pair()
        pair.left, pair.right = pair.left.mirrored(), pair.right.mirrored()
        pair.velocity, pair.record = pair.velocity * (-1, 1, 1), pair.record * (-1, 1, 1)
        run = Run(self, pair, ranks=2)
        for values in run.vectors.values():
            values *= (-1, 1, 1)
        # The rows of bricks run the other way: their sums are others.
        assert_same(self, run, self.reference, 1e-11)

    def test_moved_by_a_thousand_kilometres(self):
        # Coordinates are exact before and after: so are their differences, and the gap is no coordinate.
        for shift in ((1e6, 1e6, 1e6), (1e6 + 0.3, -1e6 + 0.1, 0)):
            assert_same(self, Run(self, moved(shift)), self.reference, 0)

    def test_moved_coordinates_that_are_rounded(self):
        # Where the sums are rounded to 1e-10 m, elements of 1 m change by 1e-10, and so does the answer.
        here, there = (Run(self, moved(shift, 0.999)) for shift in (0, 1e6))
        self.assertGreater(abs(there.vectors["velocity"] - here.vectors["velocity"]).max(), 0)
        assert_same(self, there, here, 1e-8)

    def test_renumbered(self):
        for seeds, ranks in (((1, 2), 1), ((3, 4), 2), ((5, 6), 3)):
            pair = Pair()
            pair.seeds = seeds
            assert_same(self, Run(self, pair, ranks), self.reference, ROUND_OFF)

    def test_sides_swapped(self):
        pair = Pair()
        pair.contact = {"secondary": "right:face", "primary": "left:face"}
        run = Run(self, pair)
        assert_same(self, run, self.reference, 0)
        self.assertEqual(run.impacts["impulse"], self.reference.impacts["impulse"])

    def test_quarter_turns(self):
        for degrees in ((90, 0, 0), (0, 90, 90), (180, 0, -90)):
            turn = numpy.rint(rotation(*degrees))
            assert_same(self, Run(self, Pair(turn=turn)), self.reference, ROUND_OFF)


class Rotation(unittest.TestCase):
    def test_turned_by_any_angles(self):
        turned, upright = (Pair(turn=turn, beams=False) for turn in (rotation(30, 40, 50), numpy.eye(3)))
        reference = Run(self, upright)
        run = Run(self, turned)
        assert_same(self, run, reference, 1e-10)
        for name, structure in run.summary["structures"].items():
            self.assertAlmostEqual(structure["omega_max"] / reference.summary["structures"][name]["omega_max"],
                                   1, delta=1e-10)


class UnmatchedFaces(unittest.TestCase):
    def test_swapped_sides_share_out_the_same_impulse(self):
        total = []
        for secondary, primary in (("one:x_max", "two:x_min"), ("two:x_min", "one:x_max")):
            words = scenes.blocks((2.0, 3.0), young=1e6, time_step=1e-4, end_time=0.02)
            words[words.index("-one_mesh_set") + 1] = "x0=-1,nx=4,ny=3,nz=3"
            words[words.index("-two_mesh_set") + 1] = "x0=0,nx=4,ny=2,nz=2"
            words[words.index("-joint_secondary") + 1] = secondary
            words[words.index("-joint_primary") + 1] = primary
            total.append(History(self, words, 2).summary["impacts"]["total_impulse"])
        self.assertGreater(total[0], 0)
        self.assertAlmostEqual(total[1] / total[0], 1, delta=0.01)


if __name__ == "__main__":
    unittest.main()
