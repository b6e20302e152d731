"""What the motions of a file leave of each estimate of its ground: means over the motions, and the largest."""

from dataclasses import dataclass

import numpy as np

from .column_file import Ground
from .iteration import Soil, iterate
from .waves import Column, Given, Waves

LARGE_STRAIN = 0.01  # beyond which equivalent linear ground is doubted
LONG_WAY = 0.025  # of a wave through a sublayer that is doubted: a quarter of its length at 10 Hz [s]
FREQUENCIES = np.geomspace(0.1, 50, 271)  # of transfer functions [Hz]


@dataclass(frozen=True)
class Estimate:
    """An estimate of the ground under all motions. `found`: (axis, number) -> Found; `column`: with the geometric means of their
    moduli and damping."""

    name: str
    soil: Soil
    found: dict
    column: Column

    def strains(self) -> np.ndarray:
        """Largest shear strains, shape (motions, layers)."""
        return np.array([one.strain for one in self.found.values()])

    def accelerations(self) -> np.ndarray:
        """Largest accelerations at the tops [m/s2], shape (motions, layers + 1)."""
        return np.array([one.acceleration for one in self.found.values()])

    def transfer(self, entry: int, outcrop: bool) -> np.ndarray:
        """Modulus of the acceleration at the top of an entry over that of an outcrop of the half-space, at FREQUENCIES."""
        waves = Waves(self.column, 2 * np.pi * FREQUENCIES, Given(len(self.column.thickness), True))
        return abs(waves.outcrop(entry) if outcrop else waves.within(entry))


def _mean(values: list) -> np.ndarray:
    with np.errstate(divide="ignore"):
        return np.exp(np.mean(np.log(np.array(values)), axis=0))


def estimate(ground: Ground, name: str, soil: Soil, signals: dict) -> Estimate:
    """Throws ColumnError where a motion does not come to an end."""
    found = {key: iterate(soil, one.values, one.step, ground.given, ground.at_mats, ground.rule) for key, one in signals.items()}
    columns = [one.column for one in found.values()]
    return Estimate(name, soil, found, soil.column.with_(_mean([one.modulus for one in columns]), _mean([one.damping for one in columns])))


def lines_of(one: Estimate, signals: dict) -> list:
    """A line for each motion."""
    lines = []
    for (axis, number), found in one.found.items():
        worst = int(found.strain.argmax())
        depth = one.column.tops[worst] + one.column.thickness[worst] / 2
        lines.append(f"{one.name}, {axis} {signals[axis, number].name}: {found.iterations} iterations, peak {signals[axis, number].peak:.4g} "
                     f"m/s2, surface {abs(found.surface).max():.4g}, mats {abs(found.mat).max():.4g}, largest strain "
                     f"{100 * found.strain.max():.3g} % in {one.soil.names[worst]}, {depth:.3g} m deep")
    return lines


def doubts_of(one: Estimate, signals: dict, ratio: float) -> list:
    """Sentences about strains, curves and sublayers that are asked for more than they hold."""
    lines, strain, names = [], one.strains().max(0), one.soil.names
    worst = int(strain.argmax())
    if strain[worst] > LARGE_STRAIN:
        lines.append(f"{one.name}: a shear strain of {100 * strain[worst]:.3g} % in {names[worst]}; equivalent linear ground is not meant "
                     f"for more than {100 * LARGE_STRAIN:g} %")
    for name in dict.fromkeys(names[m] for m, curve in enumerate(one.soil.curves) if curve and ratio * strain[m] > curve.strain[-1]):
        curve = one.soil.curves[names.index(name)]
        lines.append(f"{one.name}: effective strains in {name} are beyond the last of curve {curve.name}, {100 * curve.strain[-1]:.3g} %, "
                     "whose values go on")
    way = one.column.thickness / one.column.speed[:-1]
    slow = int(way.argmax())
    if way[slow] > LONG_WAY:
        lines.append(f"{one.name}: waves take {1e3 * way[slow]:.3g} ms through a sublayer of {names[slow]}, {one.column.thickness[slow]:.3g} m "
                     "thick, whose strain is that of its middle; give a smaller `thickest`")
    lines += [f"{one.name}: under {axis} {signals[axis, number].name} the surface does not come to rest; give the layers damping, or the "
              "motion as an outcrop" for (axis, number), found in one.found.items() if not found.quiet]
    return lines
