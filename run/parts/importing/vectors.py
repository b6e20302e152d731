"""Vectors of three numbers, and local axes."""

import math


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
