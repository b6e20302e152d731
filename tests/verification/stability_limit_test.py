"""The stable time step of structures whose damping differs from region to region.

The scheme is stable if and only if 4 M - 2 dt C - dt^2 K is positive definite, with all damping in C
but dashpots, which act at mid-step and limit nothing however strong they are (for one degree of freedom: Ambiel et al., Eng. Struct. 251 (2022) 113385, Eq. 12). References: closed
forms of one degree of freedom, and dense generalized eigenvalues of bars with lumped mass. A bar has
no stiffness across its axis, where the mass term of the damping alone limits the step: dt < 2 / alpha.
"""
import math
import os
import tempfile
import unittest

import numpy
import scipy.linalg

import program
from decks import clock, material, probes
from recorded import Recorded

YOUNG, DENSITY = 2e11, 7800.0
AREAS = {"left": 0.01, "right": 0.02}
TOLERANCE = 1e-9


def critical(rate, square):
    """Positive root of 4 - 2 dt rate - dt^2 square = 0."""
    return 4 / (rate + math.sqrt(rate**2 + 4 * square))


class Bar:
    """Two bars in line along x, left and right, fixed at the ends that are named."""

    def __init__(self, lengths, elements, clamp, damping, regions=None, dashpot=0.0):
        self.damping = {name: (regions or {}).get(name, damping) for name in AREAS}
        self.words = ["-structures", "bar", "-bar_mesh", "tests/meshes/halves.geo",
                      "-bar_mesh_set", f"length_1={lengths[0]},length_2={lengths[1]},n1={elements[0]},n2={elements[1]}",
                      "-bar_clamp", clamp, *material("steel", YOUNG, 0.3, DENSITY), "-bar_damping_alpha", damping[0],
                      "-bar_damping_beta", damping[1]]
        for name, area in AREAS.items():
            self.words += [f"-bar_{name}_element", "bar", f"-bar_{name}_material", "steel",
                           f"-bar_{name}_area", area]
        for name, (alpha, beta) in (regions or {}).items():
            self.words += [f"-bar_{name}_damping_alpha", alpha, f"-bar_{name}_damping_beta", beta]
        if dashpot:
            self.words += ["-bar_joint_element", "grounded_spring", "-bar_joint_stiffness", "0,0,0",
                           "-bar_joint_dashpot", f"{dashpot!r},0,0"]
        self.assemble(lengths, elements, clamp, dashpot)

    def assemble(self, lengths, elements, clamp, dashpot):
        """Dense matrices of the motion along the bar, largest rate of the motion across it."""
        nodes = sum(elements) + 1
        mass, across = numpy.zeros((2, nodes))
        stiffness, damping = numpy.zeros((2, nodes, nodes))
        self.element_bound, first = math.inf, 0
        for name, length, count in zip(AREAS, lengths, elements):
            h, (alpha, beta) = length / count, self.damping[name]
            k = YOUNG * AREAS[name] / h * numpy.array([[1, -1], [-1, 1]])
            m = DENSITY * AREAS[name] * h / 2
            square = 4 * YOUNG / DENSITY / h**2
            self.element_bound = min(self.element_bound, critical(alpha + beta * square, square))
            for e in range(first, first + count):
                mass[e:e + 2] += m
                across[e:e + 2] += alpha * m
                stiffness[e:e + 2, e:e + 2] += k
                damping[e:e + 2, e:e + 2] += alpha * m * numpy.eye(2) + beta * k
            first += count
        self.dashpot = numpy.zeros(nodes)
        self.dashpot[elements[0]] = dashpot
        free = numpy.arange(nodes)
        free = free[(1 if "x_min" in clamp else 0):(nodes - 1 if "x_max" in clamp else nodes)]
        self.mass, self.across = mass[free], max(across[free] / mass[free])
        self.dashpot = self.dashpot[free]
        self.stiffness, self.damping_matrix = stiffness[numpy.ix_(free, free)], damping[numpy.ix_(free, free)]

    def limit(self):
        """dt at which the pencil is singular: with w = 1 / dt, (4 w^2 M - 2 w C - K) x = 0, linearised."""
        n = len(self.mass)
        zero, one = numpy.zeros((n, n)), numpy.eye(n)
        root = numpy.sqrt(numpy.outer(self.mass, self.mass))
        companion = numpy.block([[zero, one], [self.stiffness / root / 4, self.damping_matrix / root / 2]])
        # Balanced by the frequency, so that no digits are lost.
        scale = math.sqrt(numpy.linalg.eigvalsh(self.stiffness / root)[-1])
        companion[:n, n:] *= scale
        companion[n:, :n] /= scale
        along = 1 / scipy.linalg.eigvals(companion).real.max()
        return min(along, 2 / self.across) if self.across > 0 else along

    def undamped(self):
        return 2 / math.sqrt(scipy.linalg.eigvalsh(self.stiffness, numpy.diag(self.mass))[-1])


# Damping of the structure, of its regions; alpha [1/s], beta [s].
DAMPINGS = [((0, 2e-6), {"right": (0, 3e-5)}), ((0, 3e-5), {"right": (0, 0)}),
            ((0, 3e-5), {"left": (0, 1e-6)}),
            ((50, 1e-6), {"left": (900, 4e-5), "right": (0, 2e-5)}), ((0, 0), {"left": (3e5, 0)})]


class StableTimeStep(unittest.TestCase):
    def summary(self, bar, ranks=program.RANKS):
        words = bar.words + ["-time_step", 1e-12, "-end_time", 1e-12, "-modes", 0]
        return program.must_run(self, words, ranks)[1]["structures"]["bar"]

    def check(self, bar, expected, ranks=program.RANKS):
        found = self.summary(bar, ranks)
        self.assertAlmostEqual(found["stable_time_step"] / expected, 1, delta=TOLERANCE)
        bound = found["element_time_step_bound"]
        self.assertLessEqual(bound, found["stable_time_step"] * (1 + TOLERANCE))
        self.assertLessEqual(found["stable_time_step"], found["stable_time_step_undamped"] * (1 + TOLERANCE))
        self.assertAlmostEqual(found["stable_time_step_undamped"] / bar.undamped(), 1, delta=TOLERANCE)
        return bound

    def test_one_node_between_two_regions(self):
        """Both bars act on one mass: C = beta_left k_left + beta_right k_right, whatever the dashpot."""
        for dashpot in (0.0, 4e6):
            for betas in ((1e-5, 4e-4), (3e-4, 0.0)):
                bar = Bar((1.5, 1), (1, 1), "x_min,x_max", (0, 7e-5),
                          {"left": (0, betas[0]), "right": (0, betas[1])}, dashpot)
                k = (YOUNG * AREAS["left"] / 1.5, YOUNG * AREAS["right"] / 1)
                mass = DENSITY * (AREAS["left"] * 1.5 + AREAS["right"]) / 2
                rate = (betas[0] * k[0] + betas[1] * k[1]) / mass
                self.check(bar, critical(rate, sum(k) / mass))

    def test_bars_of_two_regions(self):
        for damping, regions in DAMPINGS:
            for clamp in ("x_min", "x_min,x_max"):
                bar = Bar((3, 2), (6, 9), clamp, damping, regions)
                bound = self.check(bar, bar.limit())
                self.assertAlmostEqual(bound / bar.element_bound, 1, delta=1e-6)

    def test_bar_with_a_dashpot(self):
        for dashpot in (1e4, 3e6, 1e9):
            bar = Bar((3, 2), (6, 9), "x_min", (0, 2e-6), dashpot=dashpot)
            bound = self.check(bar, bar.limit())
            self.assertGreater(bound, 0.5 * bar.limit())

    def test_same_on_every_number_of_ranks(self):
        bar = Bar((3, 2), (6, 9), "x_min", *DAMPINGS[3], dashpot=1e6)
        for ranks in (1, 2, 3):
            self.check(bar, bar.limit(), ranks)

    def test_damping_ratio_of_a_region(self):
        bar = Bar((3, 2), (6, 9), "x_min", (0, 2e-6))
        w = 2 * math.pi * 10, 2 * math.pi * 400
        regions = {"right": (2 * 0.05 * w[0] * w[1] / (w[0] + w[1]), 2 * 0.05 / (w[0] + w[1]))}
        expected = Bar((3, 2), (6, 9), "x_min", (0, 2e-6), regions).limit()
        bar.words += ["-bar_right_damping_ratio", 0.05, "-bar_right_damping_frequencies", "10,400"]
        self.check(bar, expected)


class History(unittest.TestCase):
    """The run is the scheme with these matrices: v += -dt M^-1 (C v + K u), u += dt v, half a step first.

    A dashpot acts on the mean of the velocities before and after.
    """

    def test_bars_of_two_regions(self):
        dashpots = (0, 3e4, 0, 0, 0)
        for (damping, regions), dashpot in zip(DAMPINGS, dashpots):
            bar = Bar((3, 2), (6, 9), "x_min", damping, regions, dashpot)
            time_step, steps = 0.8 * bar.limit(), 300
            run = Recorded(self, bar.words + [*clock(repr(time_step), repr(steps * time_step), repr(time_step / 2)),
                                              "-energy_interval", 1, "-bar_initial_velocity", "1,0,0",
                                              *probes(joint="bar@3,0,0", tip="bar@5,0,0")])
            u, v = numpy.zeros((2, len(bar.mass)))
            v += 1
            found = numpy.column_stack([run.displacement("joint.x"), run.displacement("tip.x")])
            self.assertGreaterEqual(len(found), steps)
            expected = numpy.zeros_like(found)
            for n in range(len(found)):
                expected[n] = u[5], u[-1]
                duration = time_step if n > 0 else time_step / 2
                force = bar.damping_matrix @ v + bar.stiffness @ u
                half = duration / 2 * bar.dashpot
                v = ((bar.mass - half) * v - duration * force) / (bar.mass + half)
                u = u + time_step * v
            self.assertLess(abs(found - expected).max(), 1e-10 * abs(expected).max())
            self.assertLess(run.energy["relative_residual"], 1e-12)


class Growth(unittest.TestCase):
    """A blow of the whole bar dies out just below the limit and grows just above."""

    STEPS = 20000

    def run_at(self, bar, fraction, *more):
        """Energies of the run at a fraction of the limit, and what the program says if it stops."""
        time_step = fraction * bar.limit()
        with tempfile.TemporaryDirectory() as folder:
            result = program.run(bar.words + [
                "-time_step", repr(time_step), "-end_time", repr(self.STEPS * time_step), "-modes", 0,
                "-bar_initial_velocity", "1,0,0", "-energy_interval", 10, "-output", folder, *more], 1)
            energies = []
            if result.returncode == 0:
                columns = program.read_csv(os.path.join(folder, "energy.csv"))
                energies = [float(a) + float(b) for a, b in zip(columns["kinetic"], columns["strain"])]
        return energies, program.error_lines(result)

    def check(self, bar):
        energies, errors = self.run_at(bar, 0.999)
        self.assertEqual(errors, [])
        self.assertGreater(len(energies), self.STEPS / 20)
        self.assertLess(max(energies), 1.01 * energies[0])
        self.assertLess(energies[-1], 0.5 * energies[0])
        energies, errors = self.run_at(bar, 1.001)
        self.assertEqual(len(errors), 1)
        self.assertIn("stable time step", errors[0])
        energies, errors = self.run_at(bar, 1.001, "-allow_unstable")
        if errors:
            self.assertIn("diverged", errors[0])
        else:
            self.assertGreater(max(abs(energy) for energy in energies), 1e6 * energies[0])

    def test_two_regions(self):
        for damping, regions in DAMPINGS[:3]:
            self.check(Bar((3, 2), (6, 9), "x_min", damping, regions))

    def test_dashpot(self):
        for dashpot in (3e6, 1e9):
            self.check(Bar((3, 2), (6, 9), "x_min", (0, 2e-6), dashpot=dashpot))


if __name__ == "__main__":
    unittest.main()
