"""Masses on springs that yield by laws with corners: published answers, and integrations of our own from corner to corner.

SDND105A and SDND124A are problems of Code_Aster's collection: a stop that is crushed, in closed form, and a spring that
hardens isotropically beside an elastic one on a moving base. The oscillator on a peak-oriented spring is integrated
here in closed form between the instants at which its force turns a corner.
"""
import math
import os
import tempfile
import unittest

import numpy
from scipy.optimize import brentq

import program
from loops_test import Loops, check_area
from nonlinear_springs_test import mass, spring
from recorded import Recorded, assert_continues


def pairs(corners):
    return ",".join(f"{e!r},{f!r}" for e, f in corners)


class CrushedStop(unittest.TestCase):
    """Stop of 1 N/m that drops to a plateau of half its peak, unloads with .5 N/m and lets the mass go."""

    def run_(self, time_step, ranks=program.RANKS):
        return Recorded(self, mass(time_step, 11, "-output_interval", 1e-3, "-chain_first_mass", 1, "-chain_initial_velocity", "2,0,0",
                                   *spring("1,0,0", rule="peak", skeleton="1,1,1.00001,0.5", skeleton_back=0,
                                           unloading_exponent=1, unloading_least=0.5)), ranks)

    def test_crushes_and_lets_go(self):
        run = self.run_(1e-4)
        x = run.displacement("one.x")
        self.assertAlmostEqual(x.max(), 4, delta=1e-4)
        last = numpy.flatnonzero((x[:-1] > 0) & (x[1:] <= 0))[-1]
        back = run.time[last] + 1e-3 * x[last] / (x[last] - x[last + 1])
        self.assertAlmostEqual(back / (math.pi / 6 + 2 * math.sqrt(3) + (math.pi + 6) / math.sqrt(2)), 1, delta=2e-5)
        self.assertAlmostEqual(run.velocity("one.x")[last], -math.sqrt(0.5), delta=2e-5)
        self.assertAlmostEqual(run.energy["plastic"], 2 - 0.25, delta=5e-5)


class IsotropicSpring(unittest.TestCase):
    """SDND124A: 200 kg on 400 N/m that hardens from 200 to 450 N beside 400 N/m that do not."""
    STRENGTHS = 200.0, 450.0

    def curve(self):
        first, last = self.STRENGTHS
        q = numpy.concatenate([[0], numpy.geomspace(1e-3, 20, 300)])
        force = first + 400 * q / (1 + (400 * q / (last - first))**1.5)**(2 / 3)
        return list(zip((q + first / 400).tolist(), force.tolist()))

    def test_published_row(self):
        step = 1e-3
        with tempfile.TemporaryDirectory() as folder:
            record = os.path.join(folder, "base.txt")
            with open(record, "w") as file:
                for i in range(3001):
                    file.write(f"{i * step:.6f} {-6 * math.sin(math.pi * i * step):.15g}\n")
            words = mass(step, 2, "-chain_first_mass", 200, "-chain_clamp", "ground,second", "-chain_link1_element", "bar",
                         "-chain_link1_material", "light", "-chain_link1_area", 1, "-material_light_young", 400,
                         "-material_light_poisson", 0.3, "-material_light_density", 1e-9,
                         *spring("400,0,0", rule="isotropic", skeleton=pairs(self.curve())), "-motion_x_record", record,
                         "-motion_x_unit", "m/s2", "-loops", "chain:support", links=1)
            run = Loops(self, words, 1)
        at = round(1.275 / step)
        self.assertAlmostEqual(run.elongation[at, 0], 1.76980, delta=2.3e-3 * 2)
        self.assertAlmostEqual(run.force[at, 0], 405.187, delta=2.3e-3 * 450)
        self.assertAlmostEqual(run.elongation[at, 0] - run.force[at, 0] / 400, 0.756833, delta=2.3e-3)


class Exact:
    """Unit mass on a spring whose force goes straight from corner to corner, under an acceleration that goes straight
    from sample to sample. Peak-oriented, alike in both directions: the way ahead is a list of corners, of which a turn
    makes a new one."""

    def __init__(self, corners, mass_):
        self.corners, self.mass = corners, mass_
        self.stiffness = corners[0][1] / corners[0][0]
        self.far = {1: corners[0], -1: tuple(-c for c in corners[0])}
        self.x, self.v, self.f, self.turns = 0.0, 0.0, 0.0, 0

    def skeleton(self, side):
        """Corners beyond the farthest point of a side."""
        far = side * self.far[side][0]
        return [(side * e, side * f) for e, f in self.corners if e > far] + [(side * 1e9, side * self.corners[-1][1])]

    def turn(self, side):
        """The way ahead in the direction `side` after a turn here."""
        if self.f * side >= 0:  # still below the way up that it left: not reached in these motions
            return [self.far[side], *self.skeleton(side)]
        return [(self.x - self.f / self.stiffness, 0.0), self.far[side], *self.skeleton(side)]

    def run(self, ground, step, end):
        """Displacement at multiples of `step` [s]."""
        found, time, count = [0.0], 0.0, round(end / step)
        ahead = self.turn(1 if ground[1] < 0 else -1)
        direction = 1 if ground[1] < 0 else -1
        for i in range(count):
            slope = (ground[i + 1] - ground[i]) / step
            left, start = step, 0.0
            while left > 1e-13:
                (e, f), a0 = ahead[0], ground[i] + slope * start
                k = (f - self.f) / (e - self.x)
                move = self.motion(k, a0, slope)
                corner = self.first(lambda s: direction * (move(s)[0] - e), left)
                stop = self.first(lambda s: -direction * move(s)[1], left, skip=abs(self.v) < 1e-12)
                s = min(corner, stop, left)
                x, self.v = move(s)
                self.f, self.x = self.f + k * (x - self.x), x
                start, left = start + s, left - s
                side = 1 if self.f > 0 else -1
                if side * self.x >= side * self.far[side][0]:
                    self.far[side] = (self.x, self.f)
                if s == corner:
                    self.x, self.f = e, f
                    ahead.pop(0)
                elif s == stop:
                    self.v, direction, self.turns = 0.0, -direction, self.turns + 1
                    ahead = self.turn(direction)
            time += step
            found.append(self.x)
        return numpy.array(found)

    def motion(self, k, a0, slope):
        """Displacement and velocity after s, with m x'' = -f - k (x - x0) - m (a0 + slope s)."""
        m, x0, v0 = self.mass, self.x, self.v
        p0, p1 = -self.f / m - a0, -slope
        if k < 1e-12:
            return lambda s: (x0 + v0 * s + p0 * s**2 / 2 + p1 * s**3 / 6, v0 + p0 * s + p1 * s**2 / 2)
        w = math.sqrt(k / m)
        a, b = -p0 / w**2, (v0 - p1 / w**2) / w
        return lambda s: (x0 + a * math.cos(w * s) + b * math.sin(w * s) + (p0 + p1 * s) / w**2,
                          -a * w * math.sin(w * s) + b * w * math.cos(w * s) + p1 / w**2)

    @staticmethod
    def first(value, end, skip=False):
        """First zero of a function that is negative before, up to `end`; infinite without one."""
        times = numpy.linspace(0, end, 9)
        for s0, s1 in zip(times[1 if skip else 0:], times[2 if skip else 1:]):
            if value(s1) >= 0 and value(s1) > value(s0):
                return s1 if value(s0) >= 0 else brentq(value, s0, s1, xtol=1e-15)
        return math.inf


class PeakOriented(unittest.TestCase):
    """50 kg on 2e5 N/m, corners at 5 and 15 mm, shaken by a wave packet with dips and rises."""
    CORNERS, SAMPLE, END = [(0.005, 1000.0), (0.015, 1800.0)], 0.01, 1.2

    def ground(self):
        time = numpy.arange(0, self.END + self.SAMPLE / 2, self.SAMPLE)
        return 45 * numpy.sin(2 * math.pi * 6 * time) * numpy.sin(math.pi * time / self.END)**2

    def words(self, time_step, record, *more):
        return mass(time_step, self.END, *spring("2e5,0,0", rule="peak", skeleton=pairs(self.CORNERS)),
                    "-motion_x_record", record, "-motion_x_unit", "m/s2", "-chain_clamp", "second", *more)

    def test_events(self):
        ground = self.ground()
        record = program.write_samples(ground, self.SAMPLE)
        self.addCleanup(os.remove, record)
        exact = Exact(self.CORNERS, 50.0)
        reference = exact.run(ground, self.SAMPLE, self.END)
        self.assertGreater(exact.turns, 8)
        self.assertGreater(abs(reference).max(), 0.02)
        errors = []
        for step, ranks in ((1e-4, 1), (2.5e-5, 2)):
            x = Recorded(self, self.words(step, record), ranks).displacement("one.x")
            errors.append(abs(x[::round(self.SAMPLE / step)] - reference).max() / abs(reference).max())
        self.assertLess(errors[1], errors[0] / 8, errors)
        self.assertLess(errors[1], 1e-6)

    def test_loops_continued_and_reduced(self):
        record = program.write_samples(self.ground(), self.SAMPLE)
        self.addCleanup(os.remove, record)
        words = self.words(4e-4, record, "-loops", "chain:support", "-energy_interval", 1, "-end_time", 0.6)
        run = Loops(self, words)
        check_area(self, run, 1e-11)
        self.assertGreater(run.energy["plastic_loss"][-1], 10)
        modes = Loops(self, [*words, "-chain_model", "modal", "-chain_modal_vectors", 6])
        self.assertLess(abs(modes.elongation - run.elongation).max(), 1e-10)
        assert_continues(self, [*words, "-modes", 1, "-spectra_frequencies", 10], 0.4, 500)


class Brace(unittest.TestCase):
    """A bar of 4 m that yields at 400 kN when it is stretched and buckles at 150 kN when it is pressed."""
    LENGTH, STRENGTH, AREA, YOUNG = 4.0, 4e5, 1e-3, 2e11

    def words(self, speed, *more):
        first = self.STRENGTH / (self.YOUNG * self.AREA)
        back = 1.5e5 / (self.YOUNG * self.AREA)
        return ["-structures", "one", "-one_mesh", "tests/meshes/line.geo", "-one_mesh_set", f"length={self.LENGTH},n=1",
                "-one_clamp", "x_min,x_max:y+z", "-one_line_element", "bar", "-one_line_material", "steel",
                "-one_line_area", self.AREA, "-material_steel_young", self.YOUNG, "-material_steel_poisson", 0.3,
                "-material_steel_density", 1e-3, "-one_x_max_element", "point_mass", "-one_x_max_mass", 1e4,
                "-one_line_rule", "peak", "-one_line_skeleton", pairs([(first, self.STRENGTH)]),
                "-one_line_skeleton_back", pairs([(back, 1.5e5), (5 * back, 5e4)]), "-one_initial_velocity",
                f"{speed},0,0", "-time_step", 1e-5, "-end_time", 0.2, "-output_interval", 1e-5, "-energy_interval", 10,
                "-probes", "tip", "-tip_structure", "one", "-tip_at", f"{self.LENGTH},0,0", *more]

    def test_stretched_and_pressed(self):
        stiffness = self.YOUNG * self.AREA / self.LENGTH
        for speed, ranks in ((1.0, 1), (-0.7, 2)):
            run = Recorded(self, self.words(speed), ranks)
            x = run.displacement("tip.x")
            energy = 1e4 * speed**2 / 2
            if speed > 0:
                top = self.STRENGTH / stiffness + (energy - self.STRENGTH**2 / stiffness / 2) / self.STRENGTH
                self.assertAlmostEqual(x.max() / top, 1, delta=1e-5)
            else:  # over the peak, down to the plateau of 50 kN, and on
                peak = 1.5e5 / stiffness
                left = energy - 1.5e5 * peak / 2 - (1.5e5 + 5e4) / 2 * 4 * peak
                self.assertGreater(left, 0)
                top = 5 * peak + left / 5e4
                self.assertAlmostEqual(-x.min() / top, 1, delta=1e-5)
            found = run.summary["yielding"]["one:line:axial"]
            self.assertEqual((found["elements"], found["yielded"]), (1, 1))
            self.assertAlmostEqual(found["energy_lost"] / run.energy["plastic"], 1, delta=1e-5)

    def test_in_modes(self):
        full = Recorded(self, self.words(1.0), 1)
        modes = Recorded(self, self.words(1.0, "-one_model", "modal", "-one_modal_vectors", 2), 1)
        self.assertLess(abs(full.displacement("tip.x") - modes.displacement("tip.x")).max(), 1e-10)
        for name, value in full.summary["yielding"]["one:line:axial"].items():
            numpy.testing.assert_allclose(modes.summary["yielding"]["one:line:axial"][name], value, rtol=1e-9, err_msg=name)


class Refusals(unittest.TestCase):
    def test_laws_that_cannot_be(self):
        for options, said in (
                ({"skeleton": "0.01,1000"}, "not on the line of the stiffness"),
                ({"skeleton": "0.005,1000,0.004,1100"}, "elongations must increase"),
                ({"skeleton": "0.005,1000,0.01,2001"}, "lies above the line"),
                ({"skeleton": "0.005,1000,0.01"}, "an elongation without its force"),
                ({"skeleton": "0.005,1000,0.01,900"}, "none below 0"),
                ({"skeleton": "0.005,1000", "skeleton_back": 0}, "the same slopes in both directions"),
                ({"skeleton": "0.005,1000", "skeleton_back": 0, "rule": "straight"}, "origin, peak or pinching"),
                ({"skeleton": "0.005,1000", "yield_force": "3,0,0"}, "not beside"),
                ({"skeleton": "0.005,1000", "rule": "peak", "pinch": "0.2,0.5"}, "goes with"),
                ({"skeleton": "0.005,1000", "rule": "pinching", "pinch": "0.7,0.5"}, "must not exceed"),
                ({"skeleton": "0.005,1000", "deterioration": 3}, "goes with"),
                ({"rule": "isotropic"}, "nothing yields"),
                ({"skeleton": "0.005,1000", "rule": "peaked"}, "did you mean peak")):
            program.must_refuse(self, mass(1e-4, 0.01, *spring("2e5,0,0", **options)), said, ranks=1)
        program.must_refuse(self, mass(1e-4, 0.01, *spring("2e5,2e5,0", skeleton="0.005,1000")), "one axis only")

    def test_not_in_modes_with_uniform_damping(self):
        """A skeleton is refused as a yield force is: those modes would damp what yields."""
        for option, value in (("skeleton", "0.005,1000,0.01,1500"), ("yield_force", "1000,0,0")):
            words = mass(1e-4, 0.01, *spring("2e5,0,0", **{option: value}), "-chain_model", "modal", "-chain_modal_vectors", 2,
                         "-chain_damping_uniform", 0.05)
            program.must_refuse(self, words, f"-chain_support_{option}", "-chain_damping_uniform", "damp slack and yielding elements")

    def test_rest_on_what_carries_nothing(self):
        words = mass(1e-4, 0.01, *spring("0,0,2e5", skeleton="0.005,1000", rule="peak", skeleton_back=0), "-gravity",
                     9.81, "-preload", "static", "-chain_clamp", "second,first:x+y")
        program.must_refuse(self, words, "yielding elements carry less")


if __name__ == "__main__":
    unittest.main()
