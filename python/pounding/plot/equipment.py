"""Equipment on the floors: whether its capacity holds, with and without pounding, in sentences, a table and figures."""

import numpy as np

from pounding.results import Missing, Result
from .markup import html_table
from .style import WIDTH, WITH, WITHOUT, g_axis, log_scale, plt, save

CAPACITY = "#222222"


def items(run: Result) -> dict:
    return run.verdicts


def _ratio_text(one: dict) -> str:
    if one["ratio"] is None:
        return "no motion"
    return f"{one['ratio']:.3g} at {one['frequency']:.3g} Hz along {one['direction']}"


def _listed(run: Result, twin: Result | None, names: list) -> str:
    """Items with their ratios, and with those without pounding where they are known."""
    beside = items(twin) if twin else {}
    told = []
    for name in names:
        one = items(run)[name]
        other = f", without pounding {_ratio_text(beside[name])}" if name in beside else ""
        told.append(f"{name} (capacity over required {_ratio_text(one)}, {one['needed']:.3g} needed{other})")
    return "; ".join(told)


def sentences(run: Result, twin: Result | None) -> list:
    """The items that fail, those that fail because of the joint first; or the item that is nearest to it."""
    found, beside = items(run), items(twin) if twin else {}
    if not found:
        return []
    failing = [name for name, one in found.items() if not one["passes"]]
    if not failing:
        moving = [name for name, one in found.items() if one["ratio"] is not None]
        least = min(moving, key=lambda name: found[name]["ratio"] / found[name]["needed"], default=None)
        nearest = f" The least margin has {_listed(run, twin, [least])}." if least else ""
        return [f"The capacity of {'the item' if len(found) == 1 else f'all {len(found)} items'} of equipment holds.{nearest}"]
    joint = [name for name in failing if name in beside and beside[name]["passes"]]
    others = [name for name in failing if name not in joint]
    lines = []
    if joint:
        lines.append(f"Because of the joint {len(joint)} of {len(found)} items of equipment "
                     f"{'fails' if len(joint) == 1 else 'fail'}: {_listed(run, twin, joint)}.")
    if others:
        why = ("with and without pounding" if all(name in beside for name in others)
               else "; whether because of the joint only a run without pounding beside this one shows")
        lines.append(f"{len(others)} of {len(found)} items of equipment {'fails' if len(others) == 1 else 'fail'}"
                     f"{' ' if beside else ''}{why}: {_listed(run, twin, others)}.")
    return lines


def table(run: Result, twin: Result | None) -> str:
    """Items and directions: smallest ratio, where, zero-period accelerations, and what holds without pounding."""
    beside, rows = items(twin) if twin else {}, []
    for name, one in items(run).items():
        for way, of in one["directions"].items():
            row = [name, one["probe"], way, of["ratio"], of["frequency"], one["needed"],
                   "yes" if of["passes"] else "NO", of["high_band_ratio"], of["required_at_zero_period"],
                   of["capacity_at_zero_period"]]
            if twin:
                row.append(beside.get(name, {}).get("directions", {}).get(way, {}).get("ratio"))
            rows.append(row)
    low, high = next(iter(items(run).values()), {}).get("high_band", (20, 40))
    header = ["item", "probe", "along", "capacity over required", "at [Hz]", "needed", "passes",
              f"from {low:g} to {high:g} Hz", "required, zero period [m/s²]", "capacity, zero period [m/s²]"]
    return html_table("Equipment: smallest ratio of capacity over the widened spectrum of its floor",
                      header + (["ratio without pounding"] if twin else []), rows, text=(1, 2, 6))


def _curves(run: Result, name: str, way: str) -> tuple:
    """Frequency, required and capacity of an item in one direction, and which frequencies count."""
    rows = (run.equipment["equipment"] == name) & (run.equipment["direction"] == way)
    return tuple(run.equipment[key][rows] for key in ("frequency", "required", "capacity", "counted"))


def _figure(run: Result, name: str, one: dict) -> list:
    ways, twin = list(one["directions"]), run.without
    figure, grid = plt.subplots(2, len(ways), figsize=(max(WIDTH, 3.6 * len(ways)), 5.4), squeeze=False, sharex=True,
                                sharey="row", height_ratios=(3, 2))
    for (upper, lower), way in zip(grid.T, ways):
        upper.tick_params(labelleft=True)
        lower.tick_params(labelleft=True)
        drawn = [("required", run, WITH, "-")]
        if twin and name in items(twin) and twin.equipment:
            drawn.insert(0, ("required without pounding", twin, WITHOUT, "--"))
        for label, result, colour, style in drawn:
            frequency, required, capacity, counted = _curves(result, name, way)
            moves = required > 0
            upper.plot(frequency[moves], required[moves], style, color=colour, label=label)
            lower.plot(frequency[moves], capacity[moves] / required[moves], style, color=colour)
        upper.plot(frequency, capacity, color=CAPACITY, lw=2, label="capacity")
        log_scale(upper, "y", np.concatenate([required, capacity]))
        log_scale(upper, "x", frequency)
        log_scale(lower, "x", frequency)
        lower.axhline(one["needed"], color=CAPACITY, lw=1, ls=":")
        for axes in (upper, lower):
            for low, high in _left_out(frequency, counted):
                axes.axvspan(low, high, color="#EEEEEE", zorder=0)
        upper.set_title(f"{name}, {way}: {_ratio_text({**one['directions'][way], 'direction': way})}", fontsize=9)
        lower.set_xlabel("frequency [Hz]")
    log_scale(grid[1, 0], "y", [0.1, 10])
    grid[0, 0].set_ylabel("acceleration [m/s²]")
    grid[1, 0].set_ylabel("capacity over required")
    grid[0, 0].legend(loc="best", fontsize=8)
    g_axis(grid[0, -1])
    return save(figure, run.folder, f"equipment_{name}.png", f"Equipment: {name}",
                f"Spectrum that the floor at {one['probe']} asks for ({100 * one['damping']:g} % damping, widened by "
                f"{100 * one['broadening']:g} %) beside the capacity; below their ratio, of which {one['needed']:.3g} (dotted) "
                "is needed. Grey frequencies do not count.", columns=list(grid.T))


def _left_out(frequency: np.ndarray, counted: np.ndarray) -> list:
    """Ends of the stretches whose frequencies do not count."""
    edges = np.flatnonzero(np.diff(np.concatenate([[1], counted, [1]])))
    return [(frequency[first], frequency[last - 1]) for first, last in zip(edges[::2], edges[1::2])]


def figures(run: Result) -> list:
    if not items(run):
        raise Missing("the scene has no equipment")
    if not run.equipment:
        raise Missing("no spectra.csv")
    return [page for name, one in items(run).items() for page in _figure(run, name, one)]


ALL = (figures,)
