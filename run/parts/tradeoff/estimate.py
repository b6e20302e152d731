"""How far a rung of a ladder of fidelities lies from full order, told from the rungs beside it.

The rungs 1 ... m, from the coarsest to the finest that was run, gave the spectra s_1 ... s_m; the distance d(i, j) of
two of them is the rms of the logarithm of their ratio. If the error of the finest is e_m, and what it lacks has nothing
to do with what separates it from rung k, then that of rung k is

    e_k = sqrt(d(k, m)^2 + e_m^2).

What the finest lacks is held to be as much as the last step of the ladder, e_m = d(m-1, m): steps that halve add up to
that much. Steps that shrink faster make it a bound; to extrapolate them would call an answer exact where the error ends
its fall for another reason than the modes counted (slow convergence at dashpots, for one). None is better than the
noise floor: what the same rung does when the shaking and the gaps change by less than anyone knows them.
"""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Estimate:
    """Of one rung: `error` (rms of the logarithm), and whether it is the noise floor that says it."""

    error: float
    at_floor: bool


def estimates(distances: list, floor: float, full: bool = False) -> list:
    """Estimate of every rung. `distances`: d(i, j) as a square list of lists, two rungs at least unless the last one is
    `full` order, which lacks nothing; `floor`: rms of the disturbed runs."""
    count = len(distances)
    rest = 0.0 if full else distances[count - 2][count - 1]
    found = [math.hypot(distances[k][count - 1], rest) for k in range(count)]
    return [Estimate(error, False) if full and error == 0 else Estimate(max(error, floor), error <= floor)
            for error in found]


def shrank(distances: list) -> bool:
    """Whether the last step of the ladder was smaller than the one before; False of two rungs."""
    return len(distances) > 2 and distances[-2][-1] < distances[-3][-2]
