"""The picture beside the answer: how far the decisive joint was open, and what its floor feels."""

import numpy as np

from pounding.results import GROUND, Missing, Result
from . import answer
from .spectra_figures import draw_spectrum
from .style import WIDTH, contact_colour, legend_above, plot_series, plt, save


def _decisive(result: Result) -> str | None:
    """Contact of the largest impulse, else the one that a stronger motion closes first, else that of the smallest gap."""
    if result.impacts and len(result.impacts["impulse"]):
        name = str(result.impacts["contact"][int(np.argmax(result.impacts["impulse"]))])
        return name if name in result.contacts else None
    factors = result.closing_factors()
    if factors:
        return min(factors, key=factors.get)
    gaps = answer.smallest_gaps(result)
    return min(gaps, key=lambda name: gaps[name][0], default=None)


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


def _floor(result: Result) -> tuple | None:
    """Probe, direction and damping ratio whose spectrum is shown: the most changed, else the largest."""
    if result.without:
        change = answer.largest_change(result, result.without)
        if change:
            return change.probe, change.way, change.damping
    return answer.strongest_spectrum(result)


def picture(result: Result) -> list:
    name = _decisive(result) if "gap" in result.history and len(result.history["time"]) else None
    floor = _floor(result)
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
        words.append("the floor spectrum that changes most, with and without pounding" if result.without else
                     "the largest floor spectrum")
        if result.spectrum_if_any(GROUND, way, damping):
            words[-1] += ", and that of the ground"
    words = "; ".join(words)
    return save(figure, result.folder, "answer.png", "In one picture", words[:1].upper() + words[1:] + ".")


ALL = [picture]
