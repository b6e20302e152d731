"""Impedances of rigid rectangular mats side by side on a homogeneous half-space, coupled through it.

Each mat is cut into patches under which the stress is even. The motion of a patch by the force on another is the half-space's in
wave numbers (Kausel and Roesset, Bulletin of the Seismological Society of America 71 (1981) 1743), integrated over them, with
disks of the patches' area that press and that feel: a symmetric matrix F at each frequency, and S = N^T F^-1 N with the rigid
motions N of all mats, welded to the ground.
"""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy
from scipy.special import j0, j1, jv

from pounding.fragility.study_file import Reader, load
from pounding.soil.impedances import MOST_MATS, Impedances

FINEST = 0.004  # step of wave numbers over the number, where it is small
PER_TURN = 20  # wave numbers in a period of the widest distance
REACH = 40  # largest wave number times a patch's radius
MOST_PATCHES = 2000


@dataclass(frozen=True)
class Ground:
    """Homogeneous half-space."""
    speed: float  # of shear waves [m/s]
    density: float  # kg/m3
    poisson: float
    damping: float  # hysteretic, of both waves


@dataclass(frozen=True)
class Mat:
    """Rectangle on the surface: its middle and its full sides along x and y [m]."""
    middle: tuple
    sides: tuple


def patches(mats: list, cells: int) -> tuple:
    """Places of patches, shape (n, 2), and rigid motions N of all mats, shape (3 n, 6 mats): each shorter side of a mat has
    `cells`, the longer one as many as make them nearly square. Areas, shape (n)."""
    places, areas, blocks = [], [], []
    for mat in mats:
        counts = [max(1, round(cells * side / min(mat.sides))) for side in mat.sides]
        x, y = (side * ((numpy.arange(count) + 0.5) / count - 0.5) for side, count in zip(mat.sides, counts))
        x, y = (axis.ravel() for axis in numpy.meshgrid(x, y))
        zero, one = 0 * x, 0 * x + 1
        blocks.append(numpy.stack([[one, zero, zero, zero, zero, -y], [zero, one, zero, zero, zero, x],
                                   [zero, zero, one, y, -x, zero]]).transpose(2, 0, 1).reshape(-1, 6))
        places.append(numpy.stack([x + mat.middle[0], y + mat.middle[1]], axis=1))
        areas.append(numpy.full(len(x), mat.sides[0] * mat.sides[1] / len(x)))
    motions = numpy.zeros((sum(map(len, blocks)), 6 * len(mats)))
    row = 0
    for number, block in enumerate(blocks):
        motions[row:row + len(block), 6 * number:6 * number + 6] = block
        row += len(block)
    return numpy.concatenate(places), motions, numpy.concatenate(areas)


def wave_numbers(widest: float, radius: float) -> tuple:
    """Wave numbers [1/m] and weights of the trapezoidal rule: steps in proportion, then even ones."""
    even, first = 2 * math.pi / widest / PER_TURN, 1e-5 / radius
    k = first * (1 + FINEST)**numpy.arange(math.ceil(math.log(even / FINEST / first) / math.log1p(FINEST)))
    k = numpy.concatenate([k[k < REACH / radius], numpy.arange(k[-1] + even, REACH / radius, even)])
    step = numpy.diff(k)
    return k, (numpy.append(step, 0) + numpy.append(0, step)) / 2


def flexibility(k, omega: float, ground: Ground) -> tuple:
    """Motion over stress [m/Pa] in wave numbers: along the waves, along them by vertical stress, vertical, across."""
    shear = ground.density * ground.speed**2 * (1 + 2j * ground.damping)
    slow = omega**2 * ground.density / shear
    fast = slow * (1 - 2 * ground.poisson) / (2 * (1 - ground.poisson))
    p, s = numpy.sqrt(1 - fast / k**2), numpy.sqrt(1 - slow / k**2)
    share = (1 - s**2) / (2 * (1 - p * s))
    along, mixed, vertical = share * p, share - 1, share * s
    factor = 1 / (2 * k * shear * (along * vertical - mixed**2))
    return factor * vertical, -factor * mixed, factor * along, 1 / (k * s * shear)


def impedances(mats: list, ground: Ground, frequencies, cells: int = 8) -> Impedances:
    """At frequencies [Hz] above 0."""
    places, motions, areas = patches(mats, cells)
    apart = places[:, None] - places[None]
    distance = numpy.hypot(apart[..., 0], apart[..., 1])
    radius = math.sqrt(areas.mean() / math.pi)
    known, number = numpy.unique(distance.round(6), return_inverse=True)
    number = number.reshape(distance.shape)
    k, weight = wave_numbers(max(known[-1], radius), radius)
    weight = weight * k / (2 * math.pi) * (2 * j1(k * radius) / (k * radius))**2
    waves = [function(numpy.multiply.outer(known, k)) * weight for function in (j0, j1, lambda x: jv(2, x))]
    with numpy.errstate(invalid="ignore", divide="ignore"):
        c, s = numpy.where(distance[None] > 0, numpy.moveaxis(apart, -1, 0) / distance, 0)
    found = []
    for omega in 2 * math.pi * numpy.asarray(frequencies, float):
        along, mixed, vertical, across = flexibility(k, omega, ground)
        even, turned = ((waves[0] @ (along + across)) / 2)[number], ((waves[2] @ (along - across)) / 2)[number]
        tilted, upward = (waves[1] @ mixed)[number], (waves[0] @ vertical)[number]
        matrix = numpy.array([[even - (c * c - s * s) * turned, -2 * c * s * turned, c * tilted],
                              [-2 * c * s * turned, even + (c * c - s * s) * turned, s * tilted],
                              [-c * tilted, -s * tilted, upward]]).transpose(2, 0, 3, 1).reshape(len(motions), -1)
        found.append(motions.T @ numpy.linalg.solve(matrix, motions))
    matrix = numpy.array(found)
    return Impedances(numpy.asarray(frequencies, float), (matrix + matrix.transpose(0, 2, 1)) / 2)


def read(path: Path) -> Impedances:
    """Impedances of the mats and the ground of a YAML file. Throws UserError or OSError."""
    reader = Reader(load(path), path, "", ("ground", "mats", "frequencies", "cells"))
    one = reader.part("ground", ("vs", "density", "poisson", "damping"))
    ground = Ground(one.number("vs", above=0), one.number("density", above=0), one.number("poisson", above=-1e-9, below=0.5),
                    one.number("damping", above=0.001, below=0.5))
    mats = []
    for number, values in enumerate(reader.entries("mats"), 1):
        mat = Reader(values, path, f"mats: {number}", ("middle", "sides"))
        mats.append(Mat(tuple(mat.numbers("middle", count=2)), tuple(mat.numbers("sides", None, 0.0, count=2))))
        for other in mats[:-1]:
            gaps = [abs(a - b) - (s + t) / 2 for a, b, s, t in zip(mats[-1].middle, other.middle, mats[-1].sides, other.sides)]
            if max(gaps) < -1e-9 * min(other.sides):
                mat.fail("middle", f"lays it over mat {mats.index(other) + 1}")
    cells = reader.whole("cells", 10, 2)
    if not 1 <= len(mats) <= MOST_MATS or sum(round(cells**2 * max(mat.sides) / min(mat.sides)) for mat in mats) > MOST_PATCHES:
        reader.fail("mats", f"have too many patches, or there is none: {MOST_PATCHES} at most, {cells} along a shorter side")
    one = reader.part("frequencies", ("first", "last", "count"))
    first = one.number("first", above=0)
    return impedances(mats, ground, numpy.linspace(first, one.number("last", above=first), one.whole("count", 40, 4)), cells)
