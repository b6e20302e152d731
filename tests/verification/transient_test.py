"""A load that acts at once and stays: a bar, a deep beam (NAFEMS 5T), a thin and a thick plate (13T,
21T), up to their first peak.

The load is gravity that starts at t = 0, of the acceleration that makes the pressure. Bar on a
clamp: d'Alembert, u_top = g t^2 / 2 until the wave from the clamp is there at L/c, less
g (t - L/c)^2 until 3 L/c; the peak is twice the static g L^2 / (2 c^2). Beam (Euler-Bernoulli) and
plates (thin: Kirchhoff, thick: Mindlin): peak, its time and the static deflection from the series of
modes with Rayleigh damping. Simple supports are stiff springs. The beam has E multiplied and I
divided by 30, so that the rotary inertia of its section, which the series leaves out, is small.
"""
import math
import unittest

import numpy

from decks import box_of, clock, material, probes, section
from recorded import Recorded

# Springs of 1e13 N/m leave a force by round-off.
IDENTITY_WITH_STIFF_SUPPORTS = 1e-11  # measured: 2e-12


class Bar(unittest.TestCase):
    LENGTH, YOUNG, DENSITY, GRAVITY, ELEMENTS = 5.0, 30e9, 2400.0, 9.81, 100
    SOUND = math.sqrt(YOUNG / DENSITY)

    def test_top_follows_the_waves(self):
        transit = self.LENGTH / self.SOUND
        time_step = 0.9 * transit / self.ELEMENTS
        run = Recorded(self, ["-structures", "bar",
                              *box_of("bar", f"lz={self.LENGTH},nz={self.ELEMENTS}", "concrete", "hex8_full"),
                              "-bar_clamp", "z_min", *material("concrete", self.YOUNG, 0, self.DENSITY), "-bar_gravity",
                              f"0,0,{self.GRAVITY}", *clock(repr(time_step), repr(3 * transit), repr(time_step / 2)),
                              *probes(top="bar:z_max")])
        t, u = run.time, run.displacement("top.z")
        late = numpy.maximum(0, t - transit)
        exact = self.GRAVITY * (t**2 / 2 - late**2)
        peak = self.GRAVITY * transit**2
        self.assertLess(abs(u - exact).max() / peak, 3e-4)
        self.assertAlmostEqual(u.max() / peak, 1, delta=3e-4)
        self.assertAlmostEqual(t[u.argmax()] / (2 * transit), 1, delta=0.01)


def peak_of(run, channel):
    """Largest displacement and its time, by the parabola through the three largest."""
    u, t = abs(run.displacement(channel)), run.time
    k = int(u.argmax())
    curve = numpy.polyfit(t[k - 1:k + 2] - t[k], u[k - 1:k + 2], 2)
    at = -curve[1] / (2 * curve[0])
    return numpy.polyval(curve, at), t[k] + at


class DeepBeam(unittest.TestCase):
    """Pinned, 10 m, 2 x 2 m, 1e6 N/m."""

    AREA, INERTIA, YOUNG, DENSITY = 4.0, 4 / 3 / 30, 200e9 * 30, 8000.0
    PEAK, TIME, STATIC = 0.000948412711754081, 0.011027621814965138, 0.000488281249686127

    def bend(self, elements, end, alpha, ranks):
        hold = 1e13
        return Recorded(self, ["-structures", "beam", "-beam_mesh", "tests/meshes/line.geo", "-beam_mesh_set",
                               f"length=10,n={elements}", "-beam_line_element", "beam", "-beam_line_material", "steel",
                               "-beam_line_section", "square", *material("steel", self.YOUNG, 0.3, self.DENSITY),
                               *section("square", self.AREA, repr(self.INERTIA), repr(self.INERTIA),
                                        repr(2 * self.INERTIA), "0,0,1"),
                               "-beam_x_min_element", "grounded_spring", "-beam_x_max_element", "grounded_spring",
                               "-beam_x_min_stiffness", f"{hold},{hold},{hold},{hold},0,0", "-beam_x_max_stiffness",
                               f"0,{hold},{hold},0,0,0", "-beam_gravity", f"0,{1e6 / (self.DENSITY * self.AREA)!r},0",
                               "-beam_damping_alpha", alpha, "-beam_damping_beta", 7.46e-5, "-end_time", end,
                               "-output_interval", 2e-5,
                               *probes(middle="beam@5,0,0")], ranks, IDENTITY_WITH_STIFF_SUPPORTS)

    def test_peak_and_static_deflection(self):
        run = self.bend(32, 0.02, 5.36, 2)
        found, time = peak_of(run, "middle.y")
        self.assertAlmostEqual(found / self.PEAK, 1, delta=2e-3)
        self.assertAlmostEqual(time / self.TIME, 1, delta=3e-3)
        run = self.bend(32, 0.1, 570, 1)  # critically damped
        self.assertAlmostEqual(run.displacement("middle.y")[-1] / self.STATIC, 1, delta=1e-3)


class Plate(unittest.TestCase):
    """Simply supported, 10 x 10 m."""

    # thickness [m], pressure [Pa], alpha [1/s], beta [s], springs of the edge [N/m, N m], rotary
    # inertia factor, end [s]; peak [m], its time [s], static deflection [m]
    THIN = (0.05, 100.0, 0.299, 1.339e-3, 1e8, 1e6, 0.125, 0.25,
            0.0034598781696004227, 0.21032240280826112, 0.0017744355870521413)
    THICK = (1.0, 1e6, 5.772, 6.926e-5, 1e12, 1e12, 0, 0.0125,
             0.0046013174140755765, 0.010631802212395335, 0.0023329686745836064)
    DENSITY = 8000

    def bend(self, case, cells, ranks, alpha, end):
        thickness, pressure, _, beta, deflection, turn, factor = case[:7]
        words = ["-structures", "plate", "-plate_mesh", "tests/meshes/quadrilateral.geo", "-plate_mesh_set",
                 f"nx={cells},ny={cells}", "-plate_plate_element", "shell", "-plate_plate_material", "steel",
                 "-plate_plate_thickness", thickness, "-plate_plate_rotary_inertia_factor", factor,
                 *material("steel", 200e9, 0.3, self.DENSITY), "-plate_gravity",
                 f"0,0,{pressure / (self.DENSITY * thickness)!r}", "-plate_damping_alpha", alpha, "-plate_damping_beta",
                 beta, "-end_time", end, "-output_interval", end / 1000, *probes(middle="plate@5,0,0")]
        for name, turns in (("corners", (1, 1)), ("x_edges", (1, 0)), ("y_edges", (0, 1))):
            values = [0, 0, deflection, turns[0] * turn, turns[1] * turn, 0]
            words += [f"-plate_{name}_element", "grounded_spring",
                      f"-plate_{name}_stiffness", ",".join(map(str, values))]
        return Recorded(self, words, ranks, IDENTITY_WITH_STIFF_SUPPORTS)

    def check(self, case, static_cells, critical, settled):
        peak, time, static = case[8:]
        found = peak_of(self.bend(case, 16, 2, case[2], case[7]), "middle.z")
        self.assertAlmostEqual(found[0] / peak, 1, delta=3e-3)
        self.assertAlmostEqual(found[1] / time, 1, delta=6e-3)
        run = self.bend(case, static_cells, 1, critical, settled)
        self.assertAlmostEqual(run.displacement("middle.z")[-1] / static, 1, delta=0.01)

    def test_thin(self):
        self.check(self.THIN, 8, 30, 1.0)

    def test_thick(self):
        self.check(self.THICK, 16, 577, 0.06)


if __name__ == "__main__":
    unittest.main()
