"""Speeds, damping, strains and accelerations of level ground over its depth, and its transfer functions."""

from pathlib import Path

import numpy as np

from pounding.column.answer import FREQUENCIES, Estimate
from pounding.column.column_file import Ground

from .style import OF_GROUND, WIDTH, plt, save

COLOURS = {"best": "#08519C", "upper": "#D55E00", "lower": "#009E73"}


def _steps(values: np.ndarray, tops: np.ndarray, bottom: float) -> tuple:
    """A value of each layer as a line over the depth."""
    return np.repeat(values, 2), np.repeat([*tops, bottom], 2)[1:-1]


def draw(ground: Ground, estimates: list, folder: Path) -> Path:
    """Draws column.png."""
    figure, panels = plt.subplot_mosaic([["speed", "damping", "strain", "acceleration"], ["transfer"] * 4],
                                        figsize=(WIDTH, 6.6), height_ratios=[1.5, 1])
    tops = ground.soil.column.tops
    bottom = 1.06 * tops[-1]
    small = panels["speed"].plot(*_steps(ground.soil.column.speed, tops, bottom), color=OF_GROUND, ls="--", label="best at small strain")
    for one in estimates:
        _draw_depths(panels, one, tops, bottom)
        panels["transfer"].plot(FREQUENCIES, one.transfer(0, False), color=COLOURS[one.name], label=f"{one.name}, surface")
        if ground.at_mats.entry:
            panels["transfer"].plot(FREQUENCIES, one.transfer(ground.at_mats.entry, ground.at_mats.outcrop), color=COLOURS[one.name],
                                    ls=":", label=f"{one.name}, mats")
    for name, label in (("speed", "speed of shear waves [m/s]"), ("damping", "damping [%]"), ("strain", "shear strain [%]"),
                        ("acceleration", "acceleration [m/s²]")):
        panels[name].set(xlabel=label, ylim=(bottom, 0))
        panels[name].tick_params(labelleft=name == "speed")
        if ground.mats.depth:
            panels[name].axhline(ground.mats.depth, color="#000000", lw=0.6)
    panels["speed"].set_ylabel("depth [m]")
    panels["speed"].set_xlim(left=0)
    panels["strain"].set_xscale("log")
    panels["transfer"].set(xscale="log", xlabel="frequency [Hz]", ylabel="over rock outcrop")
    panels["transfer"].legend(handles=[*panels["transfer"].get_lines(), *small], loc="upper left", ncols=2)
    save(figure, folder, "column.png", "Column", "Level ground as its motions leave it.")
    return folder / "column.png"


def _draw_depths(panels: dict, one: Estimate, tops: np.ndarray, bottom: float) -> None:
    colour, column = COLOURS[one.name], one.column
    strains, accelerations = one.strains(), one.accelerations()
    middles = tops[:-1] + column.thickness / 2
    panels["speed"].plot(*_steps(column.speed, tops, bottom), color=colour)
    panels["damping"].plot(*_steps(100 * column.damping, tops, bottom), color=colour)
    panels["strain"].plot(100 * strains.mean(0), middles, color=colour)
    panels["strain"].fill_betweenx(middles, 100 * strains.min(0), 100 * strains.max(0), color=colour, alpha=0.15, lw=0)
    panels["acceleration"].plot(accelerations.mean(0), tops, color=colour)
    panels["acceleration"].fill_betweenx(tops, accelerations.min(0), accelerations.max(0), color=colour, alpha=0.15, lw=0)
