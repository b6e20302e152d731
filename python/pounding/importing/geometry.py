"""Vectors of three numbers, local axes, normals and sizes of elements, and bricks whose nodes repeat."""

import math

from .model import InputFault

# Pairs of places that coincide -> places of the wedge, so that its volume is above 0 where the brick's would be.
WEDGES = (((2, 3), (6, 7), (0, 1, 2, 4, 5, 6)), ((0, 1), (4, 5), (0, 2, 3, 4, 6, 7)),
          ((1, 2), (5, 6), (0, 1, 3, 4, 5, 7)), ((0, 3), (4, 7), (0, 1, 2, 4, 5, 6)),
          ((4, 5), (6, 7), (0, 4, 1, 3, 6, 2)), ((4, 7), (5, 6), (0, 3, 4, 1, 2, 5)))


def sum_of(a, b, factor: float = 1.0) -> tuple:
    return tuple(x + factor * y for x, y in zip(a, b))


def difference(a, b) -> tuple:
    return sum_of(a, b, -1.0)


def scaled(a, factor: float) -> tuple:
    return tuple(factor * x for x in a)


def dot(a, b) -> float:
    return sum(x * y for x, y in zip(a, b))


def cross(a, b) -> tuple:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a) -> float:
    return math.sqrt(dot(a, a))


def unit(a) -> tuple | None:
    """None where it has no length."""
    size = length(a)
    return scaled(a, 1 / size) if size > 0 and math.isfinite(size) else None


def across(a, axis) -> tuple | None:
    """Unit vector of the part of `a` across the unit vector `axis`; None where `a` lies along it."""
    direction = unit(a)
    if direction is None:
        return None
    part = sum_of(direction, axis, -dot(direction, axis))
    return unit(part) if length(part) > 1e-6 else None


def applied(axes, a) -> tuple:
    """Global components of the local ones `a`; rows of `axes` are the local axes."""
    return tuple(sum(axes[i][k] * a[i] for i in range(3)) for k in range(3))


def permutation(axes) -> tuple | None:
    """For each local axis the global one that it lies along; None where one lies along none (1e-9)."""
    places = []
    for axis in axes:
        place = max(range(3), key=lambda k: abs(axis[k]))
        if abs(abs(axis[place]) - 1) > 1e-9:
            return None
        places.append(place)
    return tuple(places)


def global_components(components: int, axes) -> int | None:
    """Components along and about the local axes as global ones; None where they are none of those."""
    found, places = 0, permutation(axes)
    for shift in (0, 3):
        three = components >> shift & 7
        if three in (0, 7):
            found |= three << shift
        elif places is None:
            return None
        else:
            for local in range(3):
                found |= (three >> local & 1) << (places[local] + shift)
    return found


def along_global_axes(values, axes) -> tuple | None:
    """Six numbers along and about local axes by the global ones; None where that needs others."""
    result = []
    for three in (values[:3], values[3:]):
        places = permutation(axes)
        if places is None:
            if max(three) - min(three) > 1e-12 * max(map(abs, three)):
                return None
            result += three
            continue
        turned = [0.0] * 3
        for local in range(3):
            turned[places[local]] = three[local]
        result += turned
    return tuple(result)


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


def shape_of(nodes) -> tuple:
    """Kind and nodes of a brick as eight nodes give it: `brick`, `wedge6`, `tet4`; None for pyramids and others."""
    count = len(set(nodes))
    if count == 8:
        return "brick", tuple(nodes)
    if count == 6:
        for (a, b), (c, d), places in WEDGES:
            if nodes[a] == nodes[b] and nodes[c] == nodes[d]:
                return "wedge6", tuple(nodes[k] for k in places)
    if count == 4 and len(set(nodes[4:])) == 1 and nodes[2] == nodes[3]:
        return "tet4", (*nodes[:3], nodes[4])
    if count == 4 and len(set(nodes[3:])) == 1:
        return "tet4", tuple(nodes[:4])
    return None, tuple(nodes)
