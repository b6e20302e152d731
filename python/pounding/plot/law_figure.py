"""Loops of laws in one dimension, as the program follows them, with the energy that each takes."""

from pathlib import Path

import numpy as np

from pounding.tables import read_csv

from .style import DIRECTION_COLOURS, WIDTH, plt, save


def read(path: Path) -> dict:
    """Columns elongation, force, energy held and lost of each law of laws.csv, shape (steps, 4)."""
    laws = {}
    for row in read_csv(path):
        laws.setdefault(row["law"], []).append([float(row[name]) for name in ("elongation", "force", "stored_J", "lost_J")])
    return {name: np.array(rows) for name, rows in laws.items()}


def _labels(name: str) -> tuple:
    kind = name.rsplit(":", 1)[-1]
    if kind.startswith("about"):
        return "rotation [rad]", "moment [N m]", "J"
    if kind.startswith("bending"):
        return "curvature [1/m]", "moment [N m]", "J/m"
    if kind.startswith("shear") or kind == "strain":
        return "shear strain [-]" if kind != "strain" else "strain [-]", "force [N]", "J/m"
    return "elongation [m]", "force [N]", "J"


def draw(laws: dict, folder: Path) -> list:
    """Draws laws.png; returns a line for each law, and the name of the figure."""
    figure, panels = plt.subplots(len(laws), 2, figsize=(WIDTH, 3 * len(laws)), squeeze=False)
    lines = []
    for (loop, energy), (name, values) in zip(panels, laws.items()):
        along, force, unit = _labels(name)
        elongation, pull, stored, lost = values.T
        loop.plot(elongation, pull, lw=0.8, color=DIRECTION_COLOURS["x"])
        loop.set_xlabel(along)
        loop.locator_params(axis="x", nbins=5)
        loop.set(ylabel=force, title=name)
        way = np.concatenate([[0], np.cumsum(abs(np.diff(elongation)))])
        energy.plot(way, lost, color=DIRECTION_COLOURS["y"], label="lost")
        energy.plot(way, stored, color=DIRECTION_COLOURS["z"], lw=0.7, label="held")
        energy.set(xlabel=f"way of the {along}", ylabel=f"energy [{unit}]")
        energy.legend()
        lines.append(f"{name}: force up to {max(abs(pull)):.4g}, {lost[-1]:.4g} {unit} lost")
    save(figure, folder, "laws.png", "Laws", "Loops of the laws and the energy that they take.")
    return [*lines, str(folder / "laws.png")]
