"""What the floors feel: drifts, accelerations, and the ground motion."""

import numpy as np

from pounding.results import DIRECTIONS, Missing, Result, low_pass
from .style import DIRECTION_COLOURS, G, OF_GROUND, WITH, WITHOUT, g_axis, has_signal, legend_above, plot_series, save, stacked


def ground_motion(result: Result) -> list:
    result.need("ground_acceleration")
    time, ground = result.history["time"], result.history["ground_acceleration"]
    largest = np.nanmax(np.abs(ground), initial=0.0)
    shown = [i for i in range(3) if has_signal(ground[:, i], largest)]
    if not shown:
        raise Missing("the ground does not move")
    figure, rows = stacked(len(shown), 1.7, sharey=True)
    for axes, i in zip(rows, shown):
        plot_series(axes, time, ground[:, i], color=OF_GROUND, lw=0.8)
        peak = np.nanmax(np.abs(ground[:, i]))
        axes.set_title(f"ground, {DIRECTIONS[i]}: peak {peak:.3g} m/s² ({peak / G:.3g} g)")
        axes.set_ylabel("acceleration [m/s²]")
        g_axis(axes)
    rows[-1].set_xlabel("time [s]")
    return save(figure, result.folder, "ground_motion.png", "Ground motion",
                "Acceleration of the ground, as applied at the output samples.")


def drifts(result: Result) -> list:
    result.need("displacement")
    storeys = result.summary.get("drifts", [])
    if not storeys:
        raise Missing("no probe is marked as a floor (-<probe>_floor)")
    figure, rows = stacked(len(storeys), 1.75)
    for axes, storey in zip(rows, storeys):
        upper, lower, peaks = storey["upper"], storey["lower"], []
        for direction in ("x", "y"):
            series = result.series_if_any("displacement", upper, direction)
            if series is None:
                continue
            time, moved = series
            base = (result.base(storey["structure"], direction) if lower == "base"
                    else result.series_if_any("displacement", lower, direction))
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
                "the lowest floor against the base of its structure.")


def _beside(result: Result, probe: str, direction: str, cut: float | None) -> tuple | None:
    """Times and accelerations of the probe in the run without pounding, if there is one that recorded it."""
    found = result.without.series_if_any("acceleration", probe, direction) if result.without else None
    return (found[0], low_pass(found[1], found[0], cut)) if found and cut else found


def accelerations(result: Result) -> list:
    result.need("acceleration", "channels")
    cut = result.summary.get("peak_frequency")
    below = f"below {cut:.4g} Hz" if cut else "as sampled"
    largest = np.nanmax(np.abs(result.history["acceleration"]), initial=0.0)
    made = []
    for direction in DIRECTIONS:
        series = {probe: result.series_if_any("acceleration", probe, direction) for probe in result.probes}
        series = {probe: (found[0], low_pass(found[1], found[0], cut)) if found and cut else found
                  for probe, found in series.items()}
        series = {probe: found for probe, found in series.items() if found is not None}
        if not any(has_signal(values, largest) for _, values in series.values()):
            continue
        figure, rows = stacked(len(series), 1.6)
        for axes, (probe, (time, values)) in zip(rows, series.items()):
            other = _beside(result, probe, direction, cut)
            plot_series(axes, time, values, color=WITH, lw=0.8, label="with pounding" if other else None)
            if other:
                plot_series(axes, *other, color=WITHOUT, lw=0.8, label="without pounding")
                legend_above(axes, columns=2)
            peak = np.nanmax(np.abs(values), initial=0.0)
            axes.set(title=f"{probe}, {direction}: peak {below} {peak:.3g} m/s² ({peak / G:.3g} g)", ylabel="[m/s²]")
            g_axis(axes)
        rows[-1].set_xlabel("time [s]")
        made += save(figure, result.folder, f"accelerations_{direction}.png",
                     f"Absolute accelerations, {direction}",
                     f"Absolute acceleration of the floors, {below}"
                     + (", after the low-pass without phase that stated peaks are taken from."
                        if cut else ": mean over the output interval."))
    if not made:
        raise Missing("the floors do not move")
    return made


ALL = [drifts, accelerations]
