"""Floor spectra of motions known in closed form: what the program writes for what its probes feel.

A free mass under gravity feels a step A: PSA = A (1 + exp(-pi xi / sqrt(1 - xi^2))) at any
frequency. A mass that falls on a rigid wall feels an impulse J in one step: PSA = J omega
exp(-xi acos(xi) / sqrt(1 - xi^2)). A clamped node feels the ground: a half sine, a harmonic motion,
a triangle of unit impulse, an earthquake. References: closed forms, and exact spectra of the
piecewise linear records by an independent code.
"""
import math
import unittest

import numpy

from decks import clock, contacts, material, probes
from recorded import Recorded, write_samples
from references import earthquake, response_spectra
from references.response_spectra import HALF_SINE

SAMPLING = 5e-5
DAMPINGS = (0.0, 0.02, 0.05, 0.1)


def ground(record, end, frequencies, dampings="0.05", time_step=SAMPLING):
    """A clamped face on the shaken ground."""
    return ["-structures", "block", "-block_mesh", "tests/meshes/box.geo", "-block_clamp", "z_min",
            "-block_body_element", "hex8_full", "-block_body_material", "rock", *material("rock", 1e6, 0, 2000),
            "-motion_x_record", record, "-motion_x_unit", "m/s2", *clock(time_step, end, time_step * (1 + 1e-9)),
            "-spectra_frequencies", ",".join(map(repr, frequencies)), "-spectra_damping", dampings,
            *probes(base="block:z_min")]


class FreeMass(unittest.TestCase):
    FREQUENCIES = (1, 3, 10, 30, 100, 200, 400)

    def mass(self, time_step, end, *more):
        return ["-structures", "mass", "-mass_mesh", "tests/meshes/floor.geo", "-mass_plate_element", "shell",
                "-mass_plate_material", "skin", "-mass_plate_thickness", 0.1, *material("skin", 1e3, 0, 30),
                *clock(repr(time_step), end, SAMPLING * (1 + 1e-9)),
                "-spectra_frequencies", ",".join(map(str, self.FREQUENCIES)),
                "-spectra_damping", ",".join(map(str, DAMPINGS)), *probes(probe="mass:plate"), *more]

    def test_step(self):
        run = Recorded(self, self.mass(SAMPLING, 1.2, "-mass_gravity", "3,0,0"))
        for ratio in DAMPINGS:
            frequency, found = run.spectrum("probe", "x", ratio)
            exact = 3 * (1 + math.exp(-math.pi * ratio / math.sqrt(1 - ratio**2)))
            # The first sample is half a step long: the step acts half a sample too late, as a ramp.
            self.assertLess(abs(found / exact - 1).max(), 5e-4)
            self.assertLess(abs(found / exact - 1)[frequency < 50].max(), 5e-6)

    def test_impulse(self):
        for time_step in (SAMPLING, SAMPLING / 5):
            run = Recorded(self, self.mass(time_step, 1.5, "-mass_initial_velocity", "0,0,2",
                                           *contacts(stop=("mass:plate", "wall", 0.1))))
            self.assertEqual(len(run.column("start")), 1)
            for ratio in DAMPINGS:
                frequency, found = run.spectrum("probe", "z", ratio)
                omega = 2 * math.pi * frequency
                exact = 2 * omega * math.exp(-ratio * math.acos(ratio) / math.sqrt(1 - ratio**2))
                # The impulse has become a triangle of base twice the sampling interval.
                droop = numpy.sinc(frequency * SAMPLING)**2
                self.assertLess(abs(found / exact / droop - 1).max(), 2e-6)
                self.assertLess(abs(found / exact - 1).max(), 1.4e-3)


class Ground(unittest.TestCase):
    def test_half_sine(self):
        td = 0.01
        frequencies = [product / td for product in HALF_SINE]
        values = [math.sin(math.pi * i / 200) for i in range(200)] + [0.0] * 3
        record = write_samples(values, td / 200)
        run = Recorded(self, ground(record, 0.3, frequencies, dampings="0,0.02,0.05",
                                    time_step=1e-5))
        for k, ratio in enumerate((0.0, 0.02, 0.05)):
            _, found = run.spectrum("base", "x", ratio)
            exact = numpy.array([row[k] for row in HALF_SINE.values()])
            self.assertLess(abs(found / exact - 1).max(), 2.2e-5)  # 200 lines for the half sine

    # 10 Hz, 1 m/s2 for 2 s, 5 %
    HARMONIC = {0.1: 0.0090023777, 1.0: 0.10191769, 5.0: 0.80915696, 9.0: 5.0753783,
                10.0: 9.9817025, 11.0: 6.0325634, 20.0: 1.620059, 50.0: 1.041775,
                100.0: 1.0427683, 400.0: 1.0013073}

    def test_harmonic(self):
        record = write_samples([math.sin(2 * math.pi * 10 * i * 1e-4) for i in range(20001)], 1e-4)
        run = Recorded(self, ground(record, 2.0, list(self.HARMONIC)))
        _, found = run.spectrum("base", "x")
        exact = numpy.array(list(self.HARMONIC.values()))
        self.assertLess(abs(found / exact - 1).max(), 4e-6)  # 1000 lines per period

    def test_triangle_of_unit_impulse(self):
        table = {1e-4: (58.225585, 582.06624, 1162.9839, 2316.7974),
                 5e-4: (58.220988, 577.48466, 1126.7064, 2038.2668)}
        for step, exact in table.items():
            impulse = 0.01  # m/s: peaks of ground motions are limited
            record = write_samples([0.0, impulse / step, 0.0, 0.0], step)
            run = Recorded(self, ground(record, 0.2, [10, 100, 200, 400], time_step=1e-5))
            _, found = run.spectrum("base", "x")
            self.assertLess(abs(found / impulse / numpy.array(exact) - 1).max(), 5e-8)

    def test_earthquake(self):
        motion = earthquake.acceleration()
        record = write_samples(motion, earthquake.STEP)
        frequencies = [0.5, 1, 2, 3.3, 5, 8, 13, 20, 33, 50, 80, 130, 200, 300, 400]
        run = Recorded(self, ground(record, (len(motion) - 1) * earthquake.STEP, frequencies, time_step=2.5e-4))
        for frequency, found in zip(*run.spectrum("base", "x")):
            exact = response_spectra.pseudo_acceleration(motion, earthquake.STEP, frequency, 0.05)
            self.assertAlmostEqual(found / exact, 1, delta=1e-6)
        for frequency, found in zip(*run.spectrum("ground", "x")):  # of the record itself, whatever the samples
            exact = response_spectra.pseudo_acceleration(motion, earthquake.STEP, frequency, 0.05)
            self.assertAlmostEqual(found / exact, 1, delta=5e-7)


if __name__ == "__main__":
    unittest.main()
