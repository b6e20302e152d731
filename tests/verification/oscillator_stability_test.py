"""The stable time step is exact: bounded just below it, growing just above, at the predicted rate.

One degree of freedom, Omega = omega dt: z^2 - (2 - 2 xi Omega - Omega^2) z + (1 - 2 xi Omega) = 0,
stable for Omega < 2 (sqrt(1 + xi^2) - xi), for damping by alpha or beta. A dashpot acts at mid-step,
(1 + xi Omega) z^2 - (2 - Omega^2) z + (1 - xi Omega) = 0, stable for Omega < 2 whatever it takes. All
oscillators of a run have their frequency such that they have the same limit. A free mass beside an
oscillator keeps the energy positive, without which the program stops a run that grows. A bar of
lumped masses has omega_max = 2 c/h if free, 2 c/h sin((2 N - 1) pi / (4 N)) if held at one end.
"""
import itertools
import math
import unittest

import numpy

import program
from decks import box_of, clock, material, probes
from recorded import Recorded

LIMIT = 1e-3  # s, of all oscillators
SPEED = 0.1
RATIOS = (0.0, 0.006, 0.05, 0.2, 0.5, 1.0, 1.9149, 5.0)
# largest modulus of the roots just below and above the limit, by an independent code
RADIUS = {0.0: (1, 1.093557), 0.006: (0.9880118544, 1.0815903806), 0.05: (0.9475628825, 1.0349981240),
          0.2: (0.9897398799, 1.0101387012), 0.5: (0.9955284443, 1.0044727229),
          1.0: (0.9971723303, 1.0028291845), 1.9149: (0.9977439615, 1.0022565469),
          5.0: (0.9979604317, 1.0020396474)}


def critical(ratio, kind="beta"):
    """omega dt at the limit."""
    return 2 if kind == "dashpot" else 2 / (math.sqrt(1 + ratio**2) + ratio)


def oscillator(name, ratio, kind, free_mass):
    mass = 2.0
    omega = critical(ratio, kind) / LIMIT
    loss = 2 * ratio * omega
    words = [f"-{name}_mesh", "tests/meshes/chain.geo", f"-{name}_initial_velocity", f"{SPEED},0,0",
             f"-{name}_first_element", "point_mass", f"-{name}_first_mass", mass,
             f"-{name}_second_element", "point_mass", f"-{name}_second_mass", free_mass,
             f"-{name}_support_element", "grounded_spring",
             f"-{name}_support_stiffness", f"{mass * omega**2!r},1,1"]
    if kind == "dashpot":
        words += [f"-{name}_support_dashpot", f"{mass * loss!r},0,0,0,0,0"]
    elif kind == "alpha":
        words += [f"-{name}_damping_alpha", repr(loss)]
    else:
        words += [f"-{name}_damping_beta", repr(loss / omega**2)]
    return words + [f"-at_{name}_structure", name, f"-at_{name}_at", "1,0,0"]


def scene(kinds, part, steps, free_mass, taken=lambda ratio, kind: True):
    cases = {f"{kind}{k}": (ratio, kind) for kind in kinds for k, ratio in enumerate(RATIOS) if taken(ratio, kind)}
    time_step = part * LIMIT
    words = ["-structures", ",".join(cases), "-probes", ",".join(f"at_{name}" for name in cases),
             *clock(repr(time_step), repr(steps * time_step), repr(time_step / 2)), "-allow_unstable"]
    for name, (ratio, kind) in cases.items():
        words += oscillator(name, ratio, kind, free_mass)
    return cases, words


def recurrence(ratio, kind, part, steps):
    """Displacements of the scheme from rest position with SPEED."""
    step = part * LIMIT
    frequency = part * critical(ratio, kind)
    u = numpy.zeros(steps + 1)
    v = SPEED
    for n in range(steps):
        share = 1 if n > 0 else 0.5
        x = ratio * frequency * share
        force = share * frequency**2 * u[n] / step
        v = ((1 - x) * v - force) / (1 + x) if kind == "dashpot" else (1 - 2 * x) * v - force
        u[n + 1] = u[n] + step * v
    return u


def growth(ratio, kind):
    """Largest modulus of a root just above the limit."""
    if kind != "dashpot":
        return RADIUS[ratio][1]
    frequency = 1.001 * critical(ratio, kind)
    return abs(numpy.roots([1 + ratio * frequency, frequency**2 - 2, 1 - ratio * frequency])).max()


class OneDegreeOfFreedom(unittest.TestCase):
    def test_program_states_the_limit(self):
        cases, words = scene(("alpha", "beta", "dashpot"), 0.999, 10, 1.0)
        run = Recorded(self, words)
        for name, (ratio, _) in cases.items():
            found = run.summary["structures"][name]["stable_time_step"]
            self.assertAlmostEqual(found / LIMIT, 1, delta=1e-9, msg=name)

    def test_bounded_below(self):
        steps = 4000
        for ranks in (1, 2):
            cases, words = scene(("alpha", "beta", "dashpot"), 0.999, steps, 1.0)
            run = Recorded(self, words, ranks)
            for name, (ratio, kind) in cases.items():
                u = run.displacement(f"at_{name}.x")
                exact = recurrence(ratio, kind, 0.999, steps)
                with self.subTest(name, ratio=ratio):
                    self.assertLess(abs(u - exact).max(), 1e-9 * abs(exact).max())
                    half = steps // 2
                    largest = abs(u[half:]).max() / abs(u[:half]).max()
                    self.assertLess(largest, 1.0001 if ratio == 0 else 0.3 if kind == "dashpot" else 0.05)

    def test_grows_above(self):
        # At the rate of the root beyond -1, once that dominates; what grows fast must not outgrow the free mass.
        fast = 1.04
        halves = ((340, lambda *case: growth(*case) > fast), (600, lambda *case: growth(*case) <= fast))
        for ranks, (steps, taken) in itertools.product((1, 3), halves):
            cases, words = scene(("beta", "dashpot"), 1.001, steps, 1e30, taken)
            run = Recorded(self, words, ranks)
            for name, (ratio, kind) in cases.items():
                u = run.displacement(f"at_{name}.x")
                exact = recurrence(ratio, kind, 1.001, steps)
                rate = abs(u[-1] / u[-101])**0.01
                with self.subTest(name, ratio=ratio):
                    self.assertLess(abs(u - exact).max(), 1e-9 * abs(exact).max())
                    self.assertAlmostEqual(rate, growth(ratio, kind), delta=1e-6)

    def test_decays_below_at_the_rate_of_the_root(self):
        cases, words = scene(("alpha",), 0.999, 9200, 1.0)
        run = Recorded(self, words)
        for name, (ratio, _) in cases.items():
            if ratio >= 0.05:  # the roots are real: one lasts
                radius = RADIUS[ratio][0]
                late = int(math.log(1e-8) / math.log(radius))
                u = run.displacement(f"at_{name}.x")
                self.assertAlmostEqual(abs(u[late + 100] / u[late])**0.01, radius, delta=1e-8)

    def test_what_grows_is_refused_or_stopped(self):
        cases, words = scene(("beta",), 1.001, 20000, 1.0)
        words.remove("-allow_unstable")
        self.check_failure(program.run(words), "stable")
        for ratio in RATIOS[2:]:
            words = oscillator("alone", ratio, "beta", 1e-3)
            self.check_failure(program.run(
                ["-structures", "alone", "-probes", "at_alone", "-time_step", repr(1.001 * LIMIT),
                 "-end_time", 30, "-allow_unstable", *words], 1), "diverged")

    def check_failure(self, result, word):
        self.assertNotEqual(result.returncode, 0)
        self.assertIn(word, program.error_lines(result)[0])


DAMPINGS = ((0, 0), (444.3, 0), (0, 1e-5), (50, 1e-4), (0, 1e-3))  # alpha [1/s], beta [s]


class ClampedBar(unittest.TestCase):
    """Of hexahedra without Poisson effect, by its own highest frequency."""

    ELEMENTS, LENGTH, YOUNG, DENSITY = 20, 5.0, 30e9, 2400.0
    SOUND = math.sqrt(YOUNG / DENSITY)
    OMEGA = 2 * SOUND * ELEMENTS / LENGTH * math.sin((2 * ELEMENTS - 1) * math.pi / (4 * ELEMENTS))

    def strike(self, part, alpha, beta, steps):
        ratio = alpha / (2 * self.OMEGA) + beta * self.OMEGA / 2
        limit = critical(ratio) / self.OMEGA
        words = ["-structures", "bar", *box_of("bar", f"lz={self.LENGTH},nz={self.ELEMENTS}", "concrete", "hex8_full"),
                 "-bar_clamp", "z_min", *material("concrete", self.YOUNG, 0, self.DENSITY),
                 "-bar_initial_velocity", "0,0,1", "-bar_damping_alpha", repr(alpha), "-bar_damping_beta", repr(beta),
                 *clock(repr(part * limit), repr(steps * part * limit), repr(limit / 2)), "-allow_unstable",
                 *probes(top="bar:z_max")]
        return limit, words

    def test_bounded_below(self):
        for number, (alpha, beta) in enumerate(DAMPINGS):
            limit, words = self.strike(0.999, alpha, beta, 5000)
            run = Recorded(self, words, 1 + number % 3)
            found = run.summary["structures"]["bar"]["stable_time_step"]
            self.assertAlmostEqual(found / limit, 1, delta=1e-9)
            u = abs(run.displacement("top.z"))
            bound = 1 if alpha == beta == 0 else 0.5
            self.assertLess(u[2500:].max(), bound * u[:2500].max())
            left = run.energy["kinetic"] + run.energy["strain"] + run.energy["damping"]
            struck = self.DENSITY * self.LENGTH * (1 - 1 / (2 * self.ELEMENTS)) / 2
            # the balance starts half a step after the blow
            self.assertAlmostEqual(left / struck, 1, delta=0.1)

    def test_grows_above(self):
        for number, (alpha, beta) in enumerate(DAMPINGS):
            _, words = self.strike(1.001, alpha, beta, 100000)
            result = program.run(words, 1 + number % 3)
            self.assertNotEqual(result.returncode, 0, (alpha, beta))
            self.assertIn("diverged", program.error_lines(result)[0], (alpha, beta))


if __name__ == "__main__":
    unittest.main()
