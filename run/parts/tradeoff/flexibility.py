"""What a modal basis cannot represent of an impulse: its mobility at the points that it keeps, beside a finer one's."""

from pathlib import Path

import h5py
import numpy as np

HIGHEST = 400.0  # [Hz]
DAMPING = 0.05


def _mobility(path: Path, points: np.ndarray | None) -> tuple:
    """Points (n, 2), and the velocity there under a unit impulse in place, per frequency, shape (n, frequencies)."""
    with h5py.File(path, "r") as file:
        squared, rows, own = file["squared_frequency"][()], file["rows"][()], file["points"][()]
    if points is not None:
        place = {tuple(point): row for row, point in enumerate(own)}
        rows = rows[[place[tuple(point)] for point in points]]
    omega = 2 * np.pi * np.linspace(1, HIGHEST, 800)
    stiffness = squared[:, None] - omega**2 + 2j * DAMPING * omega * np.sqrt(np.maximum(squared, 0))[:, None]
    return own, rows**2 @ (1j * omega / stiffness)


def lacking(coarse: Path, fine: Path) -> float:
    """Root of the part of the energy of the velocities, up to 400 Hz, that unit impulses at all points of `fine` give
    in its basis and not in the coarse one. Throws KeyError or OSError if the files do not belong together."""
    points, reference = _mobility(fine, None)
    found = _mobility(coarse, points)[1]
    return float(np.sqrt((abs(found - reference)**2).sum() / (abs(reference)**2).sum()))
