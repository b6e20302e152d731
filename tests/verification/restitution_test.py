"""Stiffness-proportional damping sets the coefficient of restitution of an elastic bar on a wall.

While the bar is in contact, for 2 L/c, its wave front spreads with the variance 2 beta L/c, and the
impulse lost is sqrt(2/pi) sigma rho c v0: e = 1 - (2/sqrt(pi)) sqrt(beta c/L) for beta c/L << 1. The
bar is that of bar_on_wall_test. Values for any beta: an independent one-dimensional code, with the
same elements; they are converged to four digits.
"""
import math
import unittest

from bar_on_wall_test import LENGTH, MASS, SPEED, SPEED_OF_SOUND, fall, thrown, velocity

# beta c / L: elements, e with these elements, e of very many, last contact over L/c, tolerance of
# the law for small beta
TABLE = {
    0.0001: (200, 0.9885692916865675, 0.98871, 1.999, 2e-4),
    0.0003: (200, 0.9804068610007107, 0.98046, 1.999, 1e-4),
    0.001: (100, 0.9642772889194896, 0.96432, 1.999, 1e-4),
    0.003: (100, 0.9381994790492688, 0.93824, 1.997, 1e-4),
    0.005: (100, 0.9202993358551678, 0.92030, 1.996, 2e-4),
    0.01: (100, 0.8874052592222703, 0.88740, 1.991, 3e-4),
    0.01776: (100, 0.8502024529717048, 0.85019, 1.984, 7e-4),
    0.03: (100, 0.8058125807136807, 0.80580, 1.974, 2e-3),
    0.05: (100, 0.7503736168023984, 0.75036, 1.956, 3e-3),
    0.1: (100, 0.6508012026629632, 0.65079, 1.912, None),
    0.3: (50, 0.42437, 0.42437, 1.748, None),
    1.0: (50, 0.15031, 0.15031, 1.369, None),
}


class Restitution(unittest.TestCase):
    def test_law_and_table(self):
        transit = LENGTH / SPEED_OF_SOUND
        for relative, row in TABLE.items():
            elements, discrete, converged, last, tolerance = row
            ratio = relative * elements  # of damping at the highest frequency, 2 c/h
            with self.subTest(relative):
                run = fall(self, elements, thrown(
                    elements, 0.9, 5.00137, "-bar_damping_beta", repr(relative * transit),
                    "-output_interval", 1e-3, ratio=ratio, end_time=0.5 + 2.2 * transit))
                found = velocity(run, elements)[-1] / SPEED
                contact = (run.column("end")[-1] - run.column("start")[0]) / transit
                self.assertAlmostEqual(found, discrete, delta=1e-10 if elements > 50 else 6e-6)
                self.assertAlmostEqual(found, converged, delta=2e-4)
                self.assertAlmostEqual(contact, last, delta=6e-3)
                if tolerance is not None:
                    law = 1 - 2 / math.sqrt(math.pi) * math.sqrt(relative)
                    self.assertAlmostEqual(found, law, delta=tolerance)
                self.assertAlmostEqual(run.column("impulse").sum(), MASS * SPEED * (1 + found),
                                       delta=1e-9)



if __name__ == "__main__":
    unittest.main()
