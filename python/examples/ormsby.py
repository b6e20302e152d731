#!/usr/bin/python3
"""A record of an Ormsby wavelet, printed as a table: an acceleration whose Fourier amplitude is the same between two
frequencies and falls to nothing along straight lines at two others.

    python/examples/ormsby.py [--corners 0,0.2,20,25] [--peak 4.905] [--centre 1] [--duration 3] [--step 0.002]

A trapezium over the frequency is a sum of triangles, whose transforms are squares of sin x / x. With
s(f) = (sin(pi f t) / (pi t))^2 the wavelet of the corners f1 < f2 < f3 < f4 is

    (s(f4) - s(f3)) / (f4 - f3) - (s(f2) - s(f1)) / (f2 - f1)

over its largest value, f4 + f3 - f2 - f1 at the centre t = 0. It has no beginning and no end; the table begins at 0 and
ends after --duration. Without options it prints petsc-options/plant/ormsby.csv.
"""
import argparse

import numpy


def ormsby(times, corners=(0, 0.2, 20, 25), peak=4.905, centre=1):
    """Acceleration at `times` [s] with `corners` [Hz], unit of `peak`."""
    f1, f2, f3, f4 = corners

    def triangle(f):
        return f**2 * numpy.sinc(f * (numpy.asarray(times) - centre))**2

    return peak * ((triangle(f4) - triangle(f3)) / (f4 - f3) - (triangle(f2) - triangle(f1)) / (f2 - f1)) \
        / (f4 + f3 - f2 - f1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--corners", default="0,0.2,20,25", help="four increasing frequencies [Hz]")
    parser.add_argument("--peak", type=float, default=4.905, help="largest acceleration [m/s2]")
    parser.add_argument("--centre", type=float, default=1, help="when it is reached [s]")
    parser.add_argument("--duration", type=float, default=3, help="last time [s]")
    parser.add_argument("--step", type=float, default=0.002, help="between two samples [s]")
    options = parser.parse_args()
    try:
        corners = [float(word) for word in options.corners.split(",")]
    except ValueError:
        corners = []
    if len(corners) != 4 or not 0 <= corners[0] < corners[1] < corners[2] < corners[3]:
        parser.error(f"--corners {options.corners}: not four increasing frequencies")
    if not corners[3] * options.step < 0.5:
        parser.error(f"--step {options.step:g}: {corners[3]:g} Hz need less than {0.5 / corners[3]:g} s")
    times = options.step * numpy.arange(round(options.duration / options.step) + 1)
    print("time [s],acceleration [m/s2]")
    for time, value in zip(times, ormsby(times, corners, options.peak, options.centre)):
        print(f"{time:.6g},{value:.6g}")


if __name__ == "__main__":
    main()
