"""The joint by elevation: how narrow it is as built, how far it closes and its sides move against each other, where, when and in
which member, and what touches first."""

from pathlib import Path

import numpy as np

from pounding import UserError
from pounding.tables import write_csv

TABLE = "joint_by_elevation.csv"
SHARE = 0.84  # of the members that stay below: the quantile beside the mean
MOST_PLACES = 12  # elevations that are bands of their own where none are given
ROUND_OFF = 1e-9  # of an elevation [m]


class JointError(UserError):
    """Bands or outcomes that no table can be made of: one line."""


def bands_of(places: np.ndarray) -> list:
    """Elevations between bands that suit pairs: half way between theirs where these are few, else eight equal bands."""
    levels = np.unique(np.round(places[:, 2], 6))
    if len(levels) == 1:
        return [float(levels[0]) - 0.5, float(levels[0]) + 0.5]
    if len(levels) > MOST_PLACES:
        return np.linspace(levels[0], levels[-1], 9).tolist()
    between = (levels[1:] + levels[:-1]) / 2
    return [float(levels[0]), *between.tolist(), float(levels[-1])]


def split(elevations, places: np.ndarray) -> list:
    """(from, to, pairs) of each band, and of what lies below the first and above the last where pairs do: none is lost. An
    elevation between two bands belongs to the upper one. Throws JointError."""
    edges = np.asarray(bands_of(places) if elevations is None else elevations, float)
    if edges.ndim != 1 or len(edges) < 2 or not (np.diff(edges) > 0).all():
        raise JointError("elevations: give two or more that rise, in metres")
    height, found = places[:, 2], []
    for number, (low, high) in enumerate(zip(edges, edges[1:])):
        last = number == len(edges) - 2
        inside = (height >= low - ROUND_OFF) & (height <= high + ROUND_OFF if last else height < high - ROUND_OFF)
        if not inside.any():
            raise JointError(f"elevations: between {low:g} and {high:g} m lies no pair of a contact; the joints go from "
                             f"{height.min():g} to {height.max():g} m")
        found.append((low, high, inside))
    below, above = height < edges[0] - ROUND_OFF, height > edges[-1] + ROUND_OFF
    return ([(-np.inf, edges[0], below)] if below.any() else []) + found + ([(edges[-1], np.inf, above)] if above.any() else [])


def _spread(name: str, values: np.ndarray) -> dict:
    """Mean, quantile and largest of a number of each member."""
    return {f"{name} mean [m]": float(values.mean()), f"{name} {100 * SHARE:g} % [m]": float(np.quantile(values, SHARE)),
            f"{name} largest [m]": float(values.max())}


def by_elevation(outcomes, elevations=None, members=None, built=None, torsion: float = 1.0) -> list:
    """Rows of dictionaries, a row per contact and band of elevation with pairs of it, contacts in their order, bands from below.

    `outcomes`: with `contacts`, `pair_contact` (pairs), `pair_place` (pairs, 3), `pair_gap`, `pair_least` and `pair_time`
    (members, pairs) and `pair_moved` (members, pairs, 3), as fragility.outcomes has them of an ensemble or a run.
    `elevations`: between bands [m]. `members`: numbers of those that count. `built`: gaps as built (members, pairs), of runs
    whose own joint is wide open so that nothing touches [m]. `torsion`: factor on closings and relative displacements. Of each member counts the pair of the band that closes most;
    `ratio` is the largest closing over gap of any pair, `margin` the least gap less closing, `first` the number of members
    whose pair nearest to touching, of all contacts, lies in the band. Throws JointError."""
    who = np.arange(len(outcomes.pair_gap)) if members is None else np.asarray(members)
    if not len(who) or not len(outcomes.pair_place):
        raise JointError("elevations: there is no member, or no contact has a pair")
    closing = torsion * (outcomes.pair_gap - outcomes.pair_least)[who]
    gap = outcomes.pair_gap[who] if built is None else np.broadcast_to(built, closing.shape)
    ratio = np.where(gap > 0, closing / np.where(gap > 0, gap, 1.0), np.where(closing > 0, np.inf, 1.0))
    first = ratio.argmax(1)
    rows = []
    bands = split(elevations, outcomes.pair_place)
    for number, contact in enumerate(outcomes.contacts):
        for low, high, inside in bands:
            pairs = np.flatnonzero(inside & (outcomes.pair_contact == number))
            if not len(pairs):
                continue
            mine, built_here = closing[:, pairs], gap[:, pairs]
            narrow = np.unravel_index(built_here.argmin(), built_here.shape)
            most = np.unravel_index(mine.argmax(), mine.shape)
            row = {"contact": contact, "from [m]": float(low), "to [m]": float(high), "pairs": len(pairs),
                   "gap [m]": float(built_here.min()),
                   **{f"gap at {axis} [m]": float(outcomes.pair_place[pairs[narrow[1]], d]) for d, axis in enumerate("xyz")},
                   **_spread("closing", mine.max(1)),
                   **{f"closing at {axis} [m]": float(outcomes.pair_place[pairs[most[1]], d]) for d, axis in enumerate("xyz")},
                   "closing time [s]": float(outcomes.pair_time[who[most[0]], pairs[most[1]]]),
                   "closing member": int(who[most[0]]) + 1}
            for d, axis in enumerate("xyz"):
                row |= _spread(f"relative {axis}", torsion * outcomes.pair_moved[np.ix_(who, pairs)][..., d].max(1))
            rows.append(row | {"ratio": float(ratio[:, pairs].max()), "margin [m]": float((built_here - mine).min()),
                               "touching": float((built_here - mine <= 0).any(1).mean()),
                               "first": int(np.isin(first, pairs).sum())})
    return rows


def write(folder: Path, runs: dict) -> None:
    """joint_by_elevation.csv. `runs`: name of what was run, as with and without pounding -> its rows."""
    write_csv(Path(folder) / TABLE, [{"runs": name, **row} for name, rows in runs.items() for row in rows])


def draw(folder: Path, runs: dict, name: str = "joint_by_elevation.png") -> list:
    """The figure in elevation, a panel per contact: least gap as built, and mean, 84 % and largest closing of each of the
    runs. Returns what a page needs to show it."""
    from pounding.plot import style

    contacts = list(dict.fromkeys(row["contact"] for rows in runs.values() for row in rows))
    figure, panels = style.plt.subplots(1, len(contacts), figsize=(style.WIDTH, 4.4), sharey=True, squeeze=False)
    for axes, contact in zip(panels[0], contacts):
        for number, (run, rows) in enumerate(runs.items()):
            mine = [row for row in rows if row["contact"] == contact]
            if not mine:
                continue
            finite = [edge for row in mine for edge in (row["from [m]"], row["to [m]"]) if np.isfinite(edge)]
            low, high = min(finite, default=0.0) - 0.5, max(finite, default=0.0) + 0.5
            height = np.clip([[row["from [m]"], row["to [m]"]] for row in mine], low, high).ravel()

            def line(key: str, **how) -> None:
                axes.plot(1e3 * np.repeat([row[key] for row in mine], 2), height, **how)

            colour = (style.WITH, style.WITHOUT, "#009E73", "#CC79A7")[number % 4]
            if number == 0:
                line("gap [m]", color="black", lw=2.0, label="least gap as built")
            line("closing mean [m]", color=colour, ls=":", label=f"{run}: closing, mean")
            line(f"closing {100 * SHARE:g} % [m]", color=colour, ls="--", label=f"{run}: {100 * SHARE:g} %")
            line("closing largest [m]", color=colour, lw=1.6, label=f"{run}: largest")
        axes.set(xlabel="[mm]", title=contact, xlim=(0, None))
    panels[0][0].set_ylabel("elevation [m]")
    panels[0][-1].legend(fontsize=8, loc="best")
    return style.save(figure, Path(folder), name, "The joint by elevation",
                      "Least gap as built, and largest closing of the members in each band of elevation; where a closing lies "
                      "right of the gap, the joint is too narrow there.", columns=[[axes] for axes in panels[0]])
