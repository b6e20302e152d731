"""The time step at its limit: stable below, marginal at it, and found out above it.

Masses on springs with stiffness damping of ratio xi; the scheme is stable if and only if omega dt is
below 2 / (sqrt(1 + xi^2) + xi). Histories below the limit are those of the scheme,
z^2 - (2 - 2 xi omega dt - omega^2 dt^2) z + (1 - 2 xi omega dt) = 0. Above it a mode grows by its spectral
radius each step, from 2.4 to 1.00002: the run must stop by itself, with one line and exit status 1,
before anything that is not a number is written.
"""
import math
import re
import unittest

import numpy

from history import History, refused, scenes
from decks import clock

SPEED, MASS, LIMIT = 0.5, 50.0, 1e-3  # the limit of every oscillator [s]
RATIOS = {"free": 0.0, "weak": 0.006, "strong": 0.3, "over": 1.9149}

# part of the stable step, damping ratio: spectral radius, steps in which 1 grows to 1e6
UNSTABLE = {
    (1.00001, 0.0): (1.0089843839136252, 1544.6223247506869),
    (1.00001, 0.006): (1.002972834427236, 4654.156277315147),
    (1.00001, 0.3): (1.0000696010140429, 198502.73058741735),
    (1.00001, 1.9149): (1.0000225629528106, 612316.4167710658),
    (1.001, 0.0): (1.093556542062358, 154.47497377631993),
    (1.001, 0.006): (1.0815903805870515, 176.14515435986567),
    (1.001, 0.3): (1.006950024826077, 1994.73592645668),
    (1.001, 1.9149): (1.002256546925822, 6129.317417621945),
    (1.01, 0.0): (1.326584426950908, 48.88585282704522),
    (1.01, 0.006): (1.3119839982757755, 50.8782699547774),
    (1.01, 0.3): (1.0686776776121873, 207.99578792052174),
    (1.01, 1.9149): (1.0225883444332895, 618.5032492320391),
    (1.1, 0.0): (2.428166652890286, 15.573150717374551),
    (1.1, 0.006): (2.403341083387774, 15.75566491012237),
    (1.1, 0.3): (1.6506234565356488, 27.567446779893466),
    (1.1, 1.9149): (1.2281693830427884, 67.22066451752973),
}


def oscillators(names):
    """Oscillators of the same stable step, whatever their damping."""
    words = ["-structures", ",".join(names), "-modes", 0, "-spectra_frequencies", 10,
             "-probes", ",".join(f"at_{name}" for name in names)]
    for name in names:
        omega = frequency(RATIOS[name])
        words += scenes.oscillator(name, MASS * omega**2, MASS, SPEED, 2 * RATIOS[name] / omega)
        words += [f"-at_{name}_structure", name, f"-at_{name}_at", "1,0,0"]
    return words


def frequency(ratio):
    return 2 / (LIMIT * (math.sqrt(1 + ratio**2) + ratio))


def roots(part, ratio):
    """Of the characteristic polynomial of the scheme."""
    step = part * LIMIT * frequency(ratio)
    return numpy.roots([1, -(2 - 2 * ratio * step - step**2), 1 - 2 * ratio * step])


class Below(unittest.TestCase):
    def test_histories_are_those_of_the_scheme(self):
        for part in (0.5, 0.9, 0.999):
            dt = part * LIMIT
            run = History(self, [*oscillators(RATIOS), *clock(repr(dt), repr(4000 * dt), repr(dt / 2))], 2)
            self.assertLess(run.energy["relative_residual"], 1e-12)
            for name, ratio in RATIOS.items():
                z = roots(part, ratio)
                self.assertLess(abs(z).max(), 1 + 1e-12)
                first = SPEED * (1 - ratio * dt * frequency(ratio))  # v after the half step
                steps = numpy.arange(len(run.time))
                exact = first * dt * ((z[0]**steps - z[1]**steps) / (z[0] - z[1])).real
                found = run.channel("displacement", f"at_{name}.x")
                self.assertLess(abs(found - exact).max(), 1e-9 * abs(exact).max(), (part, name))


class AtTheLimit(unittest.TestCase):
    def test_undamped_grows_with_time_at_most_damped_stays(self):
        probe = History(self, [*oscillators(RATIOS), "-end_time", 1e-9])
        stable = probe.summary["stable_time_step"]
        self.assertAlmostEqual(stable / LIMIT, 1, delta=1e-6)
        run = History(self, [*oscillators(RATIOS), *clock(repr(stable), repr(20000 * stable), repr(stable / 2))])
        steps = numpy.arange(len(run.time))
        for name, ratio in RATIOS.items():
            found = abs(run.channel("displacement", f"at_{name}.x"))
            bound = SPEED * stable * numpy.maximum(steps, 1)  # double root -1: n dt v
            self.assertTrue((found <= bound * (1 + 1e-9)).all(), name)
            if ratio > 0:
                self.assertLess(found[10000:].max(), 1.001 * found[:10000].max(), name)


class Above(unittest.TestCase):
    def diverge(self, words, part, steps, ranks=1):
        dt = part * LIMIT
        return refused(self, [*words, *clock(repr(dt), repr(steps * dt), repr(50 * dt)),
                              "-allow_unstable", "true"], "the run diverged", ranks=ranks)

    def test_found_before_it_has_grown_a_million_times(self):
        for (part, ratio), (radius, steps) in UNSTABLE.items():
            self.assertAlmostEqual(abs(roots(part, ratio)).max(), radius, delta=1e-6)
            name = next(name for name, value in RATIOS.items() if value == ratio)
            with self.subTest(part, ratio=ratio):
                line = self.diverge(oscillators([name]), part, max(steps, 200))
                for word in (f"structure {name}", "node at (1, 0, 0)", "element", "group 'first'", "kinetic"):
                    self.assertIn(word, line)
                self.assertLessEqual(int(re.search(r"step (\d+)", line)[1]), max(steps, 200))

    def test_names_the_structure_and_the_node_that_grow(self):
        # The stiff spring is in the second structure, beyond its first mass.
        wild = 4e6 / 2  # of the chain: omega_max^2 = 2 k / m, and the limit is 1e-3 s
        words = ["-structures", "calm,wild", *scenes.two_masses("calm", 1.0, wild / 2, SPEED),
                 *scenes.two_masses("wild", 1.0, wild, SPEED), "-modes", 0,
                 "-wild_initial_velocity", "0,0,0.01"]
        for ranks in (1, 3):
            line = self.diverge(words, 1.01, 2000, ranks)
            self.assertIn("structure wild", line)
            self.assertRegex(line, r"node at \([12], 0, 0\), component uz")

    def test_points_at_the_thin_layer(self):
        words = scenes.column(0.01, end_time=1.0)
        stable = History(self, [*words, "-end_time", 1e-9]).summary["stable_time_step"]
        line = refused(self, [*words, "-time_step", repr(1.01 * stable), "-allow_unstable", "true"],
                       "the run diverged", "structure column", "group 'body'")
        z = float(re.search(r"node at \([^,]+, [^,]+, ([^)]+)\)", line)[1])
        self.assertTrue(0.5 - 1e-6 <= z <= 0.51 + 1e-6, line)


if __name__ == "__main__":
    unittest.main()
