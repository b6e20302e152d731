"""Order of convergence in the time step: 2 without damping, 1 with the damping of half a step before.

Four oscillators of 2 Hz with damping ratios of 0, 1.5, 5 and 30 %, u0 = 1 m, v0 = 0.5 m/s, for
1.37 s; errors at N steps beside those of an independent implementation of the scheme. A clamped bar
of 20 elements on which gravity acts at once, against the modes of the masses and springs that it is.
"""
import math
import unittest

import numpy

from decks import box_of, clock, material, probes
from recorded import Recorded

OMEGA, DURATION = 2 * math.pi * 2, 1.37
STEPS = (200, 400, 800, 1600, 3200, 6400)
ERRORS = {  # damping ratio: largest |u - exact| [m]
    0.0: (0.005260435879620426, 0.0013140263836487615, 0.00032843874425178554,
          8.210544237360895e-05, 2.0526095311876325e-05, 5.131507247763123e-06),
    0.015: (0.012651368530354229, 0.005304754423877178, 0.0023980478214185585,
            0.0011355329561051064, 0.0005519037818659533, 0.0002719873847655818),
    0.05: (0.01796939676256877, 0.00841382925722152, 0.004065095450721548,
           0.0019971999832985865, 0.000989776045707158, 0.0004926836336019702),
    0.3: (0.001197445, 0.00059034298, 0.00029277138, 0.00014575083, 7.2712553e-05, 3.6315055e-05),
}


def oscillators(steps):
    time_step = DURATION / steps
    names = [f"one{k}" for k in range(len(ERRORS))]
    words = ["-structures", ",".join(names), "-probes", ",".join(f"at_{name}" for name in names),
             *clock(repr(time_step), repr(DURATION), repr(time_step / 2))]
    for name, ratio in zip(names, ERRORS):
        words += [f"-{name}_mesh", "tests/meshes/chain.geo",
                  f"-{name}_initial_displacement", "1,0,0", f"-{name}_initial_velocity", "0.5,0,0",
                  f"-{name}_first_element", "point_mass", f"-{name}_first_mass", 3,
                  f"-{name}_support_element", "grounded_spring",
                  f"-{name}_support_stiffness", f"{3 * OMEGA**2!r},1,1",
                  f"-{name}_damping_alpha", repr(2 * ratio * OMEGA),
                  f"-at_{name}_structure", name, f"-at_{name}_at", "1,0,0"]
    return words


def exact(ratio, t):
    damped = OMEGA * math.sqrt(1 - ratio**2)
    sine = (0.5 + ratio * OMEGA) / damped
    return numpy.exp(-ratio * OMEGA * t) * (numpy.cos(damped * t) + sine * numpy.sin(damped * t))


class Oscillators(unittest.TestCase):
    def test_errors_and_orders(self):
        found = {ratio: [] for ratio in ERRORS}
        for number, steps in enumerate(STEPS):
            run = Recorded(self, oscillators(steps))
            self.assertEqual(len(run.time), steps + 1)
            for k, ratio in enumerate(ERRORS):
                error = abs(run.displacement(f"at_one{k}.x")[-1] - exact(ratio, DURATION))
                self.assertAlmostEqual(error / ERRORS[ratio][number], 1, delta=1e-6)
                found[ratio].append(error)
        for ratio, errors in found.items():
            order = math.log2(errors[-2] / errors[-1])
            self.assertAlmostEqual(order, 2 if ratio == 0 else 1, delta=1e-4 if ratio == 0 else 0.03)


class Bar(unittest.TestCase):
    """Clamped at z = 0; gravity along z from t = 0 on."""

    ELEMENTS, LENGTH, YOUNG, DENSITY, GRAVITY = 20, 10.0, 900.0, 1.0, 10.0
    END = 2.3 * LENGTH / 30
    STEPS = (148, 296, 592, 1184)

    def exact(self, alpha, beta):
        """Displacement of the top at END, of the masses and springs: sum over their modes."""
        size = self.LENGTH / self.ELEMENTS
        mass = numpy.full(self.ELEMENTS, self.DENSITY * size)
        mass[-1] /= 2
        matrix = 2 * numpy.eye(self.ELEMENTS) - numpy.eye(self.ELEMENTS, k=1) - \
            numpy.eye(self.ELEMENTS, k=-1)
        matrix[-1, -1] = 1
        root = numpy.sqrt(mass)
        squares, modes = numpy.linalg.eigh(matrix * self.YOUNG / size / numpy.outer(root, root))
        u = 0
        for square, mode in zip(squares, modes.T):
            omega = math.sqrt(square)
            ratio = alpha / (2 * omega) + beta * omega / 2
            damped = numpy.sqrt(complex(1 - ratio**2)) * omega
            response = 1 - math.exp(-ratio * omega * self.END) * (
                numpy.cos(damped * self.END) + ratio * omega / damped * numpy.sin(damped * self.END))
            u += mode[-1] / root[-1] * (mode @ root) * self.GRAVITY * response.real / square
        return u

    # name: alpha, beta, order
    BARS = {"plain": (0, 0, 2), "both": (0.1, 0.002, 1), "stiff": (0, 0.02, 1)}

    def test_orders(self):
        errors = {name: [] for name in self.BARS}
        for steps in self.STEPS:
            time_step = self.END / steps
            words = ["-structures", ",".join(self.BARS), *material("soft", self.YOUNG, 0, self.DENSITY),
                     *clock(repr(time_step), repr(self.END), repr(time_step / 2)),
                     *probes(**{f"top_{name}": f"{name}:z_max" for name in self.BARS})]
            for name, (alpha, beta, _) in self.BARS.items():
                words += [*box_of(name, f"lz={self.LENGTH},nz={self.ELEMENTS}", "soft", "hex8_full"),
                          f"-{name}_clamp", "z_min", f"-{name}_gravity", f"0,0,{self.GRAVITY}",
                          f"-{name}_damping_alpha", alpha, f"-{name}_damping_beta", beta]
            run = Recorded(self, words)
            self.assertEqual(len(run.time), steps + 1)
            for name, (alpha, beta, _) in self.BARS.items():
                errors[name].append(abs(run.displacement(f"top_{name}.z")[-1] - self.exact(alpha, beta)))
        for name, (*_, expected) in self.BARS.items():
            orders = numpy.log2(numpy.array(errors[name][:-1]) / errors[name][1:])
            self.assertAlmostEqual(orders[-1], expected, delta=0.05, msg=orders)


if __name__ == "__main__":
    unittest.main()
