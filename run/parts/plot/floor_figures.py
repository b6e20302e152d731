"""What the floors feel: response spectra, drifts, accelerations, and the ground motion."""

import numpy as np

from pounding.results import DIRECTIONS, Missing, Result, low_pass
from .style import (DIRECTION_COLOURS, G, WIDTH, has_signal, legend_above, log_scale, plot_series,
                    plt, probe_colour, save, stacked)

MODE_SHARE = 0.02  # modes drawn on the spectra carry this share of the mass, or more


def ground_motion(result: Result) -> list:
    result.need("ground_acceleration")
    time, ground = result.history["time"], result.history["ground_acceleration"]
    largest = np.nanmax(np.abs(ground), initial=0.0)
    shown = [i for i in range(3) if has_signal(ground[:, i], largest)]
    if not shown:
        raise Missing("the ground does not move")
    figure, rows = stacked(len(shown), 1.7, sharey=True)
    for axes, i in zip(rows, shown):
        plot_series(axes, time, ground[:, i], color=DIRECTION_COLOURS[DIRECTIONS[i]], lw=0.8)
        peak = np.nanmax(np.abs(ground[:, i]))
        axes.set_title(f"ground, {DIRECTIONS[i]}: peak {peak:.3g} m/s² ({peak / G:.3g} g)")
        axes.set_ylabel("acceleration [m/s²]")
    rows[-1].set_xlabel("time [s]")
    return save(figure, result.folder, "ground_motion.png", "Ground motion",
                "Acceleration of the ground, as applied at the output samples.")


def _mode_lines(axes, result: Result, probe: str) -> None:
    """Thin lines at the frequencies of the structure's modes that carry mass in one direction."""
    structures = result.summary.get("structures", {})
    owner = result.summary.get("probes", {}).get(probe, {}).get("structure")
    structure = structures.get(owner, {})
    mass = structure.get("mass") or 0
    for mode in structure.get("frequencies", []):
        colour = DIRECTION_COLOURS.get(str(mode.get("direction", "")).lower())
        if colour and mass > 0 and (mode.get("effective_mass") or 0) >= MODE_SHARE * mass:
            axes.axvline(mode["frequency"], color=colour, lw=0.8, ls=":", zorder=1)


def response_spectra(result: Result) -> list:
    table = result.spectra
    if not table or len(table["frequency"]) == 0:
        raise Missing("no spectra.csv" if not table else "spectra.csv has no line")
    probes = list(dict.fromkeys(table["probe"]))
    dampings = sorted(set(table["damping"]))
    styles = dict(zip(dampings, ["-", "--", "-.", ":"] * len(dampings)))
    columns = min(2, len(probes))
    rows = -(-len(probes) // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(WIDTH, 0.5 + 3.2 * rows), squeeze=False,
                                sharex=True, sharey=True)
    largest = table["pseudo_acceleration"].max()
    for axes in grid.ravel()[len(probes):]:
        axes.set_visible(False)
    for axes, probe in zip(grid.ravel(), probes):
        log_scale(axes, "x", table["frequency"])
        log_scale(axes, "y", table["pseudo_acceleration"])
        for damping in dampings:
            for direction in DIRECTIONS:
                rows_of = ((table["probe"] == probe) & (table["direction"] == direction)
                           & (table["damping"] == damping))
                values = table["pseudo_acceleration"][rows_of]
                if not has_signal(values, largest):
                    continue
                label = direction if len(dampings) == 1 else f"{direction}, {100 * damping:g} %"
                axes.plot(table["frequency"][rows_of], values, styles[damping], label=label,
                          color=DIRECTION_COLOURS[direction], lw=1.5)
        _mode_lines(axes, result, probe)
        axes.grid(True, which="minor", lw=0.3)
        axes.set_title(probe)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(loc="best")
    for axes in grid[:, 0]:
        axes.set_ylabel("pseudo-acceleration [m/s²]")
    for axes in grid[-1]:
        axes.set_xlabel("frequency [Hz]")
    percent = ", ".join(f"{100 * damping:g} %" for damping in dampings)
    return save(figure, result.folder, "spectra.png", "Floor response spectra",
                f"Pseudo-acceleration at {percent} damping. Dotted: modes of the structure that "
                f"carry {100 * MODE_SHARE:g} % of its mass or more in the direction of that colour.")


def drifts(result: Result) -> list:
    result.need("displacement")
    storeys = result.summary.get("drifts", [])
    if not storeys:
        raise Missing("no probe is marked as a floor (-<probe>_floor)")
    figure, rows = stacked(len(storeys), 1.75)
    for axes, storey in zip(rows, storeys):
        upper, lower, peaks = storey["upper"], storey["lower"], []
        for direction in ("x", "y"):
            series = result.series("displacement", upper, direction)
            if series is None:
                continue
            time, moved = series
            base = None if lower == "base" else result.series("displacement", lower, direction)
            drift = 100 * (moved - (base[1] if base else 0)) / storey["height"]
            if has_signal(drift, 1e-3):
                colour = DIRECTION_COLOURS[direction]
                plot_series(axes, time, drift, color=colour, label=direction, lw=0.9)
                peaks.append(f"{direction} {np.nanmax(np.abs(drift)):.3g} %")
        axes.set_title(f"{storey['structure']}: {upper} over {lower if lower != 'base' else 'its base'}; peak "
                       + (", ".join(peaks) or "none"))
        axes.set_ylabel("drift [%]")
        if peaks:
            legend_above(axes, columns=2)
    rows[-1].set_xlabel("time [s]")
    return save(figure, result.folder, "drifts.png", "Drifts",
                "Horizontal displacement of a floor less that of the one below, over their distance in height; "
                "the lowest floor against the ground at the base of its structure.")


def accelerations(result: Result) -> list:
    result.need("acceleration", "channels")
    cut = result.summary.get("peak_frequency")
    below = f"below {cut:.4g} Hz" if cut else "as sampled"
    largest = np.nanmax(np.abs(result.history["acceleration"]), initial=0.0)
    made = []
    for direction in DIRECTIONS:
        series = {probe: result.series("acceleration", probe, direction)
                  for probe in result.probes}
        series = {probe: (found[0], low_pass(found[1], found[0], cut)) if found and cut else found
                  for probe, found in series.items()}
        series = {probe: found for probe, found in series.items() if found is not None}
        if not any(has_signal(values, largest) for _, values in series.values()):
            continue
        figure, rows = stacked(len(series), 1.6)
        for axes, (probe, (time, values)) in zip(rows, series.items()):
            plot_series(axes, time, values, color=probe_colour(result.probes, probe), lw=0.7)
            peak = np.nanmax(np.abs(values), initial=0.0)
            axes.set_title(f"{probe}, {direction}: peak {below} {peak:.3g} m/s² ({peak / G:.3g} g)")
            axes.set_ylabel("[m/s²]")
        rows[-1].set_xlabel("time [s]")
        made += save(figure, result.folder, f"accelerations_{direction}.png",
                     f"Absolute accelerations, {direction}",
                     f"Absolute acceleration of the floors, {below}"
                     + (", after the low-pass without phase that stated peaks are taken from."
                        if cut else ": mean over the output interval."))
    if not made:
        raise Missing("the floors do not move")
    return made


ALL = [response_spectra, drifts, accelerations, ground_motion]
