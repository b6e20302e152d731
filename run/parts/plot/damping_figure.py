"""Damping ratio over frequency, of each structure and of the groups that have their own."""

import numpy as np

from pounding.results import Missing, Result
from .model_tables import damping_curves
from .style import WIDTH, log_scale, plt, save

FREQUENCY = np.geomspace(0.5, 400, 300)  # [Hz]
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")


def damping(result: Result) -> list:
    structures = result.summary.get("structures", {})
    curves, points = {}, {}
    for name, structure in structures.items():
        ratios = structure.get("modal", {}).get("damping_ratios")
        if ratios:
            frequencies = [mode["frequency"] for mode in structure.get("frequencies", [])]
            points[name] = (frequencies, [ratios[min(i, len(ratios) - 1)] for i in range(len(frequencies))])
            continue
        for region, curve in damping_curves(structure, FREQUENCY).items():
            if np.any(curve > 0):
                curves[f"{name}: {region}" if region else name] = curve
    if not curves and not points:
        raise Missing("no structure is damped")
    figure, axes = plt.subplots(figsize=(WIDTH, 3.2))
    for number, (name, curve) in enumerate(curves.items()):
        colour = _COLOURS[number % len(_COLOURS)]
        axes.plot(FREQUENCY, 100 * curve, label=name, color=colour, lw=2.2 if number == 0 else 1.4,
                  ls=("-", "--", "-.", ":")[number % 4])
        for mode in structures.get(name, {}).get("frequencies", []):
            if FREQUENCY[0] <= mode["frequency"] <= FREQUENCY[-1]:
                axes.plot(mode["frequency"], 100 * np.interp(mode["frequency"], FREQUENCY, curve), "o", ms=4, color=colour)
    for number, (name, (frequencies, ratios)) in enumerate(points.items()):
        axes.plot(frequencies, 100 * np.array(ratios), "s", ms=4, label=f"{name}, by mode",
                  color=_COLOURS[(len(curves) + number) % len(_COLOURS)])
    log_scale(axes, "x", FREQUENCY)
    log_scale(axes, "y", 100 * np.concatenate([*curves.values(), *(np.array(ratios) for _, ratios in points.values())]))
    axes.grid(True, which="minor", lw=0.3)
    axes.set(xlabel="frequency [Hz]", ylabel="damping ratio [%]")
    axes.legend(loc="best")
    return save(figure, result.folder, "damping.png", "Damping",
                "Damping ratio of a motion at one frequency; dots: the modes that were computed.")


ALL = [damping]
