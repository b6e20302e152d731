"""Units of a file as its user states them, `mm,t,s` or `ft,kip,s`, and the neutral model in SI."""

from dataclasses import dataclass

from .geometry import scaled
from .model import Material, Model, Section

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


def _six(values, units: Units, power: int) -> tuple:
    """Springs (power 0) or dashpots (1): N/m along, N m about the axes, times seconds to that power."""
    along = units.force / units.length * units.time**power
    return tuple(value * along * (1 if place < 3 else units.length**2) for place, value in enumerate(values))


def _arms(arms, factor: float):
    return None if arms is None else tuple(None if arm is None else scaled(arm, factor) for arm in arms)


def _section(one: Section, length: float) -> Section:
    area, inertia = length**2, length**4
    return Section(one.area * area, one.inertia_y * inertia, one.inertia_z * inertia, one.torsion * inertia,
                   one.shear_y * area, one.shear_z * area, one.product * inertia)


def in_si(model: Model, units: Units) -> None:
    """Multiplies every number of the model, once."""
    length = units.length
    model.nodes = {number: scaled(place, length) for number, place in model.nodes.items()}
    model.materials = {name: Material(one.young * units.pressure, one.poisson, one.density * units.density, None
                                      if one.shear is None else one.shear * units.pressure, one.alpha / units.time,
                                      one.beta * units.time, one.place) for name, one in model.materials.items()}
    thick, thin = set(), set()  # properties of shells, and of lines
    for element in model.elements:
        (thick if element.kind == "shell" else thin).add(element.property)
        if element.arms:
            element.arms = _arms(element.arms, length)
        if element.added:
            element.added *= units.mass / length**(2 if element.kind == "shell" else 1)
    for key, one in model.properties.items():
        if one.section:
            one.section = _section(one.section, length)
        one.area *= length**2
        one.thickness *= length
        one.added *= units.mass / length**(2 if key in thick else 1)
    for mass in model.masses:
        mass.mass *= units.mass
        mass.inertia = scaled(mass.inertia, units.mass * length**2)
        if mass.arm:
            mass.arm = scaled(mass.arm, length)
    for spring in model.springs:
        spring.stiffness = _six(spring.stiffness, units, 0)
        spring.dashpot = _six(spring.dashpot, units, 1)
    for spring in model.axial_springs:
        spring.stiffness *= units.force / length
        spring.dashpot *= units.force * (units.time / length)**spring.power
        spring.series *= units.force / length
    for gap in model.gaps:
        gap.gap *= length
        gap.stiffness *= units.force / length
    model.alpha /= units.time
    model.beta *= units.time
