"""Mass and centre of gravity of a model in SI, by integration over its elements: not by the program that runs it."""

import math

import numpy as np

from .geometry import sum_of
from .model import BAR, BEAMS, SHELL, SOLIDS, Model

CORNERS = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)],
                   dtype=float)
AS_BRICK = {8: range(8), 6: (0, 1, 2, 2, 3, 4, 5, 5)}
GAUSS = [(x / math.sqrt(3), y / math.sqrt(3), z / math.sqrt(3)) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]


def bricks(x: np.ndarray) -> tuple:
    """Volumes and first moments of bricks by the coordinates of their corners, shape (bricks, 8, 3)."""
    volume, moment = np.zeros(len(x)), np.zeros((len(x), 3))
    for place in GAUSS:
        parts = 1 + CORNERS * place
        shape = parts.prod(axis=1) / 8
        slopes = np.stack([CORNERS[:, k] * parts[:, (k + 1) % 3] * parts[:, (k + 2) % 3] / 8 for k in range(3)])
        weight = np.linalg.det(slopes @ x)
        volume += weight
        moment += weight[:, None] * (shape @ x)
    return volume, moment


def tetrahedra(x: np.ndarray) -> tuple:
    volume = np.linalg.det(x[:, 1:] - x[:, :1]) / 6
    return volume, volume[:, None] * x.mean(axis=1)


def _plates(x: np.ndarray) -> tuple:
    """Areas and first moments; a quadrangle is two triangles, in both ways, halved."""
    area, moment = np.zeros(len(x)), np.zeros((len(x), 3))
    cuts = [(1.0, (0, 1, 2))] if x.shape[1] == 3 else [(0.5, cut) for cut in ((0, 1, 2), (0, 2, 3), (0, 1, 3), (1, 2,
                                                                                                                3))]
    for part, cut in cuts:
        corners = x[:, cut]
        size = part * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
        area += size
        moment += size[:, None] * corners.mean(axis=1)
    return area, moment


def _lines(x: np.ndarray) -> tuple:
    size = np.linalg.norm(x[:, 1] - x[:, 0], axis=1)
    return size, size[:, None] * x.mean(axis=1)


def places_of(model: Model, element) -> list:
    """Coordinates of an element's own nodes, at the ends of its arms."""
    return [model.nodes[node] if not element.arms or element.arms[k] is None
            else sum_of(model.nodes[node], element.arms[k]) for k, node in enumerate(element.nodes)]


def weigh(model: Model) -> tuple:
    """Mass [kg] and centre of gravity [m], None without mass."""
    batches: dict = {}
    for element in model.elements:
        batches.setdefault((element.kind, element.property, element.added, len(element.nodes)), []).append(
            places_of(model, element))
    total, moment = 0.0, np.zeros(3)
    for (kind, key, more, count), places in batches.items():
        x, one = np.array(places, dtype=float), model.properties[key]
        density = model.materials[one.material].density
        if kind in SOLIDS:
            sizes, firsts = tetrahedra(x) if count == 4 else bricks(x[:, list(AS_BRICK[count])])
        elif kind == SHELL:
            sizes, firsts = _plates(x)
            density = density * one.thickness + one.added + more
        else:
            sizes, firsts = _lines(x)
            assert kind in (*BEAMS, BAR)
            density = density * (one.section.area if one.section else one.area) + one.added + more
        total += density * sizes.sum()
        moment += density * firsts.sum(axis=0)
    for mass in model.masses:
        place = model.nodes[mass.node] if mass.arm is None else sum_of(model.nodes[mass.node], mass.arm)
        total += mass.mass
        moment += mass.mass * np.array(place)
    return total, (tuple(moment / total) if total > 0 else None)
