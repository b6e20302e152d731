"""run/shake: a floor's motion for a shake table, within its limits, and what of the spectrum is left."""
import os
import re
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import numpy

import program
import two_buildings
from two_buildings import pounding

sys.path.insert(0, os.path.join(program.SOURCE, "python"))
from pounding import shaking  # noqa: E402


def floor(acceleration, step):
    """A result that holds one channel."""
    found = pounding.results.Result(Path("made"), {"output_interval": step})
    found.history = {"channels": ["floor.x"], "time": step * numpy.arange(len(acceleration)),
                     "acceleration": numpy.array(acceleration)[:, None]}
    return found


class Made(unittest.TestCase):
    def test_a_sine_comes_out_as_itself(self):
        step, frequency = 1e-3, 5.0
        omega, time = 2 * numpy.pi * frequency, step * numpy.arange(12000)
        share = numpy.minimum(1, time / 3)  # set in at once it would drift, with a velocity that is left
        motion = shaking.motion_of(floor(3 * share**2 * (3 - 2 * share) * numpy.sin(omega * time), step), "floor", "x", 0.2)
        begin = round(2 / 0.2 / step)
        inner = slice(begin + 3000, begin + 9000)
        for column, expected in ((motion.acceleration, 3 * numpy.sin(omega * time)),
                                 (motion.velocity, -3 / omega * numpy.cos(omega * time)),
                                 (motion.displacement, -3 / omega**2 * numpy.sin(omega * time))):
            numpy.testing.assert_allclose(column[inner], expected[3000:9000], atol=0.03 * abs(expected).max())

    def test_slow_and_fast_parts_go_with_the_gains_of_the_filter(self):
        step, time = 1e-3, 1e-3 * numpy.arange(40000)
        for frequency in (0.5, 1.0, 40.0):
            samples = numpy.sin(2 * numpy.pi * frequency * time)
            motion = shaking.motion_of(floor(samples, step), "floor", "x", 1.0, 20.0)
            gain = 1 / (1 + frequency**-8) / (1 + (frequency / 20)**8)
            middle = motion.acceleration[len(motion.time) // 2 - 8000:len(motion.time) // 2 + 8000]
            self.assertAlmostEqual(abs(middle).max(), gain, delta=0.01)


class Refused(unittest.TestCase):
    def test_what_the_spectra_refuse_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            spectra = Path(folder, "pounding-spectra")
            spectra.write_text("#!/bin/sh\necho 'pounding-spectra: no room for the spectra' >&2\nexit 1\n")
            spectra.chmod(0o755)
            run = floor(numpy.sin(numpy.arange(4000) * 0.05), 1e-3)
            frequency = numpy.array([5.0, 10.0, 20.0])
            run.spectra = {"probe": numpy.array(["floor"] * 3), "direction": numpy.array(["x"] * 3), "damping": numpy.full(3, 0.05),
                           "frequency": frequency, "pseudo_acceleration": numpy.ones(3)}
            motion = shaking.motion_of(run, "floor", "x", 1.0)
            with unittest.mock.patch.dict(os.environ, POUNDING_BUILD=folder), self.assertRaisesRegex(pounding.UserError, "no room for"):
                shaking.kept(run, "floor", "x", motion)


class Run(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = Path(tempfile.mkdtemp(prefix="pounding-shake-"))
        cls.run_ = two_buildings.run(cls.place / "run", gap=0.01)
        cls.out = cls.place / "table.csv"

    def shake(self, *words, status=0):
        done = program.command("shake", self.place / "run", *words, "--out", self.out)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), status, done.stderr)
        return done.stderr if status else done.stdout

    def columns(self):
        return numpy.genfromtxt(self.out, delimiter=",", names=True, skip_header=1)

    def test_the_slowest_motion_within_the_limits(self):
        said = self.shake("left_roof", "--limits", "0.03,0.5,200")
        table = self.columns()
        above = float(re.search(r"from ([\d.]+) to 200 Hz on", said)[1])
        stroke = abs(table["displacement"]).max()
        self.assertLessEqual(stroke, 0.03)
        lower = shaking.motion_of(self.run_, "left_roof", "x", 0.98 * above, 200.0, 1e-3)
        self.assertGreater(lower.peaks[0], 0.0299)
        low, high = map(float, re.search(r"5 %\) ([\d.]+) to ([\d.]+) times", said).groups())
        self.assertTrue(0.9 < low < 1 < high < 1.1, said)
        # Velocity and displacement are integrals of what is written, and begin and end at rest.
        step = table["time"][1] - table["time"][0]
        for rate, of, part in (("velocity", "displacement", 0.02), ("acceleration", "velocity", 0.08)):  # of 1 ms and 200 Hz
            mean = 0.5 * step * (table[rate][1:] + table[rate][:-1])
            error = numpy.abs(numpy.diff(table[of]) - mean).max()
            self.assertLess(error, part * numpy.abs(mean).max())
            self.assertLess(abs(table[of][[0, -1]]).max(), 0.02 * abs(table[of]).max())

    def test_another_interval_and_band(self):
        self.shake("left_roof", "--above", "1", "--below", "80", "--interval", "0.002")
        table = self.columns()
        steps = numpy.diff(table["time"])
        numpy.testing.assert_allclose(steps, steps[0], rtol=1e-5)
        self.assertTrue(0.0019 < steps[0] <= 0.002, steps[0])  # a whole number of the history's

    def test_refused(self):
        self.assertIn("acceleration 6", self.shake("left_roof", "--limits", "0.03,0.5,20", status=1))
        self.assertIn("no motion of left_roof", self.shake("left_roof", "--limits", "0.03,0.01,200", status=1))
        self.assertIn("no acceleration of nowhere", self.shake("nowhere", status=1))
        self.assertFalse(self.out.exists() and "nowhere" in self.out.read_text())
        for words in (("--limits", "1,2"), ("--above", "0"), ("--interval", "nan")):
            done = program.command("shake", self.place / "run", "left_roof", *words)
            self.assertEqual(done.returncode, 2, done.stderr)


if __name__ == "__main__":
    unittest.main()
