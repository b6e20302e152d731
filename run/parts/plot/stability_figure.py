"""One figure of all sweeps of run/stability: what was compared, how far it may go, how each run ended."""

import math

from pounding.files import written_beside

from . import style

COLOURS = {"runs": "#0072B2", "stopped": "#E69F00", "refused": "#E69F00", "crashed": "#B2182B"}
WRONG = "#B2182B"
FLOOR = 1e-18  # a measure of exactly zero is drawn here


def draw(rows, path) -> None:
    """A panel per sweep, over the value that is driven to its extremes."""
    sweeps = list(dict.fromkeys(row.sweep for row in rows))
    columns = min(2, len(sweeps))
    lines = math.ceil(len(sweeps) / columns)
    figure, axes = style.plt.subplots(lines, columns, figsize=(style.WIDTH, 0.7 + 2.2 * lines), squeeze=False)
    for panel, sweep in zip(axes.ravel(), sweeps):
        draw_sweep(panel, [row for row in rows if row.sweep == sweep])
    for panel in axes.ravel()[len(sweeps):]:
        panel.set_visible(False)
    figure.suptitle("dot: error, line: its limit; orange: stopped or refused with a message; "
                    "red cross: not as expected", fontsize=9)
    with written_beside(path) as draft:
        figure.savefig(draft)
    style.plt.close(figure)


def draw_sweep(panel, rows) -> None:
    panel.set_title(rows[0].sweep)
    places = range(len(rows))
    for place, row in zip(places, rows):
        compared = math.isfinite(row.measure)
        height = max(row.measure, FLOOR) if compared else 1.0
        panel.plot(place, height, marker="o" if row.good else "x", markersize=6, linestyle="none",
                   color=COLOURS[row.outcome] if row.good else WRONG, clip_on=False, zorder=3)
        if compared and row.limit > 0:
            panel.plot([place - 0.4, place + 0.4], [row.limit] * 2, color="#666666", linewidth=1)
    panel.set_yscale("log")
    panel.set_ylim(FLOOR / 3, 30)
    panel.set_xticks(list(places), [row.case for row in rows], rotation=30, ha="right", fontsize=6)
    panel.set_xlim(-0.6, len(rows) - 0.4)
    panel.tick_params(axis="y", labelsize=7)
