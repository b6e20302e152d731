"""Force over elongation of the links that a run recorded."""

import numpy as np

from pounding.results import Missing, Result
from .style import WIDTH, plt, save

_COLOURS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7")
_MOST = len(_COLOURS)  # lines of a panel


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


def _panel(axes, item: str, kind: str, links: dict) -> None:
    """`links`: elongation and force by name."""
    area = {name: _area(*curve) for name, curve in links.items()}
    shown = sorted(links, key=lambda name: -abs(area[name]))[:_MOST]
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
        _panel(axes, item, kind, {names[k]: (result.history["link_elongation"][:, k],
                                             result.history["link_force"][:, k]) for k in members})
    return save(figure, result.folder, "loops.png", "Loops",
                "Force over elongation of the links recorded, those that took most energy in each group, with the "
                "energy of each. Springs that press only and fillers count compression as elongation.")


ALL = [loops]
