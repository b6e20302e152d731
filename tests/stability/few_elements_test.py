"""Models of one element, and more ranks than elements: some ranks then own nothing at all.

One free element of each kind: its largest frequency in closed form. Two bricks that collide, four
elements in all: contact nodes sit on different ranks, or on ranks without an element. Whatever the
number of ranks, the run ends, and with the results of one.
"""
import unittest

from history import History, scenes
from houses import Pair, Run, assert_same

RANKS = (2, 3, 5, 8)


class OneElement(unittest.TestCase):
    def test_each_kind_on_one_to_eight_ranks(self):
        names = list(scenes.ELEMENTS)
        reference = History(self, scenes.lone_elements(names))
        for name, omega in scenes.lone_frequencies().items():
            structure = reference.summary["structures"][name]
            self.assertEqual(structure["elements"], 1)
            self.assertAlmostEqual(structure["omega_max"] / omega, 1, delta=1e-9, msg=name)
            self.assertAlmostEqual(structure["element_frequency_bound"] / omega, 1, delta=1e-9, msg=name)
        scales = {name: abs(reference.data[name]).max() for name in ("displacement", "velocity")}
        # Thrown bodies have no acceleration but of round-off.
        scales["acceleration"] = scales["velocity"] * max(scenes.lone_frequencies().values())
        for ranks in RANKS:
            run = History(self, scenes.lone_elements(names), ranks)
            self.assertEqual(run.summary["time_step"], reference.summary["time_step"])
            for name, scale in scales.items():
                self.assertGreater(scale, 0)
                self.assertLessEqual(abs(run.data[name] - reference.data[name]).max(), 1e-12 * scale, (name, ranks))

    def test_alone_on_eight_ranks(self):
        for name in ("brick", "rod"):
            one, eight = (History(self, scenes.lone_elements([name]), ranks) for ranks in (1, 8))
            self.assertLessEqual(abs(eight.data["displacement"] - one.data["displacement"]).max(),
                                 1e-12 * abs(one.data["displacement"]).max())


class MoreRanksThanElements(unittest.TestCase):
    def collide(self, ranks):
        words = scenes.blocks((2.0, 3.0), young=1e6, time_step=1e-4, end_time=0.02)
        words[words.index("-one_mesh_set") + 1] = "x0=-1,nz=2"
        words[words.index("-two_mesh_set") + 1] = "x0=0,nz=2"
        return History(self, words, ranks)

    def test_collision(self):
        reference = self.collide(1)
        self.assertEqual(reference.summary["impacts"]["episodes"], 1)
        for ranks in RANKS:
            run = self.collide(ranks)
            for name, values in reference.data.items():
                if values.dtype.kind == "f":
                    self.assertLessEqual(abs(run.data[name] - values).max(), 1e-12 * abs(values).max(), (name, ranks))
            self.assertAlmostEqual(run.summary["impacts"]["total_impulse"],
                                   reference.summary["impacts"]["total_impulse"], delta=1e-12)
            self.assertLess(run.energy["relative_residual"], 1e-12)

    def test_houses_on_eight_ranks(self):
        reference = Run(self, Pair(), end_time=0.02)
        for ranks in (4, 8):
            assert_same(self, Run(self, Pair(), ranks, end_time=0.02), reference, 1e-11)


if __name__ == "__main__":
    unittest.main()
