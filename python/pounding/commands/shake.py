"""The motion of a floor for a shake table: run/shake RUN PROBE [--limits STROKE,VELOCITY,ACCELERATION] [--out FILE]

Writes time, acceleration, velocity and displacement of a probe, from the frequency --above on: the lowest at which stroke
and velocity keep their limits, or one that is given. Prints the peaks, and how far its response spectrum is the floor's. A
motion that exceeds a limit is not written.
"""

import argparse
import math
from pathlib import Path

from pounding import shaking
from pounding.arguments import numbers_above_0, positive
from pounding.results import DIRECTIONS, ResultError, load

from .process import parser_of



def limits_of(text: str) -> list:
    found = numbers_above_0(text)
    if len(found) != 3:
        raise argparse.ArgumentTypeError(f"'{text}' is not three numbers: stroke m, velocity m/s, acceleration m/s2")
    return found


def make(options: argparse.Namespace) -> None:
    """Throws ResultError, RunError or OSError."""
    found = load(options.run)
    below = min(options.below or math.inf, 0.2 / options.interval)  # faster than the instants hold
    above = options.above or (shaking.lowest_within(found, options.probe, options.direction, below, options.interval, options.limits)
                              if options.limits else 0.2)
    motion = shaking.motion_of(found, options.probe, options.direction, above, below, options.interval)
    if options.limits and (beyond := shaking.excess(motion, options.limits)):
        raise ResultError(f"{options.run}: the motion of {options.probe} along {options.direction} from {above:g} Hz on is too "
                          f"much for the table: {beyond}")
    stroke, velocity, acceleration = motion.peaks
    upper = "" if math.isinf(below) else f" to {below:g} Hz"
    said = (f"{options.probe} along {options.direction} from {above:g}{upper or ' Hz'} on: stroke {1e3 * stroke:.4g} mm, "
            f"velocity {velocity:.4g} m/s, acceleration {acceleration:.4g} m/s2")
    shaking.write(motion, options.out, f"{said}; {found.title or options.run}; SI units")
    print(said)
    if found.spectra and (part := shaking.kept(found, options.probe, options.direction, motion)):
        low, high, first, last, damping = part
        print(f"response spectrum ({100 * damping:g} %) {low:.3f} to {high:.3f} times the floor's from {first:.3g} to {last:.3g} Hz")
    print(f"see {options.out}")


def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("run", metavar="RUN", type=Path, help="result folder of a run")
    parser.add_argument("probe", metavar="PROBE", help="probe whose motion it is")
    parser.add_argument("--direction", choices=DIRECTIONS, default="x", help="of the motion (default: x)")
    parser.add_argument("--limits", metavar="S,V,A", type=limits_of, help="stroke to one side [m], velocity [m/s], acceleration [m/s2]")
    parser.add_argument("--above", metavar="HZ", type=positive(float),
                        help="frequency from which it is kept (default: the lowest within the limits, 0.2 without)")
    parser.add_argument("--below", metavar="HZ", type=positive(float),
                        help="frequency up to which it is kept (default, and most: 0.2 over the interval)")
    parser.add_argument("--interval", metavar="S", type=positive(float), default=1e-3,
                        help="between the instants, over which samples are means; a whole number of the history's (default: 0.001)")
    parser.add_argument("--out", metavar="FILE", type=Path, default=Path("shake-table.csv"), help="(default: %(default)s)")
    options = parser.parse_args()
    make(options)
    return 0
