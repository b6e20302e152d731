"""Local axes of beams, normals and sizes of elements, by the places of their nodes."""

import math

from .model import InputFault
from .vectors import across, cross, difference, length, scaled, sum_of, unit


def axis_between(places, who: str) -> tuple:
    """Unit vector from the first place to the second. Throws InputFault naming who has no length."""
    axis = unit(difference(places[1], places[0]))
    if axis is None:
        raise InputFault(f"{who} has no length")
    return axis


def frame_about(axis, z_axis, who: str) -> tuple:
    """Local axes x, y, z. Throws InputFault naming who has a direction along its axis."""
    z = across(z_axis, axis)
    if z is None:
        raise InputFault(f"{who}: the direction of its section lies along its axis")
    return axis, cross(z, axis), z


def turned_z(frame, angle: float) -> tuple:
    """The z axis turned about x from y to z."""
    return sum_of(scaled(frame[2], math.cos(angle)), frame[1], -math.sin(angle))


def _diagonals(places) -> tuple:
    if len(places) == 3:
        return difference(places[1], places[0]), difference(places[2], places[0])
    return difference(places[2], places[0]), difference(places[3], places[1])


def normal_of(places, who: str) -> tuple:
    """Unit normal of a triangle or quadrangle. Throws InputFault."""
    found = unit(cross(*_diagonals(places)))
    if found is None:
        raise InputFault(f"{who} has no area")
    return found


def size_of(places) -> float:
    """Length of a line, area of a triangle or quadrangle."""
    return length(difference(places[1], places[0])) if len(places) == 2 else length(cross(*_diagonals(places))) / 2
