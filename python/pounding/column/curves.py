"""Curves of a soil over its shear strain, tables of the user: what is left of the modulus, and the damping ratio."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pounding import UserError

COLUMNS = ("strain", "modulus", "damping")
LARGEST_STRAIN, LARGEST_DAMPING = 0.3, 0.5  # in a table that is meant as fractions


class ColumnError(UserError):
    """Ground, curves or motions that cannot be meant: one line for the user."""


@dataclass(frozen=True)
class Curve:
    """Shear strain [-], increasing, modulus over that at small strain, damping ratio: shape (rows). Straight over the logarithm of
    the strain, and constant beyond the ends."""

    name: str
    strain: np.ndarray
    modulus: np.ndarray
    damping: np.ndarray

    def at(self, strain: np.ndarray) -> tuple:
        """Part of the modulus and damping ratio at effective strains, shape (n)."""
        log = np.log(np.maximum(strain, 1e-30))
        return tuple(np.interp(log, np.log(self.strain), values) for values in (self.modulus, self.damping))


def read(name: str, path: Path) -> Curve:
    """A table with the columns strain, modulus and damping, all fractions. Throws ColumnError with the line, or OSError."""
    rows, columns = [], []
    for number, line in enumerate(path.read_text(encoding="utf-8-sig", errors="replace").splitlines(), 1):
        words = [word.strip() for word in line.split("#")[0].split(",")]
        if words == [""]:
            continue
        place = f"{path}, line {number}: "
        if not columns:
            if sorted(words) != sorted(COLUMNS):
                raise ColumnError(f"{place}'{line.strip()}' where the names of the columns belong: {', '.join(COLUMNS)}")
            columns = words
            continue
        try:
            row = dict(zip(columns, map(float, words), strict=True))
        except ValueError:
            raise ColumnError(f"{place}'{line.strip()}' is not three numbers") from None
        if why := _wrong(row, rows):
            raise ColumnError(place + why)
        rows.append(row)
    if len(rows) < 2:
        raise ColumnError(f"{path}: {len(rows)} rows; a curve has at least 2")
    return Curve(name, *(np.array([row[column] for row in rows]) for column in COLUMNS))


def _wrong(row: dict, rows: list) -> str:
    strain, modulus, damping = (row[column] for column in COLUMNS)
    if not all(map(math.isfinite, row.values())) or not strain > 0:
        return "strains are above 0, and numbers finite"
    if rows and not strain > rows[-1]["strain"]:
        return f"the strain {strain:g} does not increase"
    if strain > LARGEST_STRAIN:
        return f"a shear strain of {strain:g}; strains are fractions (in %?)"
    if not 0 <= damping < LARGEST_DAMPING:
        return f"a damping ratio of {damping:g}; it is from 0 to {LARGEST_DAMPING:g} (in %?)"
    if not 0 < modulus <= 1:
        return f"a modulus of {modulus:g} of that at small strain; it is above 0 and 1 at most"
    return ""
