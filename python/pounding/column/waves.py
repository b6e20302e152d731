"""Shear waves that go straight up and down through level layers on a half-space, one frequency at a time.

In each layer u = A exp(i k z) + B exp(-i k z), z downwards from its top and k = omega / c, c the complex speed of
G* = G (1 - 2 D^2 + 2 i D sqrt(1 - D^2)), whose modulus is G at any damping ratio D (P. B. Schnabel, J. Lysmer and H. B. Seed,
SHAKE, EERC 72-12, 1972; I. M. Idriss and J. I. Sun, SHAKE91, 1992). The surface sends all back, R = B / A = 1; from there down R
follows by a recursion in which only decaying exponentials stand, so that no depth, damping or frequency is too much.
"""

from dataclasses import dataclass, replace

import numpy as np


@dataclass(frozen=True)
class Column:
    """Layers from the surface down and below them the half-space, which is the last entry of `density` [kg/m3], `modulus` (shear,
    [Pa]) and `damping` (ratio): shape (layers + 1); `thickness` [m]: shape (layers)."""

    thickness: np.ndarray
    density: np.ndarray
    modulus: np.ndarray
    damping: np.ndarray

    def with_(self, modulus: np.ndarray, damping: np.ndarray) -> "Column":
        """The same layers with other moduli and damping."""
        return replace(self, modulus=modulus, damping=damping)

    @property
    def speed(self) -> np.ndarray:
        """Of shear waves without damping [m/s], shape (layers + 1)."""
        return np.sqrt(self.modulus / self.density)

    @property
    def complex_modulus(self) -> np.ndarray:
        d = self.damping
        return self.modulus * (1 - 2 * d**2 + 2j * d * np.sqrt(1 - d**2))

    @property
    def tops(self) -> np.ndarray:
        """Depths of the tops of the layers and of the half-space [m], shape (layers + 1)."""
        return np.concatenate([[0.0], np.cumsum(self.thickness)])

    @property
    def period(self) -> float:
        """Four times the way of a wave through the layers [s]: about the longest period on a stiff half-space."""
        return float(4 * (self.thickness / self.speed[:-1]).sum())


@dataclass(frozen=True)
class Given:
    """Where a motion is given: at the top of which entry of the column, and whether it is that of ground that ends there, an outcrop,
    or that within the ground."""

    entry: int
    outcrop: bool


class Waves:
    """Waves of a column at circular frequencies [rad/s], shape (frequencies), for an acceleration of 1 where the motion is given."""

    def __init__(self, column: Column, omega: np.ndarray, given: Given):
        self.column, self.omega = column, omega
        self.complex_speed = np.sqrt(column.complex_modulus / column.density)
        count = len(column.thickness)
        ratio = np.ones((count + 1, len(omega)), complex)
        handed = np.ones((count, len(omega)), complex)  # A of the layer below over A exp(i k h), which it becomes at a layer's bottom
        for m in range(count):
            once = self.turned(m, column.thickness[m])
            step = column.density[m] * self.complex_speed[m] / (column.density[m + 1] * self.complex_speed[m + 1])
            back = ratio[m] * once**2
            total = (1 + step) + (1 - step) * back
            handed[m] = total / 2
            ratio[m + 1] = ((1 - step) + (1 + step) * back) / total
        at = given.entry
        self.ratio = ratio
        self.up = np.empty_like(ratio)
        self.up[at] = 0.5 if given.outcrop else 1 / (1 + ratio[at])
        self.leaving = np.empty_like(handed)  # A exp(i k h) at the bottoms of the layers
        for m in range(at - 1, -1, -1):
            self.leaving[m] = self.up[m + 1] / handed[m]
            self.up[m] = self.leaving[m] * self.turned(m, column.thickness[m])
        for m in range(at, count):
            self.leaving[m] = self.up[m] / self.turned(m, column.thickness[m])
            self.up[m + 1] = self.leaving[m] * handed[m]

    def turned(self, layer: int, way: float) -> np.ndarray:
        """exp(-i k way): what a wave has left, and its phase, after a way in a layer."""
        return np.exp(-1j * self.omega * way / self.complex_speed[layer])

    def within(self, entry: int) -> np.ndarray:
        """Acceleration at the top of a layer or the half-space."""
        return self.up[entry] * (1 + self.ratio[entry])

    def outcrop(self, entry: int) -> np.ndarray:
        """Acceleration of ground that ends there, under the same wave from below."""
        return 2 * self.up[entry]

    def strain(self, layer: int, depth: float) -> np.ndarray:
        """Shear strain [-] at a depth below the top of a layer; at rest that of the inertia of what lies above, evenly accelerated."""
        column, still = self.column, self.omega == 0
        up = self.leaving[layer] * self.turned(layer, column.thickness[layer] - depth)
        down = self.up[layer] * self.ratio[layer] * self.turned(layer, depth)
        found = -1j / (np.where(still, 1, self.omega) * self.complex_speed[layer]) * (up - down)
        above = (column.density[:layer] * column.thickness[:layer]).sum() + column.density[layer] * depth
        found[still] = (above / column.complex_modulus[layer]).real * self.within(layer)[still]
        return found
