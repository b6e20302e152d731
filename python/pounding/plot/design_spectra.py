"""Floor spectra for design: widened, their envelope over runs, as tables at the frequencies of Regulatory Guide 1.122."""

from pathlib import Path

import numpy as np

from pounding.tables import write_csv
from pounding.fragility import widened
from pounding.log_interpolation import log_interpolated
from pounding.results import DIRECTIONS
from .markup import folded, html_table, paragraphs

BROADENING = 0.15  # part by which peaks are widened on both sides
# Table 1 of Regulatory Guide 1.122 (revision 1): first frequency, last and increment [Hz]; beyond 34 Hz, where impacts
# are felt, third octaves.
STEPS = ((0.2, 3.0, 0.1), (3.0, 3.6, 0.15), (3.6, 5.0, 0.2), (5.0, 8.0, 0.25), (8.0, 15.0, 0.5), (15.0, 18.0, 1.0),
         (18.0, 22.0, 2.0), (22.0, 34.0, 3.0))
BEYOND = (40, 50, 63, 80, 100, 125, 160, 200, 250, 315, 400)
SHOWN = (1, 2, 3, 5, 8, 10, 15, 20, 25, 34, 50, 100, 200, 400)  # of the short table [Hz]


def frequencies(low: float, high: float) -> np.ndarray:
    """The regulatory frequencies from `low` to `high` [Hz]."""
    found = [first + i * step for first, last, step in STEPS for i in range(round((last - first) / step))]
    found = np.round([*found, STEPS[-1][1], *BEYOND], 9)
    return found[(found >= low * (1 - 1e-9)) & (found <= high * (1 + 1e-9))]


def design_spectrum(frequency: np.ndarray, spectrum: np.ndarray, at: np.ndarray) -> np.ndarray:
    """The spectrum [m/s2] with its peaks widened, at frequencies `at`: straight lines between logarithms."""
    return log_interpolated(at, frequency, widened(frequency, spectrum, BROADENING))


def rows_of(runs: dict, probes: list, damping: float) -> list:
    """A row per probe, direction and regulatory frequency: `runs`, the widened spectrum of each by its label [m/s2], and
    the envelope of all. Directions in which nothing moves are left out."""
    rows = []
    for probe in probes:
        spectra = {(label, way): found for label, run in runs.items() for way in DIRECTIONS
                   if (found := run.spectrum_if_any(probe, way, damping))}
        largest = max((values.max() for _, values in spectra.values()), default=0.0)
        for way in DIRECTIONS:
            own = {label: found for (label, of), found in spectra.items() if of == way}
            if not own or max(values.max() for _, values in own.values()) <= 1e-4 * largest:
                continue
            first = next(iter(own.values()))[0]
            at = frequencies(first[0], first[-1])
            values = {label: design_spectrum(*found, at) for label, found in own.items()}
            envelope = np.max(list(values.values()), axis=0)
            rows += [{"probe": probe, "direction": way, "damping": damping, "frequency": float(f),
                      "runs": {label: float(one[i]) for label, one in values.items()}, "envelope": float(envelope[i])}
                     for i, f in enumerate(at)]
    return rows


def write(runs: dict, probes: list, dampings: list, folder: Path) -> str:
    """Writes floor_spectra.csv into the folder and returns the tables for the page, in HTML; `runs` by their labels."""
    rows = [row for damping in dampings for row in rows_of(runs, probes, damping)]
    if not rows:
        return ""
    write_csv(folder / "floor_spectra.csv", [
        {**{key: row[key] for key in ("probe", "direction")}, **{key: f"{row[key]:g}" for key in ("damping", "frequency")},
         **{f"PSA {label} [m/s2]": f"{value:.6g}" for label, value in [*row["runs"].items(), ("envelope", row["envelope"])]}}
        for row in rows])
    damping = min(dampings, key=lambda one: abs(one - 0.05))
    shown = [row for row in rows if row["damping"] == damping]
    places = list(dict.fromkeys((row["probe"], row["direction"]) for row in shown))
    value = {(row["probe"], row["direction"], row["frequency"]): row["envelope"] for row in shown}
    head = [f for f in SHOWN if any(row["frequency"] == f for row in shown)]
    of = f"widened by {100 * BROADENING:g} %, {100 * damping:g} % damping [m/s²]"
    envelope = "Envelope of the runs" if len(runs) > 1 else "Floor spectra"
    text = html_table(f"{envelope}, {of}, by frequency [Hz]", ["", *(f"{f:g}" for f in head)],
                      [(f"{probe}, {way}", *(_short(value.get((probe, way, float(f)))) for f in head)) for probe, way in places])
    whole = [_floor(runs, shown, probe) for probe in dict.fromkeys(probe for probe, _ in places)]
    return (text + folded(f"At all frequencies of Regulatory Guide 1.122 and third octaves beyond, {of}", whole)
            + paragraphs(["floor_spectra.csv beside this page has them at every damping ratio."], kind="note"))


def _short(value: float | None) -> str | None:
    return None if value is None else f"{value:.3g}"


def _floor(runs: dict, rows: list, probe: str) -> str:
    """All frequencies of a floor: a column per direction and run, and per direction the envelope."""
    own = [row for row in rows if row["probe"] == probe]
    ways = list(dict.fromkeys(row["direction"] for row in own))
    at = {(row["frequency"], row["direction"]): row for row in own}
    head = ["[Hz]", *(f"{way}, {label}" for way in ways for label in [*runs, *(["envelope"] if len(runs) > 1 else [])])]

    def cells(f: float, way: str) -> list:
        row = at[f, way]
        return [_short(row["runs"].get(label)) for label in runs] + ([_short(row["envelope"])] if len(runs) > 1 else [])

    return html_table(probe, head, [(f"{f:g}", *(cell for way in ways for cell in cells(f, way)))
                                    for f in dict.fromkeys(row["frequency"] for row in own)])
