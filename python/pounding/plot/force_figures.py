"""Histories of the forces that were recorded: reactions, storeys, members; force over elongation of links."""

import numpy as np

from pounding.results import Missing, Result
from .style import WIDTH, has_signal, legend_above, plot_series, plt, save, stacked

_COLOURS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7")
_MOST_LINES = len(_COLOURS)  # elements or links of a panel
_MOST_FIGURES = 12
_OF_SHELLS = {"N11", "N22", "N12", "M11", "M22", "M12", "Q1", "Q2"}


def items(names: list) -> dict:
    """Columns of each item, component by component: item -> component -> element -> column. "base.Fx" has no element,
    "corner.17.My1" the element 17."""
    found = {}
    for column, name in enumerate(names):
        item, *rest = name.split(".")
        found.setdefault(item, {}).setdefault(rest[-1], {})[".".join(rest[:-1])] = column
    return found


def unit_of(component: str) -> str:
    """Unit of a component in thousands: of shells forces and moments are per length."""
    of_shells = component in _OF_SHELLS
    if component[0] in "MT":
        return "kN" if of_shells else "kN m"
    return "kN/m" if of_shells else "kN"


def _panel(axes, time, force, component: str, columns: dict) -> None:
    peak = {element: float(np.nanmax(np.abs(force[:, column]), initial=0.0)) for element, column in columns.items()}
    shown = sorted(columns, key=lambda element: -peak[element])[:_MOST_LINES]
    for colour, element in zip(_COLOURS, shown):
        plot_series(axes, time, 1e-3 * force[:, columns[element]], color=colour, lw=0.8, alpha=0.9,
                    label=f"element {element}" if element else None)
    first = force[:, columns[shown[0]]]
    at = int(np.nanargmax(np.abs(first)))
    unit = unit_of(component)
    of = f" ({len(shown)} of {len(columns)} elements)" if len(shown) < len(columns) else ""
    axes.set_title(f"{component}{of}: largest {1e-3 * first[at]:.4g} {unit} at {time[at]:.4g} s"
                   + (f" in {shown[0]}" if shown[0] else ""))
    axes.plot(time[at], 1e-3 * first[at], "o", ms=4, color="#C0392B")
    axes.set_ylabel(f"[{unit}]")
    if shown[0]:
        legend_above(axes, columns=len(shown))


def forces(result: Result) -> list:
    if "force" not in result.history or not result.history.get("forces"):
        raise Missing("no forces with a history were recorded (option forces)")
    time, force = result.history["time"], result.history["force"]
    if len(time) == 0:
        raise Missing("history.h5 has no sample of forces")
    made = []
    for item, components in list(items(result.history["forces"]).items())[:_MOST_FIGURES]:
        scale = {kind: max((np.nanmax(np.abs(force[:, list(columns.values())]), initial=0.0)
                            for component, columns in components.items() if (component[0] in "MT") == kind), default=0.0)
                 for kind in (True, False)}
        moving = {component: columns for component, columns in components.items()
                  if any(has_signal(force[:, column], scale[component[0] in "MT"]) for column in columns.values())}
        if not moving:
            continue
        figure, rows = stacked(len(moving), 1.6)
        for axes, (component, columns) in zip(rows, moving.items()):
            _panel(axes, time, force, component, columns)
        rows[-1].set_xlabel("time [s]")
        made += save(figure, result.folder, f"forces_{item}.png", f"Forces: {item}",
                     "At the instants of the samples, with sign; red: the largest of the samples. Components that stay "
                     "below a millionth of the others are left out.")
    if not made:
        raise Missing("the forces that were recorded are zero")
    return made


def _groups(names: list) -> dict:
    """Columns of each item of the option `loops`, component by component: "pads.17.x" is in ("pads", "x")."""
    groups = {}
    for column, name in enumerate(names):
        item, _, rest = name.partition(".")
        groups.setdefault((item, rest.partition(".")[2]), []).append(column)
    return groups


def _area(elongation: np.ndarray, force: np.ndarray) -> float:
    """Work that a link took from the first sample to the last one."""
    return float(np.sum((force[1:] + force[:-1]) / 2 * np.diff(elongation)))


def _loop_panel(axes, item: str, kind: str, links: dict) -> None:
    """`links`: elongation and force by name."""
    area = {name: _area(*curve) for name, curve in links.items()}
    shown = sorted(links, key=lambda name: -abs(area[name]))[:_MOST_LINES]
    about, filler = kind.startswith(("r", "bending")), kind == ""
    for colour, name in zip(_COLOURS, shown):
        elongation, force = links[name]
        axes.plot(1e3 * elongation, 1e-3 * force, lw=0.7, alpha=0.85, color=colour,
                  label=f"{name.split('.')[1]}: {1e-3 * area[name]:.3g} kJ")
    if filler:  # open joints go far to the left, where nothing presses
        deepest = 1e3 * max(curve[0].max() for curve in links.values())
        if deepest > 0:
            axes.set_xlim(-0.1 * deepest, 1.1 * deepest)
    of = f" ({len(shown)} of {len(links)})" if len(shown) < len(links) else ""
    title = " ".join([item, *kind.split(".")]).strip()
    axes.set_title(f"{title}{of}: {1e-3 * sum(area.values()):.3g} kJ in all")
    axes.set_xlabel("rotation [mrad]" if about else "compression [mm]" if filler else "elongation [mm]")
    axes.set_ylabel("moment [kN m]" if about else "force [kN]")
    axes.legend(loc="upper left", fontsize=7)


def loops(result: Result) -> list:
    if "links" not in result.history:
        raise Missing("no links were recorded (option loops)")
    result.need("link_elongation", "link_force")
    names = result.history["links"]
    groups = _groups(names)
    columns = min(2, len(groups))
    rows = -(-len(groups) // columns)
    figure, panels = plt.subplots(rows, columns, figsize=(WIDTH, 3.2 * rows), squeeze=False)
    for axes in panels.ravel()[len(groups):]:
        axes.set_visible(False)
    for axes, ((item, kind), members) in zip(panels.ravel(), groups.items()):
        _loop_panel(axes, item, kind, {names[k]: (result.history["link_elongation"][:, k],
                                             result.history["link_force"][:, k]) for k in members})
    return save(figure, result.folder, "loops.png", "Loops",
                "Force over elongation of the links recorded, those that took most energy in each group, with the "
                "energy of each. Springs that press only and fillers count compression as elongation.", columns=list(panels.T))


ALL = [forces, loops]
