"""Largest mean force over areas and edges of a face that is struck, beside d'Alembert's bar and every place of the window.

A bar of 1 m2 in sixteen cells across meets a wall at 10 m/s: 300 N on all of it, and 300 Pa over any part (bar_on_wall_test.py).
With a gap that is not alike over the face the force of each pair is another one; over the whole run its mean is the pair's impulse
over that time, and the largest sum over a window is looked for at places that are closer than the search needs.
"""
import os
import shutil
import unittest

import numpy

import program
from bar_on_wall_test import thrown
from decks import box_of, clock, contacts, material, probes



def block(sizes, poisson, gap, end):
    return ["-structures", "bar", *box_of("bar", sizes, "soft"), *material("soft", 900, poisson, 1), *contacts(stop=("bar:z_min", "wall", gap)),
            *clock(2e-3, end, 0.05), *probes(top="bar:z_max"), "-bar_initial_velocity", "0,0,-10"]


def tilted(*more, end=0.65):
    """A block that meets a wall with one corner before the others."""
    return [*block("lz=2,nz=8,lx=1,nx=4,ly=1.2,ny=3", 0.2, "0.5,0.6,0.8,0.55", end),
            "-struck_areas", "0.01,0.09,0.4,2", "-struck_edges", "0.1,0.7", *more]


ON_RANKS = {"a block that is struck at a corner": tilted()}


class Struck:
    """Tables of a run: what was found per window, in their order, and the pairs with their impulses."""

    def __init__(self, test, words, ranks=1):
        folder, self.summary = program.must_run(test, ["-modes", 1, "-spectra_frequencies", 10, "-csv_digits", 17, *words], ranks)
        with open(os.path.join(folder, "struck_areas.csv")) as file:
            self.text = file.read()
        self.found = self.numbers(folder, "struck_areas.csv")
        self.points = self.numbers(folder, "contact_points.csv")
        shutil.rmtree(folder)

    @staticmethod
    def numbers(folder, name):
        return {key: numpy.array(values, float) for key, values in program.read_csv(os.path.join(folder, name)).items() if key != "contact"}


def parts_of(values, all_values):
    """Lowest and highest of what each value stands for along an axis, among all of them."""
    line = numpy.unique(numpy.round(all_values, 9))
    edges = numpy.concatenate([line[:1], (line[1:] + line[:-1]) / 2, line[-1:]])
    at = numpy.searchsorted(line, numpy.round(values, 9))
    return edges[at], edges[at + 1]


def largest(points, length, height, every=0.004):
    """Largest sum of the pairs' impulses in a window, its parts by area, over places so far from each other at most."""
    inside = []
    for axis, side in (("x", length), ("y", height)):
        low, high = parts_of(points[axis], points[axis])
        starts = numpy.arange(low.min() - side, high.max() + every, every)[:, None]
        inside.append(numpy.clip(numpy.minimum(high, starts + side) - numpy.maximum(low, starts), 0, None) / (high - low))
    return ((inside[0] * points["impulse"]) @ inside[1].T).max()


class StruckAreas(unittest.TestCase):
    def test_pressure_of_a_bar(self):
        run = Struck(self, [*block("lz=10,nz=40,nx=4,ny=4", 0, 5.0, 1.3), "-struck_areas", "0.25,1", "-struck_edges", "0.5", "-force_window", 0.5])
        numpy.testing.assert_allclose(run.found["length"], [0.5, 1, 0.5])
        numpy.testing.assert_allclose(run.found["height"], [0.5, 1, 0])
        numpy.testing.assert_allclose(run.found["force"], [75, 300, 150], rtol=2e-3)
        numpy.testing.assert_allclose(run.found["force"] / run.found["force"][1], [0.25, 1, 0.5], rtol=1e-9)
        self.assertTrue(((run.found["time"] > 0.75) & (run.found["time"] < 0.92)).all(), run.found["time"])
        for axis, middle in (("x", 0.5), ("y", 0.5)):
            self.assertAlmostEqual(run.found[axis][1], middle)
        self.assertFalse([line for line in run.summary["warnings"] if "one pair presses" in line])

    def test_windows_lie_anywhere(self):
        """The mean over the whole run is that of the pairs' impulses, in the place where it is largest."""
        end = 0.65
        run = Struck(self, tilted("-force_window", 100))
        steps = round(end / 2e-3) + 1
        duration = 4 * round(steps / 4) * 2e-3
        self.assertGreater(numpy.ptp(run.points["impulse"]), 0.2 * run.points["impulse"].max())
        for k, (length, height) in enumerate(zip(run.found["length"], run.found["height"])):
            expected = largest(run.points, length, height or 2.0) / duration
            self.assertLessEqual(expected, run.found["force"][k] * (1 + 1e-9))
            self.assertLess(run.found["force"][k] / expected, 1.015, (length, height))
        low, high = (parts_of(run.points[axis], run.points[axis]) for axis in "xy")
        densest = (run.points["impulse"] / ((low[1] - low[0]) * (high[1] - high[0]))).max() / duration
        self.assertLess(abs(run.found["force"][0] / 0.01 / densest - 1), 1e-9)  # within the part of one pair
        self.assertAlmostEqual(run.found["force"][3] / (run.points["impulse"].sum() / duration), 1, delta=1e-9)

    def test_a_shorter_time_presses_more(self):
        forces = [Struck(self, tilted("-force_window", window)).found["force"] for window in (0.2, 0.05, 0.01)]
        for longer, shorter in zip(forces, forces[1:]):
            self.assertTrue((shorter > longer * (1 + 1e-3)).all(), (longer, shorter))

    def test_ranks(self):
        one, *others = (Struck(self, tilted("-force_window", 0.04), ranks) for ranks in (1, 2, 3))
        for other in others:
            for name, values in one.found.items():
                numpy.testing.assert_allclose(other.found[name], values, rtol=1e-8, err_msg=name)
        self.assertEqual(Struck(self, tilted("-force_window", 0.04)).text, one.text)

    def test_continued_to_the_bit(self):
        words = ["-modes", 1, "-spectra_frequencies", 10, "-csv_digits", 17, *tilted("-force_window", 0.04)]
        folder, _ = program.must_run(self, words, 1)
        self.addCleanup(shutil.rmtree, folder)
        cut = os.path.join(folder, "cut")
        for more in (["-end_time", 0.15, "-checkpoint_steps", 37], ["-restart", os.path.join(cut, "checkpoint.h5")]):
            program.must_end(self, [*words, *more, "-output", cut], 1)
        texts = []
        for place in (folder, cut):
            with open(os.path.join(place, "struck_areas.csv")) as file:
                texts.append(file.read())
        self.assertEqual(*texts)

    def test_areas_that_the_mesh_does_not_tell(self):
        run = Struck(self, tilted())
        self.assertEqual(len([line for line in run.summary["warnings"] if "one pair presses" in line]), 2)
        for words in ("contact stop, struck_areas in m2: one pair presses up to 0.1 of its face, more than 0.01",
                      "contact stop, struck_edges in m: one pair presses up to 0.25 of its face, more than 0.1"):
            self.assertTrue(any(words in line for line in run.summary["warnings"]), run.summary["warnings"])

    def test_mistakes(self):
        for option, value in (("struck_areas", "-1"), ("struck_areas", "1,nan"), ("struck_edges", "one")):
            with self.subTest((option, value)):
                program.must_refuse(self, [*thrown(10, 0.5), f"-{option}", value, "-output", "unused"], f"-{option}", ranks=1)


if __name__ == "__main__":
    unittest.main()
