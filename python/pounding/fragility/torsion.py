"""Accidental torsion of a study: a factor on closings and relative displacements of its joints, given or from an eccentricity."""

from dataclasses import dataclass

from .study_file import Reader

EDGE = 0.5  # of the plan dimension: how far the farthest part of a joint is from the middle unless told


@dataclass(frozen=True)
class Torsion:
    """`factor` at least 1, and whence it is; 1: none."""

    factor: float = 1.0
    source: str = ""

    @property
    def told(self) -> str:
        """The end of a sentence about closings; nothing where there is no factor."""
        return f"; closings are {self.factor:g} times those of the runs, for accidental torsion" if self.factor != 1 else ""

    @property
    def assumption(self) -> str:
        return (f"closings and relative displacements of the joint times {self.factor:g}, {self.source}, in its table by elevation and in "
                "the joint needed; runs, spectra and forces have none")


def of_eccentricity(share: float, at: float = EDGE) -> float:
    """How many times farther than its middle a rigid floor moves at a place when it is pushed beside the middle, its stiffness
    spread evenly over the plan dimension L across the motion: (F / k) (1 + e x / (L^2 / 12)), k L^2 / 12 being its stiffness
    against turning. `share`: e / L; `at`: x / L. At e = L / 20 it is the 1 + .6 x / L of EN 1998-1, 4.3.3.2.4."""
    return 1 + 12 * share * at


def read(reader: Reader) -> Torsion:
    """The key `accidental_torsion` of a study. Throws UserError."""
    key = "accidental_torsion"
    if reader.values.get(key) is None:
        return Torsion()
    if not isinstance(reader.values[key], dict):
        factor = reader.number(key)
        if factor < 1:
            reader.fail(key, "is below 1: a factor on closings makes them larger")
        return Torsion(factor, "a factor given")
    one = reader.part(key, ("eccentricity", "at"))
    share, at = one.number("eccentricity", None, -1e-12, 0.5), one.number("at", EDGE, 0.0)
    if at > EDGE:
        one.fail("at", "is beyond the edge of the plan, .5 of its dimension from the middle")
    return Torsion(of_eccentricity(share, at), f"1 + 12 e x/L² of an eccentricity e of {100 * share:g} % of the plan dimension L, "
                                               f"x {at:g} L from the middle (even stiffness; at 5 % that of EN 1998-1, 4.3.3.2.4)")
