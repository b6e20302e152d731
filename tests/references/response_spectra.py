"""Spectra of piecewise linear records by fine sampling: the oscillator is carried exactly from sample to sample by
a matrix exponential, and a parabola goes through the largest sample and its neighbours.

    python3 tests/references/response_spectra.py > tests/references/earthquake_spectrum.csv"""
import math
import os
import sys

import numpy
import scipy.linalg
import scipy.signal

SAMPLES_PER_PERIOD = 400

# half sine of 1 m/s2 for 0.01 s: f td: PSA for xi = 0, 2, 5 %
HALF_SINE = {0.05: (0.199533, 0.19343809, 0.18490564), 0.1: (0.39627355, 0.38416904, 0.36722358),
             0.2: (0.77049238, 0.74695726, 0.71401052), 0.3: (1.1020973, 1.0684346, 1.0213153),
             0.5: (1.5707965, 1.5228372, 1.4557783), 0.75: (1.7633558, 1.7117394, 1.6398006),
             0.8: (1.7683271, 1.7172921, 1.6462061), 1.0: (1.7320508, 1.6851707, 1.620059),
             1.5: (1.5, 1.4659129, 1.4191854), 2.0: (1.2680754, 1.2436963, 1.2110912),
             4.0: (1.1254946, 1.1004523, 1.0720731), 10.0: (1.0496882, 1.0272012, 1.0111564)}


def pseudo_acceleration(values, step, frequency, ratio):
    """Largest response from rest until the last value, which are `step` apart: omega^2 max |u|."""
    omega = 2 * math.pi * frequency
    split = max(1, math.ceil(step * frequency * SAMPLES_PER_PERIOD))
    fine = step / split
    t = numpy.arange((len(values) - 1) * split + 1) / split
    a = numpy.interp(t, numpy.arange(len(values)), values)
    # x' = A x with the states u, v, a and the increment of a over the step
    system = numpy.zeros((4, 4))
    system[:2, :2] = [[0, 1], [-omega**2, -2 * ratio * omega]]
    system[1, 2], system[2, 3] = -1, 1 / fine
    advance = scipy.linalg.expm(system * fine)
    load = numpy.outer(advance[:2, 2], a[:-1]) + numpy.outer(advance[:2, 3], numpy.diff(a))
    # u alone, by the characteristic polynomial of the step
    drive = load[0].copy()
    drive[1:] += advance[0, 1] * load[1][:-1] - advance[1, 1] * load[0][:-1]
    square = advance[:2, :2]
    u = abs(scipy.signal.lfilter([1], [1, -numpy.trace(square), numpy.linalg.det(square)], drive))
    peak = int(u.argmax())
    if not 0 < peak < len(u) - 1:
        return omega**2 * u[peak]
    before, here, after = u[peak - 1:peak + 2]
    curvature = before - 2 * here + after
    return omega**2 * (here - (after - before)**2 / (8 * curvature) if curvature < 0 else here)


if __name__ == "__main__":
    sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    from references import earthquake

    motion = earthquake.acceleration()
    print("frequency,pseudo_acceleration")
    for number in range(40):
        line = 0.5 * 800 ** (number / 39)
        print(f"{line:.9g},{pseudo_acceleration(motion, earthquake.STEP, float(f'{line:.9g}'), 0.05):.10g}")
