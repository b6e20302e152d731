"""Isotropic plates of equal stiffness and mass to plates of several layers, by the two numbers U1, U4 of a plane stiffness
that turning its axes does not change (see nastran_plates)."""

import math
from dataclasses import dataclass


@dataclass(slots=True)
class Layer:
    stiffness: tuple  # U1, U4
    density: float
    thickness: float


def isotropic(young: float, shear: float, poisson: float | None) -> tuple:
    """(U1, U4), and Poisson's ratio, of an isotropic material: that of both moduli where None is given, .3 where it can be none."""
    if poisson is None:
        poisson = young / (2 * shear) - 1 if shear else 0.0
    poisson = poisson if -1 < poisson < 0.5 else 0.3
    along = young / (1 - poisson**2)
    return (along, poisson * along), poisson


def equal_plate(layers: list, bending: list | None = None) -> tuple:
    """Young's modulus, Poisson's ratio, density and thickness of the isotropic plate of equal mean stiffness in plane and
    in bending, and of equal mass. `bending`: its two numbers where they do not follow from the layers."""
    total = sum(layer.thickness for layer in layers)
    plane = [sum(layer.stiffness[k] * layer.thickness for layer in layers) for k in (0, 1)]
    if bending is None:
        bending, low = [0.0, 0.0], -total / 2
        for layer in layers:
            high = low + layer.thickness
            bending = [bending[k] + layer.stiffness[k] * (high**3 - low**3) / 3 for k in (0, 1)]
            low = high
    if not (plane[0] > 0 and bending[0] > 0):
        return 0.0, 0.0, 0.0, total
    thickness = math.sqrt(12 * bending[0] / plane[0])
    poisson = max(-0.9, min(plane[1] / plane[0], 0.49))
    mass = sum(layer.density * layer.thickness for layer in layers)
    return plane[0] / thickness * (1 - poisson**2), poisson, mass / thickness, thickness
