"""Masses on springs and dashpots: frequencies, decay and histories in closed form.

One mass on a grounded spring with a dashpot beside it; two masses on a grounded spring and a
spring between them; a mass with rotary inertia on a rotational spring; a beam on a rotational
spring with a mass at its top. References: closed forms of the oscillators, and of the scheme,
whose dashpot sees the mean of the velocities before and after, with x = c dt/(2 m):
(1 + x) z^2 - (2 - omega^2 dt^2) z + (1 - x) = 0.
"""
import math
import unittest

import numpy

import program
from decks import clock, material, probes, section
from recorded import Recorded

SPEED = 0.5


def chain(time_step, end_time, *more):
    return ["-structures", "chain", "-chain_mesh", "tests/meshes/chain.geo", "-chain_initial_velocity", f"{SPEED},0,0",
            *clock(repr(time_step), repr(end_time), repr(time_step / 2)), "-energy_interval", 1,
            *probes(one="chain@1,0,0", two="chain@2,0,0"), *more]


def point(group, mass):
    return [f"-chain_{group}_element", "point_mass", f"-chain_{group}_mass", mass]


def spring(group, element, stiffness, dashpot="0,0,0,0,0,0"):
    return [f"-chain_{group}_element", element, f"-chain_{group}_stiffness", stiffness,
            f"-chain_{group}_dashpot", dashpot]


def frequencies(test, arguments, count, ranks=program.RANKS):
    """The lowest natural frequencies, with their directions."""
    _, summary = program.must_run(test, list(arguments) + ["-modes", count], ranks)
    modes = next(iter(summary["structures"].values()))["frequencies"]
    return [(mode["frequency"], mode["direction"]) for mode in modes]


ON_RANKS = {"masses on springs and dashpots": chain(1e-4, 1.4, *point("first", 50.0), *point("second", 1.0), *spring(
    "support", "grounded_spring", "1e4,2e4,3e4", "90,0,0,0,0,0"))}


class DampedMass(unittest.TestCase):
    MASS, OMEGA, RATIO = 50.0, 2 * math.pi * 3, 0.05

    def release(self, element, group, ranks, *more):
        stiffness = self.MASS * self.OMEGA**2
        dashpot = 2 * self.RATIO * self.MASS * self.OMEGA
        time_step = 1e-4
        words = chain(time_step, 1.4, *point("first", self.MASS), *point("second", 1.0),
                      *spring(group, element, f"{stiffness!r},{2 * stiffness!r},{3 * stiffness!r}",
                              f"{dashpot!r},0,0,0,0,0"), *more)
        run = Recorded(self, words, ranks)
        x = dashpot * time_step / (2 * self.MASS)
        roots = numpy.roots([1 + x, -(2 - (self.OMEGA * time_step)**2), 1 - x])
        start = SPEED * (1 - x / 2) / (1 + x / 2)  # half a step
        steps = numpy.arange(len(run.time))
        scheme = start * time_step * ((roots[0]**steps - roots[1]**steps) / (roots[0] - roots[1])).real
        return run, run.displacement("one.x"), scheme

    def check(self, element, group, ranks, *more):
        run, u, scheme = self.release(element, group, ranks, *more)
        self.assertLess(abs(u - scheme).max(), 1e-9 * abs(u).max())
        damped = self.OMEGA * math.sqrt(1 - self.RATIO**2)
        exact = SPEED / damped * numpy.exp(-self.RATIO * self.OMEGA * run.time) * \
            numpy.sin(damped * run.time)
        self.assertLess(abs(u - exact).max(), 1e-3 * abs(u).max())
        inside = u[1:-1]
        peaks = inside[(inside > u[:-2]) & (inside > u[2:]) & (inside > 0)]
        decrement = math.log(peaks[0] / peaks[3]) / 3
        self.assertAlmostEqual(
            decrement / (2 * math.pi * self.RATIO / math.sqrt(1 - self.RATIO**2)), 1, delta=2e-3)
        self.assertGreater(run.energy["devices"], 0)
        # The other point flies on: nothing holds it.
        self.assertAlmostEqual(run.velocity("two.x")[-1], SPEED, delta=1e-12)

    def test_grounded_spring_and_dashpot(self):
        for ranks in (1, 2):
            self.check("grounded_spring", "support", ranks)

    def test_spring_to_a_clamped_point(self):
        self.check("spring", "link1", 2, "-chain_clamp", "ground", "-chain_mesh_set", "links=1")

    def test_frequency_along_each_axis(self):
        stiffness = self.MASS * self.OMEGA**2
        words = chain(1e-4, 1e-3, *point("first", self.MASS), *point("second", 1.0),
                      *spring("support", "grounded_spring",
                              f"{stiffness!r},{4 * stiffness!r},{9 * stiffness!r}"))
        found = {direction: f for f, direction in frequencies(self, words, 6) if f > 1e-3}
        for direction, times in (("x", 1), ("y", 2), ("z", 3)):
            self.assertAlmostEqual(found[direction] / (times * self.OMEGA / (2 * math.pi)), 1,
                                   delta=1e-9)


class TwoMasses(unittest.TestCase):
    def test_history_is_the_sum_of_two_modes(self):
        mass, stiffness = numpy.array([50.0, 20.0]), (3e4, 1e4)
        time_step = 1e-4
        words = chain(time_step, 1.0, *point("first", mass[0]), *point("second", mass[1]),
                      *spring("support", "grounded_spring", f"{stiffness[0]},1e4,1e4"),
                      *spring("link2", "spring", f"{stiffness[1]},1e4,1e4"),
                      "-chain_mesh_set", "links=2")
        matrix = numpy.array([[sum(stiffness), -stiffness[1]], [-stiffness[1], stiffness[1]]])
        root = numpy.sqrt(mass)
        squares, modes = numpy.linalg.eigh(matrix / numpy.outer(root, root))
        found = sorted(f for f, direction in frequencies(self, words, 6) if direction == "x")
        for f, square in zip(found, squares):
            self.assertAlmostEqual(2 * math.pi * f / math.sqrt(square), 1, delta=1e-9)
        amount = modes.T @ (root * SPEED)
        for ranks in (1, 2, 3):
            run = Recorded(self, words, ranks)
            steps = numpy.arange(len(run.time))
            theta = 2 * numpy.arcsin(numpy.sqrt(squares) * time_step / 2)
            waves = time_step * numpy.sin(numpy.outer(steps, theta)) / numpy.sin(theta)
            exact = (waves * amount) @ modes.T / root
            for i, name in enumerate(("one", "two")):
                u = run.displacement(f"{name}.x")
                self.assertLess(abs(u - exact[:, i]).max(), 1e-9 * abs(u).max())


class Rotation(unittest.TestCase):
    def test_rotary_inertia_on_rotational_springs(self):
        words = chain(1e-4, 1e-3, "-chain_first_element", "point_mass", "-chain_first_mass", 10,
                      "-chain_first_rotary_inertia", "2,3,4", *point("second", 1.0),
                      *spring("support", "grounded_spring", "1e6,1e6,1e6,2000,12000,36000"))
        found = sorted(f for f, _ in frequencies(self, words, 9) if f > 1e-3)
        expected = [math.sqrt(k / i) / (2 * math.pi) for k, i in ((2e3, 2), (12e3, 3), (36e3, 4))]
        for f, exact in zip(found[:3], expected):
            self.assertAlmostEqual(f / exact, 1, delta=1e-9)

    def test_mast_that_rocks_on_its_base(self):
        height, mass, young, inertia = 2.0, 100.0, 2e11, 1e-6
        for rock in (1e4, 1e5, 1e6):
            words = ["-structures", "mast", "-mast_mesh", "tests/meshes/cantilever.geo",
                     "-mast_mesh_set", f"height={height},n=2", "-mast_stem_element", "beam",
                     "-mast_stem_material", "steel", "-mast_stem_section", "tube", *material("steel", young, 0.3, 1e-3),
                     *section("tube", 1e-2, inertia, inertia, inertia, "0,1,0"),
                     "-mast_base_element", "grounded_spring",
                     "-mast_base_stiffness", f"1e8,1e8,1e8,{rock!r},{2 * rock!r},1e6",
                     "-mast_top_element", "point_mass", "-mast_top_mass", mass, "-end_time", 1e-5]
            found = dict((direction, f) for f, direction in reversed(frequencies(self, words, 2)))
            for direction, about in (("x", 2 * rock), ("y", rock)):
                flexibility = 1e-8 + height**2 / about + height**3 / (3 * young * inertia)
                exact = math.sqrt(1 / (mass * flexibility)) / (2 * math.pi)
                self.assertAlmostEqual(found[direction] / exact, 1, delta=1e-5)


if __name__ == "__main__":
    unittest.main()
