"""What the floors feel as response spectra: with and without pounding, beside the ground, at every damping ratio."""

import numpy as np

from pounding.results import DIRECTIONS, GROUND, Missing, Result
from .style import OF_GROUND, WIDTH, WITH, WITHOUT, g_axis, log_scale, plt, save

MODE_SHARE = 0.02  # modes drawn on the spectra carry this share of the mass, or more
_DEPTH = 1e-4      # of the largest value drawn: below it curves are left out
_ROWS = 3          # probes of a figure, as many as a page of paper holds
_MOST_FIGURES = 8


def _mode_lines(axes, result: Result, probe: str, way: str) -> None:
    """Thin lines at the frequencies of the structure's modes that carry mass in that direction."""
    owner = result.summary.get("probes", {}).get(probe, {}).get("structure")
    structure = result.summary.get("structures", {}).get(owner, {})
    mass = structure.get("mass") or 0
    for mode in structure.get("frequencies", []):
        if str(mode.get("direction", "")).lower() == way and mass > 0 and (
                mode.get("effective_mass") or 0) >= MODE_SHARE * mass:
            axes.axvline(mode["frequency"], color="#444444", lw=0.8, ls=":", zorder=1)


def _curves(result: Result, probe: str, way: str, dampings: list) -> list:
    """(label, frequency, values, look) of what is drawn; a lower damping ratio is paler and has no label."""
    found = []
    beside = result.without is not None
    for index, damping in enumerate(dampings):
        strength = 1.0 if len(dampings) == 1 else 0.4 + 0.6 * index / (len(dampings) - 1)
        own = result.spectrum_if_any(probe, way, damping)
        other = result.without.spectrum_if_any(probe, way, damping) if beside else None
        ground = result.spectrum_if_any(GROUND, way, damping) if probe != GROUND else None
        for run, label, look in ((ground, "ground", {"color": OF_GROUND, "lw": 1.0}),
                                 (other, "without pounding", {"color": WITHOUT, "lw": 1.3, "ls": "--"}),
                                 (own, "with pounding" if beside else "floor", {"color": WITH, "lw": 1.5})):
            if run:
                found.append((label if strength == 1 else None, *run, {**look, "alpha": strength}))
    largest = max((values.max() for _, _, values, _ in found), default=0.0)
    return [curve for curve in found if curve[2].max() > _DEPTH * largest]


def draw_spectrum(axes, result: Result, probe: str, way: str, dampings: list, in_g: bool = False) -> None:
    """Spectra of a probe along one direction on logarithmic axes, with a second axis in g on the right."""
    curves = _curves(result, probe, way, dampings)
    if not curves:  # nothing moved
        axes.text(0.5, 0.5, "does not move", transform=axes.transAxes, ha="center", color="#777777")
        return
    log_scale(axes, "x", np.concatenate([frequency for _, frequency, *_ in curves]))
    largest = max(values.max() for _, _, values, _ in curves)
    held = [np.where(values > _DEPTH * largest, values, np.nan) for _, _, values, _ in curves]
    log_scale(axes, "y", np.concatenate(held))
    for (label, frequency, _, look), values in zip(curves, held):
        axes.plot(frequency, values, label=label, **look)
    frequency = curves[-1][1]
    axes.set_xlim(frequency[0], frequency[-1])
    _mode_lines(axes, result, probe, way)
    axes.grid(True, which="minor", lw=0.3)
    if in_g:
        g_axis(axes)


def _moving(result: Result, probe: str, damping: float) -> list:
    floors = np.isin(result.spectra["probe"], result.spectrum_probes)
    largest = result.spectra["pseudo_acceleration"][floors].max()
    return [way for way in DIRECTIONS
            if (found := result.spectrum_if_any(probe, way, damping)) and found[1].max() > _DEPTH * largest]


def _figure(result: Result, probes: list, ways: list, dampings: list, number: int, of: int) -> list:
    figure, grid = plt.subplots(len(probes), len(ways), figsize=(WIDTH, 0.7 + 2.7 * len(probes)), squeeze=False,
                                sharex=True, sharey=True)
    drawn = []
    for row, probe in zip(grid, probes):
        moving = _moving(result, probe, dampings[0])
        for axes, way in zip(row, ways):
            if way not in moving:
                axes.set_visible(False)
                continue
            draw_spectrum(axes, result, probe, way, dampings, in_g=way == moving[-1])
            axes.set_title(f"{probe}, {way}")
            axes.tick_params(labelleft=True)
            drawn.append(axes)
        row[0].set_ylabel("pseudo-acc. [m/s²]")
    for axes in grid[-1]:
        axes.set_xlabel("frequency [Hz]")
    lines = {label: line for axes in drawn for line, label in zip(*axes.get_legend_handles_labels())}
    figure.suptitle(" ")  # room for the legend above all panels
    figure.legend(lines.values(), lines.keys(), loc="upper center", ncol=min(4, len(lines)))
    percent = ", ".join(f"{100 * damping:g} %" for damping in dampings) + " damping"
    if len(dampings) > 1:
        percent += ", paler where it is less"
    beside = f" Without pounding: {result.without.folder.name}." if result.without else ""
    return save(figure, result.folder, "spectra.png" if number == 1 else f"spectra_{number}.png",
                "Floor response spectra" + (f" ({number} of {of})" if of > 1 else ""),
                f"Pseudo-acceleration at {percent}; g on the right.{beside} Dotted: modes of the structure that move "
                f"in that direction and carry {100 * MODE_SHARE:g} % of its mass or more.",
                columns=list(grid.T))


def response_spectra(result: Result) -> list:
    table = result.spectra
    if not table or len(table["frequency"]) == 0:
        raise Missing("no spectra.csv" if not table else "spectra.csv has no line")
    dampings = sorted(set(table["damping"]))
    probes = [probe for probe in result.spectrum_probes if _moving(result, probe, dampings[0])]
    if not probes:
        raise Missing("spectra.csv has no floor that moves")
    ways = [way for way in DIRECTIONS if any(way in _moving(result, probe, dampings[0]) for probe in probes)]
    parts = [probes[i:i + _ROWS] for i in range(0, len(probes), _ROWS)][:_MOST_FIGURES]
    return [page for number, part in enumerate(parts, start=1)
            for page in _figure(result, part, ways, dampings, number, len(parts))]


ALL = [response_spectra]
