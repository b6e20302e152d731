"""Figures, CSV files, text and page of a comparison."""

from pathlib import Path

import numpy as np

from pounding.tables import cells_of, markdown, write_csv
from pounding.plot import answer, design_spectra
from pounding.plot.markup import answer_box, html_figures, html_table, paragraphs, write_page
from pounding.plot.style import WIDTH, g_axis, log_scale, plt, run_colours, save
from pounding.files import write_text

from . import tables
from .runs import Runs

STYLES = ("-", "--", "-.", ":")


def spectra_figure(runs: Runs, probe: str, folder: Path) -> list:
    """Spectra of one probe over each other, one column per direction, and below them their ratio to the first."""
    damping = runs.dampings[0]
    colours = run_colours([bool(run.summary.get("contacts")) for run in runs.results])
    ways, floor = runs.moving(probe, damping), runs.round_off(probe, damping)
    figure, grid = plt.subplots(2, len(ways), figsize=(max(WIDTH, 4.0 * len(ways)), 5.6), squeeze=False, sharex=True,
                                sharey="row", height_ratios=(3, 2))
    for column, way in enumerate(ways):
        upper, lower = grid[:, column]
        upper.tick_params(labelleft=True)
        lower.tick_params(labelleft=True)
        values = runs.spectra(probe, way, damping)
        held = values[0] > floor
        for axes in (upper, lower):
            log_scale(axes, "x", runs.frequency)
        log_scale(upper, "y", max(values, key=max))
        for index, (label, own) in enumerate(zip(runs.labels, values)):
            look = {"color": colours[index], "ls": STYLES[index % len(STYLES)], "lw": 1.5}
            upper.plot(runs.frequency, np.where(own > floor, own, np.nan), label=label, **look)
            lower.plot(runs.frequency[held], own[held] / values[0][held], **look)
        if not held.any():
            lower.text(0.5, 0.5, f"no motion in {runs.labels[0]}", transform=lower.transAxes, ha="center")
        upper.set_title(f"{probe}, {way}")
        lower.set_xlabel("frequency [Hz]")
    log_scale(grid[1, 0], "y", [0.1, 10])
    grid[0, 0].legend(loc="best")
    grid[0, 0].set_ylabel("pseudo-acceleration [m/s²]")
    g_axis(grid[0, -1])
    grid[1, 0].set_ylabel(f"over {runs.labels[0]}")
    return save(figure, folder, f"spectra_{probe}.png", f"Floor response spectra of {probe}",
                f"Pseudo-acceleration at {100 * damping:g} % damping, and its ratio to that of {runs.labels[0]}.", columns=list(grid.T))


def _parts(runs: Runs) -> list:
    """(title, rows) of the tables that are shown."""
    return [("Impacts", tables.impacts(runs)), ("Peaks", tables.peaks(runs)),
            *([("Equipment: smallest ratio of capacity over required", held)] if (held := tables.equipment(runs)) else []),
            (f"Spectra over those of {runs.labels[0]}, {100 * runs.dampings[0]:g} % damping",
             tables.worst_ratios(runs)),
            ("Options that differ", tables.options(runs))]


def answers(runs: Runs) -> list:
    """Joint, margin and confidence of all runs, and a sentence per run beside the first: impacts, the floor spectrum that
    changes most, equipment that changes sides."""
    first = runs.results[0]
    found = [*filter(None, [answer.headline(dict(zip(runs.labels, runs.results)))])]
    for label, run in zip(runs.labels[1:], runs.results[1:]):
        counts = [one.summary.get("impacts", {}).get("episodes", 0) for one in (run, first)]
        line = f"{label} beside {runs.labels[0]}: {counts[0]} impacts in place of {counts[1]}"
        change = answer.largest_change(run, first)
        line += f"; the floor spectra ({100 * change.damping:g} %) grow at most {change.text()}" if change else ""
        held = {one: run.verdicts.get(one, {}).get("passes") for one in first.verdicts}
        for name, passes in held.items():
            if passes is not None and passes != first.verdicts[name]["passes"]:
                line += f"; {name} {'passes' if passes else 'fails'}"
        found.append(f"{line}.")
    return found


def text(runs: Runs) -> str:
    """What the terminal shows."""
    lines = [*answers(runs), *(f"note: {note}" for note in runs.notes), ""]
    for title, rows in _parts(runs):
        lines += [markdown(title, *cells_of(rows)) if rows else f"**{title}**: none\n"]
    return "\n".join(lines)


def parts(runs: Runs, folder: Path) -> list:
    """Writes CSV files and figures into the folder and returns the parts of a page about them."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, rows in (("spectra", tables.spectra(runs)), ("impacts", tables.impacts(runs)),
                       ("peaks", tables.peaks(runs)), ("options", tables.options(runs))):
        if rows:
            write_csv(folder / f"{name}.csv", rows)
        else:
            write_text(folder / f"{name}.csv", "option\n")  # no option differs
    figures = [page for probe in runs.probes for page in spectra_figure(runs, probe, folder)]
    spectra = design_spectra.write(dict(zip(runs.labels, runs.results)), runs.probes, runs.dampings, folder)
    return [("Floor response spectra", html_figures(folder, figures, 3) + spectra),
            *((caption, html_table("", *cells_of(rows)) or paragraphs(["None."])) for caption, rows in _parts(runs))]


def box(runs: Runs, links: list = ()) -> str:
    """The answer with which a page of the runs opens; `links`: label, page and why there is none, of the report of each."""
    return answer_box(answers(runs), any(answer.touched(run) for run in runs.results), links=links)


def notes(runs: Runs) -> str:
    return paragraphs(runs.notes, kind="note")


def write(runs: Runs, folder: Path) -> Path:
    """Writes everything into the folder and returns the page's path."""
    return write_page(folder / "comparison.html", " beside ".join(runs.labels), parts(runs, folder), answer=box(runs), before=notes(runs))
