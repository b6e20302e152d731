"""Records of Ormsby wavelets of python/examples/ormsby.py: their amplitude over the frequency, the shipped one."""
import math
import os
import subprocess
import sys
import unittest

import numpy

import program

EXAMPLES = os.path.join(program.SOURCE, "python", "examples")
sys.path.insert(0, EXAMPLES)
from ormsby import ormsby  # noqa: E402


def printed(*words):
    return subprocess.run(["/usr/bin/python3", os.path.join(EXAMPLES, "ormsby.py"), *words], capture_output=True,
                          text=True)


class Wavelet(unittest.TestCase):
    def test_the_record_is_what_the_generator_prints(self):
        with open(os.path.join(program.SOURCE, "petsc-options", "plant", "ormsby.csv")) as file:
            self.assertEqual(file.read(), printed().stdout)

    def test_amplitude_is_a_trapezium_over_the_frequency(self):
        """Fourier sums over 200 s beside the lines between the corners."""
        corners = (1.0, 2.0, 20.0, 25.0)
        times = 0.005 * numpy.arange(-20000, 20001)
        values = ormsby(times, corners, 3.0, 0.0)
        self.assertEqual(values.max(), values[20000])
        self.assertAlmostEqual(values.max(), 3, delta=1e-12)
        for frequency in (0.5, 1.25, 1.75, 2.5, 10.0, 19.0, 21.0, 24.0, 26.0, 40.0):
            found = 0.005 * (numpy.exp(-2j * math.pi * frequency * times) @ values)
            exact = 3 / (corners[3] + corners[2] - corners[1] - corners[0]) * \
                numpy.interp(frequency, corners, (0, 1, 1, 0))
            self.assertAlmostEqual(abs(found), exact, delta=1e-4, msg="amplitude")

    def test_mistakes_are_told(self):
        for words, part in ((("--corners", "0,2,1,3"), "not four increasing frequencies"),
                            (("--corners", "0,1,2"), "not four increasing frequencies"),
                            (("--corners", "0,1,2,x"), "not four increasing frequencies"),
                            (("--step", "0.02"), "25 Hz need less than 0.02 s")):
            result = printed(*words)
            self.assertNotEqual(result.returncode, 0)
            self.assertIn(part, result.stderr)


if __name__ == "__main__":
    unittest.main()
