"""The neutral model in SI units."""

from .model import Material, Model, Section
from .units import Units
from .vectors import scaled


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
    model.materials = {name: Material(one.young * units.pressure, one.poisson, one.density * units.density,
                                      None if one.shear is None else one.shear * units.pressure,
                                      one.alpha / units.time, one.beta * units.time, one.place)
                       for name, one in model.materials.items()}
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
        spring.dashpot *= units.force / length * units.time
    model.alpha /= units.time
    model.beta *= units.time
