"""One row per member of a sweep, and the figure over it."""

from pathlib import Path

from matplotlib.ticker import MaxNLocator

from pounding.plot import answer
from pounding.plot.markup import answer_box, figure_parts, html_table, paragraphs, write_page
from pounding.plot.style import WIDTH, plt, probe_colour, save
from pounding.fragility import binomial_interval
from pounding.results import DIRECTIONS, Result

from .members import Member

CONFIDENCE = 0.95  # of intervals

def _probe_columns(result: Result) -> dict:
    """Peak acceleration [m/s2], displacement [m] and spectrum per probe and direction: of the smallest damping ratio the
    largest pseudo-acceleration and its frequency [Hz]. Round-off is 0."""
    columns = {}
    for probe, one in result.summary.get("probes", {}).items():
        for key, title in (("peak_acceleration", "peak a {} [m/s2]"), ("peak_displacement", "peak u {} [m]")):
            values = [value or 0.0 for value in one.get(key) or [0, 0, 0]]
            for way, value in zip(DIRECTIONS, values):
                columns[title.format(f"{probe}.{way}")] = value if value > 1e-6 * max(values) else 0.0
        spectra = {way: result.spectrum_if_any(probe, way) for way in DIRECTIONS}
        largest = max((found[1].max() for found in spectra.values() if found), default=0.0)
        for way, found in spectra.items():
            if found:
                peak = found[1].max()
                moves = peak > 1e-6 * largest
                columns[f"peak PSA {probe}.{way} [m/s2]"] = float(peak) if moves else 0.0
                columns[f"at {probe}.{way} [Hz]"] = float(found[0][found[1].argmax()]) if moves else ""
    return columns


def row_of(axes: list, member: Member, result: Result | None, failure: str) -> dict:
    """What the table says of a member; a failed one has its reason only."""
    row = {axis.title: value for axis, value in zip(axes, member.values)}
    row.update({"folder": member.name, "status": failure or "ok"})
    if result is None:
        return row
    impacts = result.summary.get("impacts", {})
    row.update({"impacts": impacts.get("episodes", 0), "strongest impulse [N s]": impacts.get("largest_impulse", 0.0),
                "total impulse [N s]": impacts.get("total_impulse", 0.0),
                "energy lost [J]": impacts.get("energy_lost", 0.0)})
    for name, one in impacts.items():
        if isinstance(one, dict):
            row[f"impacts {name}"] = one.get("episodes", 0)
            row[f"strongest impulse {name} [N s]"] = one.get("largest_impulse", 0.0)
    row["closing factor"] = "" if answer.touched(result) else min(result.closing_factors().values(), default="")
    row.update(_probe_columns(result))
    row.update({"wall time [s]": result.summary.get("wall_time"), "commit": result.summary.get("commit", "")})
    return row


def shown(rows: list, axes: list) -> tuple:
    """Header and cells of what terminal and page show: impacts, how many times as strong a motion closes a joint that is
    open, and the largest spectrum of any direction by probe."""
    probes = probes_of(rows)
    head = [*(axis.title for axis in axes), "impacts", "closing factor", "strongest [N s]", *(f"PSA {probe}" for probe in probes), ""]
    cells = []
    for row in rows:
        failed = row["status"] != "ok"
        cells.append([*(row[axis.title] for axis in axes), "" if failed else row["impacts"],
                      "" if failed else row["closing factor"],
                      "" if failed else row["strongest impulse [N s]"],
                      *("" if failed else psa_of(row, probe) for probe in probes),
                      row["status"] if failed else ""])
    return head, cells


def probes_of(rows: list) -> list:
    return list(dict.fromkeys(key.split()[2].rpartition(".")[0] for row in rows for key in row
                              if key.startswith("peak PSA ")))


def psa_of(row: dict, probe: str) -> float:
    """Largest of the three directions [m/s2]."""
    return max(float(row.get(f"peak PSA {probe}.{way} [m/s2]", 0.0)) for way in DIRECTIONS)


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _abscissa(axes: list, rows: list) -> tuple:
    """The axis to draw over, the first whose values are all numbers, and what a row has along it; else the rows'
    order."""
    for axis in axes:
        if len(axis.values) > 1 and all(_number(value) is not None for value in axis.values):
            return axis, [_number(row[axis.title]) for row in rows]
    return None, list(range(1, len(rows) + 1))


def draw(rows: list, axes: list, folder: Path) -> list:
    """Strongest impulse, and the largest spectrum by probe, over the first axis of numbers; one line for each choice of
    the others. Nothing where no member came to its end."""
    rows = [row for row in rows if row["status"] == "ok"]
    probes = probes_of(rows)
    if not rows:
        return []
    axis, places = _abscissa(axes, rows)
    others = [one for one in axes if one is not axis]
    groups = {}
    for row, place in zip(rows, places):
        label = ", ".join(f"{one.title} {row[one.title]}" for one in others) if axis else ""
        groups.setdefault(label, []).append((place, row))
    figure, panels = plt.subplots(-(-(1 + len(probes)) // 2), 2, squeeze=False,
                                  figsize=(WIDTH, 0.4 + 3.2 * (-(-(1 + len(probes)) // 2))))
    titles = ["strongest impulse [N s]", *(f"largest PSA of {probe} [m/s²]" for probe in probes)]
    for blank in panels.ravel()[len(titles):]:
        blank.set_visible(False)
    for number, (axes_of, title) in enumerate(zip(panels.ravel(), titles)):
        for index, (label, points) in enumerate(groups.items()):
            points = sorted(points, key=lambda point: point[0])
            values = [psa_of(row, probes[number - 1]) if number else row["strongest impulse [N s]"] for _, row in points]
            axes_of.plot([place for place, _ in points], values, "o-", label=label or None, lw=1.4, ms=4,
                         color=probe_colour(list(groups), label))
        axes_of.set(title=title, ylim=(0, None))
        axes_of.xaxis.set_major_locator(MaxNLocator(5))
        axes_of.set_xlabel(axis.title if axis else "member, in the order of the table")
    if any(groups):
        panels[0][0].legend(loc="best", fontsize=7)
    return save(figure, folder, "sweep.png", "Sweep", "Strongest impulse and largest floor spectrum.",
                columns=list(panels.T))


def _is_joint(axis) -> bool:
    return all(name.endswith("_gap") for name in axis.names) and all(_number(value) is not None for value in axis.values)


def _is_motion(axis) -> bool:
    return any(name.endswith(("_seed", "_record")) for name in axis.names)


def _margin(rows: list) -> str:
    """The least factor by which a motion closes joints that are open."""
    factors = [row["closing factor"] for row in rows if row["closing factor"] != ""]
    return f" with a margin of {min(factors):.3g} on the motion" if factors else ""


def _share(rows: list, motions: int) -> str:
    """How many of the rows touch; of several motions the interval of the probability as well."""
    count = sum(row["impacts"] > 0 for row in rows)
    if motions < 2:
        return f"{count} of {len(rows)} members"
    low, high = binomial_interval(count, len(rows), CONFIDENCE)
    return (f"{count} of {len(rows)} motions ({100 * float(low):.2g} to {100 * float(high):.2g} % at "
            f"{100 * CONFIDENCE:g} % confidence)")


def sentences(rows: list, axes: list) -> list:
    """Joint, margin and confidence of a sweep: which joints close at which values of the other options."""
    ended = [row for row in rows if row["status"] == "ok"]
    motions = max((len(axis.values) for axis in axes if _is_motion(axis)), default=1)
    joint = next((axis for axis in axes if _is_joint(axis) and len(axis.values) > 1), None)
    others = [axis for axis in axes if axis is not joint and not _is_motion(axis)]
    groups = {}
    for row in ended:
        groups.setdefault(", ".join(f"{axis.title} {row[axis.title]}" for axis in others), []).append(row)
    sure = "" if motions > 1 else "; one motion gives no confidence"
    if joint is None:
        told = [f"{_share(group, motions)}{f' at {label}' if label else ''}{_margin(group)}" for label, group in groups.items()]
        return [f"The buildings touch in {'; '.join(told)}{sure}."] if ended else []
    told = []
    for label, group in groups.items():
        by_width = {width: [row for row in group if _number(row[joint.title]) == width]
                    for width in sorted({_number(row[joint.title]) for row in group})}
        closes = [width for width, own in by_width.items() if any(row["impacts"] for row in own)]
        opens = [width for width in by_width if not closes or width > max(closes)]
        own = by_width[max(closes)] if closes else []
        words = [f"closes up to {1e3 * max(closes):g} mm{f' in {_share(own, motions)}' if len(own) > 1 else ''}"] if own else []
        words += [f"stays open from {1e3 * min(opens):g} mm{_margin(by_width[min(opens)])}"] if opens else []
        told.append(f"{f'at {label} it ' if label else ''}{' and '.join(words)}")
    return [f"The joint {joint.title}: {'; '.join(told)}{sure}."] if ended else []


def write(rows: list, axes: list, title: str, folder: Path) -> Path:
    """Draws the figure, writes sweep.html and returns its path."""
    failed = sum(row["status"] != "ok" for row in rows)
    lines = sentences(rows, axes) + [f"{len(rows)} members, {failed} failed."]
    table = html_table("Impacts, the factor on the motion that closes the joint where it is open, and the largest floor "
                       "spectra [m/s²]", *shown(rows, axes))
    return write_page(folder / "sweep.html", title, figure_parts(folder, draw(rows, axes, folder)),
                      answer=answer_box(lines, any(row.get("impacts") for row in rows)), before=table, after=paragraphs(
                          ["Tables beside this page: sweep.csv, and a folder with the results of each member."]))
