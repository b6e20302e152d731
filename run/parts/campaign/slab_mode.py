"""The antisymmetric mode of a slab near 200 Hz (the paper's Fig. 10), found among the modes of Structure 1."""

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from .findings import SLAB_MODE

FLOORS = (2.5, 5.0)  # lower face or mid-plane of the slabs [m]
THICKNESS = 0.22  # [m]
# Places of the accelerometers: one cell in from the corners [m]
PLACES = ((0.12, 0.12), (3.24, 0.12), (3.24, 2.16), (0.12, 2.16))


@dataclass
class SlabMode:
    """`nodes`: positions (n, 3) [m] of the slabs, `shape`: their displacement, largest 1; `dots`: the accelerometers of
    floor 1 among the nodes; `at_dots`: mean displacement along x there, and in the middle of the slab below them."""

    model: str
    frequency: float
    nodes: np.ndarray
    shape: np.ndarray
    dots: list
    at_dots: float
    at_middle: float

    @property
    def faces(self) -> list:
        """Heights of the planes of nodes."""
        return sorted(set(np.round(self.nodes[:, 2], 6)))


def nearest(coordinates: np.ndarray, place) -> int:
    return int(np.argmin(((coordinates - np.array(place)) ** 2).sum(axis=1)))


def tilt(coordinates: np.ndarray, shape: np.ndarray, model: str) -> float:
    """Mean rotation about y of the first floor at the accelerometers: from the two faces of bricks,
    or of the nodes of shells."""
    values = []
    for x, y in PLACES:
        low = nearest(coordinates, (x, y, FLOORS[0]))
        if model == "A":
            high = nearest(coordinates, (x, y, FLOORS[0] + THICKNESS))
            values.append((shape[high, 0] - shape[low, 0]) / THICKNESS)
        else:
            values.append(shape[low, 4])
    return float(np.mean(values))


def find(path: Path, model: str) -> SlabMode | None:
    """The mode in the band whose slab turns most about y where the accelerometers stand, in Structure
    1; None if no mode lies in the band."""
    with h5py.File(path, "r") as file:
        group = file["s1"]
        coordinates, frequencies = group["coordinates"][()], group["frequencies"][()]
        inside = np.flatnonzero((frequencies >= SLAB_MODE[0]) & (frequencies <= SLAB_MODE[1]))
        shapes = {i: group[f"shapes/{i + 1:04d}"][()] for i in inside}
    if not shapes:
        return None
    best = max(shapes, key=lambda i: abs(tilt(coordinates, shapes[i], model)))
    shape = shapes[best][:, :3]
    levels = [floor + face for floor in FLOORS for face in ((0, THICKNESS) if model == "A" else (0,))]
    of_slab = np.isclose(coordinates[:, 2, None], levels, atol=1e-6).any(axis=1)
    nodes, moved = coordinates[of_slab], shape[of_slab]
    moved = moved / abs(moved).max()
    top = FLOORS[0] + (THICKNESS if model == "A" else 0)
    dots = [nearest(nodes, (x, y, top)) for x, y in PLACES]
    below = [nearest(nodes, (x, y, FLOORS[0])) for x, y in PLACES]
    return SlabMode(model, float(frequencies[best]), nodes, moved, dots, float(moved[dots, 0].mean()),
                    float((moved[dots, 0] + moved[below, 0]).mean() / 2))
