"""Moduli and damping that agree with the strains which they let come: the equivalent linear method."""

from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from .curves import ColumnError
from .waves import Column, Given, Waves

QUIET = 1e-3  # part of the largest acceleration of the surface that may be left at the end of the padding
LONGEST = 5  # doublings of the padding


@dataclass(frozen=True)
class Soil:
    """A column at small strain, and of each layer its curve, or None where it keeps modulus and damping; `names` of the layers and of
    the half-space, which sublayers of one share."""

    column: Column
    curves: tuple
    names: tuple

    def at(self, effective: np.ndarray) -> Column:
        """The column at effective strains of the layers, shape (layers)."""
        modulus, damping = self.column.modulus.copy(), self.column.damping.copy()
        for m, curve in enumerate(self.curves):
            if curve:
                part, damping[m] = curve.at(effective[m])
                modulus[m] *= part
        return self.column.with_(modulus, damping)


@dataclass(frozen=True)
class Found:
    """A column under one motion. `column`: as the motion left it; per layer the largest shear strain in its middle [-], per layer and
    half-space the largest acceleration at the top [m/s2]; accelerations at the surface and where the mats are [m/s2], at the steps
    of the motion and on until they are quiet; iterations that it took, and whether the end is quiet."""

    column: Column
    strain: np.ndarray
    acceleration: np.ndarray
    surface: np.ndarray
    mat: np.ndarray
    iterations: int
    quiet: bool


@dataclass(frozen=True)
class Rule:
    """How columns are iterated: effective strain over the largest, change of moduli and damping at which they are kept, relative, and
    iterations at most."""

    ratio: float = 0.65
    tolerance: float = 1e-3
    most: int = 100


def iterate(soil: Soil, motion: np.ndarray, step: float, given: Given, mat: Given, rule: Rule) -> Found:
    """A motion [m/s2] through a soil, until moduli and damping change by no more than the tolerance. Throws ColumnError where they
    do not come to that."""
    size = next_fast_len(2 * len(motion) + int(4 * soil.column.period / step), real=True)
    column, step_before, number = soil.at(np.zeros(len(soil.curves))), 0.0, 0
    while True:
        number += 1
        strain = _largest_strain(column, motion, step, given, size)
        new = soil.at(rule.ratio * strain)
        change = _change(column, new)
        if not np.isfinite(change).all():
            raise ColumnError(f"the motion cannot be followed down to layer {soil.names[int((~np.isfinite(change)).argmax())]}: its high "
                              "frequencies grow without limit; give it deeper, or a coarser step")
        if change.max() <= rule.tolerance:
            break
        if number == rule.most:
            raise ColumnError(f"after {number} iterations layer {soil.names[int(change.argmax())]} still changes by "
                              f"{100 * change.max():.2g} %; give more iterations or a larger tolerance")
        step_now = np.log(new.modulus / column.modulus)
        if (step_now * step_before).sum() < 0:  # moduli swing: half of the way
            new = column.with_(np.sqrt(column.modulus * new.modulus), 0.5 * (column.damping + new.damping))
        column, step_before = new, step_now
    return _moved(column, strain, motion, step, given, mat, size, number)


def _change(old: Column, new: Column) -> np.ndarray:
    """Relative change of each layer, of its modulus or its damping."""
    return np.maximum(abs(new.modulus / old.modulus - 1), abs(new.damping - old.damping) / np.maximum(old.damping, 1e-3))


def _omega(size: int, step: float) -> np.ndarray:
    return 2 * np.pi * np.fft.rfftfreq(size, step)


def _largest_strain(column: Column, motion: np.ndarray, step: float, given: Given, size: int) -> np.ndarray:
    waves, spectrum = Waves(column, _omega(size, step), given), rfft(motion, size)
    return np.array([abs(irfft(spectrum * waves.strain(m, h / 2), size)).max() for m, h in enumerate(column.thickness)])


def _moved(column: Column, strain: np.ndarray, motion: np.ndarray, step: float, given: Given, mat: Given, size: int,
           iterations: int) -> Found:
    for _ in range(LONGEST + 1):
        waves, spectrum = Waves(column, _omega(size, step), given), rfft(motion, size)
        surface = irfft(spectrum * waves.within(0), size)
        quiet = abs(surface[-size // 10:]).max() <= QUIET * abs(surface).max()
        if quiet:
            break
        size = next_fast_len(2 * size, real=True)
    below = irfft(spectrum * (waves.outcrop if mat.outcrop else waves.within)(mat.entry), size)
    largest = np.array([abs(irfft(spectrum * waves.within(m), size)).max() for m in range(len(column.density))])
    loud = np.nonzero(np.maximum(abs(surface) / abs(surface).max(), abs(below) / abs(below).max()) > QUIET)[0]
    end = min(max(len(motion), int(loud[-1]) + 2), size)
    return Found(column, strain, largest, surface[:end], below[:end], iterations, bool(quiet))
