"""Units of a file as its user states them, `mm,t,s` or `ft,kip,s`, and the factors that lead to SI."""

from dataclasses import dataclass

LENGTHS = {"m": 1.0, "dm": 0.1, "cm": 1e-2, "mm": 1e-3, "km": 1e3, "in": 0.0254, "ft": 0.3048}
POUND = 4.4482216152605
FORCES = {"n": 1.0, "kn": 1e3, "mn": 1e6, "kgf": 9.80665, "tf": 9806.65, "lbf": POUND, "kip": 1e3 * POUND}
MASSES = {"kg": 1.0, "g": 1e-3, "t": 1e3, "kt": 1e6, "lbm": 0.45359237, "slug": POUND / 0.3048}
TIMES = {"s": 1.0, "ms": 1e-3, "us": 1e-6}


@dataclass(frozen=True)
class Units:
    """Units of length [m], mass [kg] and time [s] of a file; those of all else follow."""

    length: float
    mass: float
    time: float

    @property
    def force(self) -> float:
        return self.mass * self.length / self.time**2

    @property
    def pressure(self) -> float:
        return self.force / self.length**2

    @property
    def density(self) -> float:
        return self.mass / self.length**3


def units_of(text: str) -> Units:
    """Units of `length,mass,time` or `length,force,time`, of which the mass follows. Throws ValueError, in one line."""
    words = [word.strip().lower() for word in text.split(",")]
    if len(words) != 3:
        raise ValueError(f"'{text}' is not three units: length, mass or force, time, as in m,kg,s or ft,kip,s")
    if words[0] not in LENGTHS:
        raise ValueError(f"'{words[0]}' is no unit of length; known are {', '.join(LENGTHS)}")
    if words[2] not in TIMES:
        raise ValueError(f"'{words[2]}' is no unit of time; known are {', '.join(TIMES)}")
    length, time = LENGTHS[words[0]], TIMES[words[2]]
    if words[1] in MASSES:
        return Units(length, MASSES[words[1]], time)
    if words[1] in FORCES:
        return Units(length, FORCES[words[1]] * time**2 / length, time)
    hint = "say lbm or lbf; " if words[1] in ("lb", "lbs", "pound") else ""
    raise ValueError(f"'{words[1]}' is no unit of mass or force; {hint}known are {', '.join([*MASSES, *FORCES])}")
