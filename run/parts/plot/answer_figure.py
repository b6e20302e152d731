"""The picture beside the answer: how far the decisive joint was open, and what its floor feels."""

import numpy as np

from pounding.results import DIRECTIONS, GROUND, Missing, Result
from . import answer
from .spectra_figures import draw_spectrum
from .style import WIDTH, contact_colour, legend_above, plot_series, plt, save


def _gap(axes, result: Result, name: str) -> None:
    time, gap = result.history["time"], 1e3 * result.history["gap"][:, result.contacts.index(name)]
    known = np.isfinite(gap)
    plot_series(axes, time[known], gap[known], lw=0.9, color=contact_colour(result.contacts, name))
    axes.axhline(0, color="black", lw=0.8)
    impacts = result.impacts
    own = impacts["contact"].astype(str) == name if impacts and len(impacts["start"]) else np.array([])
    if own.any():
        size = 14 + 120 * impacts["impulse"][own] / impacts["impulse"].max()
        axes.scatter(impacts["start"][own], np.zeros(own.sum()), s=size, marker="v", color="#C0392B", alpha=0.75, lw=0,
                     zorder=3, label="impact (size: impulse)")
        legend_above(axes)
        axes.set_title(f"{name}: {own.sum()} impact{'' if own.sum() == 1 else 's'}")
    else:
        axes.set_title(f"{name}: smallest gap {np.min(gap[known]):.3g} mm")
    axes.set(xlabel="time [s]", ylabel="gap [mm]")


def _across(result: Result, name: str | None) -> tuple:
    """The direction across a joint, in which it closes; every one if nothing tells it."""
    normal = result.summary.get("contacts", {}).get(name, {}).get("normal") if name else None
    return (DIRECTIONS[int(np.argmax(np.abs(normal)))],) if normal else DIRECTIONS


def _floor(result: Result, along: tuple) -> tuple | None:
    """Probe, direction and damping ratio whose spectrum is shown, in the directions `along` if there is one: the most
    changed, else the largest."""
    for ways in dict.fromkeys((along, DIRECTIONS)):
        change = answer.largest_change(result, result.without, along=ways) if result.without else None
        if change:
            return change.probe, change.way, change.damping
        found = answer.strongest_spectrum(result, ways)
        if found:
            return found
    return None


def picture(result: Result) -> list:
    name = answer.decisive(result) if "gap" in result.history and len(result.history["time"]) else None
    floor = _floor(result, _across(result, name))
    if not name and not floor:
        raise Missing("neither gaps nor spectra")
    figure, panels = plt.subplots(1, 2 if name and floor else 1, figsize=(WIDTH, 3.5), squeeze=False)
    panels = list(panels[0])
    if name:
        _gap(panels[0], result, name)
    if floor:
        probe, way, damping = floor
        draw_spectrum(panels[-1], result, probe, way, [damping], in_g=True)
        panels[-1].set_title(f"{probe}, {way}, {100 * damping:g} %")
        panels[-1].set(xlabel="frequency [Hz]", ylabel="pseudo-acceleration [m/s²]")
        panels[-1].legend(loc="best")
    words = ["the gap of the joint that decides"] if name else []
    if floor:
        across = f" along {way} (across that joint)" if _across(result, name) == (way,) else ""
        words.append(f"the floor spectrum{across} that changes most, with and without pounding" if result.without else
                     f"the largest floor spectrum{across}")
        if result.spectrum_if_any(GROUND, way, damping):
            words[-1] += ", and that of the ground"
    words = "; ".join(words)
    return save(figure, result.folder, "answer.png", "In one picture", words[:1].upper() + words[1:] + ".")


ALL = [picture]
