"""What happens between the buildings: gap, impacts, and the energy balance."""

import numpy as np

from pounding.results import DIRECTIONS, Missing, Result
from . import scene_mesh
from .markup import readable
from .style import (WIDTH, contact_colour, legend_above, log_scale, plot_series, plt, probe_colour, save, stacked)


def _names(result: Result) -> list:
    """Contacts in the order of the history, then those that only the catalogue knows."""
    names = result.contacts + [str(name) for name in result.impacts.get("contact", [])]
    return list(dict.fromkeys(names))


def _impacts(result: Result) -> dict:
    if not result.impacts:
        raise Missing("no impacts.csv")
    if len(result.impacts["start"]) == 0:
        raise Missing("no impact")
    return result.impacts


def draw_gap(axes, result: Result, name: str, least: float, more: float) -> tuple:
    """The gap of a contact over time with its impacts, whose marks have these areas [points squared]. Returns its smallest gap [mm] and how
    often it is hit."""
    time, gap, impacts = result.history["time"], 1e3 * result.history["gap"][:, result.contacts.index(name)], result.impacts
    known = np.isfinite(gap)
    plot_series(axes, time[known], gap[known], lw=0.9, color=contact_colour(_names(result), name))
    axes.axhline(0, color="black", lw=0.8)
    axes.set_ylabel("gap [mm]")
    own = impacts["contact"].astype(str) == name if impacts else np.array([])
    if own.any():
        size = least + more * impacts["impulse"][own] / max(impacts["impulse"].max(), 1e-300)
        axes.scatter(impacts["start"][own], np.zeros(own.sum()), s=size, marker="v", color="#C0392B", alpha=0.75, lw=0,
                     zorder=3, label="impact (size: impulse)")
        legend_above(axes)
    return np.min(gap[known]), int(own.sum())


def gaps(result: Result) -> list:
    result.need("gap", "contacts")
    figure, rows = stacked(len(result.contacts), 2.1)
    for axes, name in zip(rows, result.contacts):
        least, count = draw_gap(axes, result, name, 12, 90)
        hits = f", {count} impact{'' if count == 1 else 's'}" if result.impacts else ""
        axes.set_title(f"{name}: smallest gap {least:.3g} mm{hits}")
    rows[-1].set_xlabel("time [s]")
    return save(figure, result.folder, "gap.png", "Gap",
                "Smallest gap over the faces of each contact; positive when open.")


def _over(time: np.ndarray, force: np.ndarray, width: float) -> np.ndarray:
    """Mean of the force over `width` [s] around each time. A sample is the mean over the interval that ends with it."""
    if not width > np.diff(time).max():
        return force
    impulse = np.concatenate([[0.0], np.cumsum(force[1:] * np.diff(time))])
    return (np.interp(time + width / 2, time, impulse) - np.interp(time - width / 2, time, impulse)) / width


def _nearest(result: Result, index: int) -> list:
    """The two probes that are nearest to an impact, of two structures where both have some; all where nobody knows."""
    impacts, points, known = result.impacts, result.contact_points, result.summary.get("probes", {})
    own = points["contact"].astype(str) == str(impacts["contact"][index]) if points else np.array([False])
    probes = [name for name in result.probes if known.get(name, {}).get("position")]
    if not own.any() or "lateral" not in impacts or len(probes) < 2:
        return result.probes
    _, along = _axes_of(result.summary.get("contacts", {}).get(str(impacts["contact"][index]), {}))
    pairs = np.stack([points[way][own] for way in DIRECTIONS], 1)
    at = np.array([impacts["lateral"][index], impacts["vertical"][index]])
    place = pairs[np.argmin(np.linalg.norm(pairs[:, along] - at, axis=1))]
    probes.sort(key=lambda name: np.linalg.norm(np.array(known[name]["position"]) - place))
    other = [name for name in probes if known[name].get("structure") != known[probes[0]].get("structure")]
    return [probes[0], (other or probes[1:])[0]]


def strongest_impact(result: Result) -> list:
    impacts = _impacts(result)
    result.need("gap", "contact_force", "acceleration", "contacts")
    index = int(np.argmax(impacts["impulse"]))
    start, end = impacts["start"][index], impacts["end"][index]
    contact = str(impacts["contact"][index])
    if contact not in result.contacts:
        raise Missing(f"history.h5 does not know the contact {contact}")
    margin = max(4e-3, 1.5 * (end - start))
    time = result.history["time"]
    window = slice(*np.searchsorted(time, [start - margin, end + 2 * margin]))
    if len(time[window]) < 2:
        raise Missing("history.h5 does not cover the strongest impact")
    figure, rows = stacked(3, 2.0)
    width = result.summary.get("impacts", {}).get("force_window") or 0.0
    near, way = _nearest(result, index), DIRECTIONS[_axes_of(result.summary.get("contacts", {}).get(contact, {}))[0]]
    for i, name in enumerate(result.contacts):
        style = {"color": contact_colour(_names(result), name), "label": name, "lw": 1.4}
        gap = 1e3 * result.history["gap"][window, i]
        known = np.isfinite(gap)
        rows[0].plot(1e3 * (time[window] - start)[known], gap[known], **style)
        force = _over(time, result.history["contact_force"][:, i], width)[window]
        rows[1].plot(1e3 * (time[window] - start), 1e-3 * force, **style)
    for probe in near:
        series = result.series_if_any("acceleration", probe, way)
        if series is not None:
            rows[2].plot(1e3 * (series[0][window] - start), series[1][window], label=probe,
                         color=probe_colour(result.probes, probe), lw=1.2)
    rows[0].axhline(0, color="black", lw=0.8)
    over = f"contact force over\n{1e3 * width:.3g} ms [kN]" if width else "contact force [kN]"
    for axes, label in zip(rows, ("gap [mm]", over, f"acceleration {way},\nas sampled [m/s²]")):
        axes.axvspan(0, 1e3 * (end - start), color="#C0392B", alpha=0.10, lw=0)
        axes.set_ylabel(label)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    rows[0].set_title(f"{contact}, t = {start:.5g} s: impulse {readable(impacts['impulse'][index])} N s "
                      f"in {1e3 * impacts['duration'][index]:.3g} ms")
    rows[2].set_xlabel(f"time after {start:.6g} s [ms]")
    return save(figure, result.folder, "strongest_impact.png", "The strongest impact",
                f"Gap, contact force{' as the mean over the stated time around each moment' if width else ''}, and accelerations "
                f"of the {'probes nearest to the place' if len(near) < len(result.probes) else 'probes'} around the impact with the "
                "largest impulse. Shaded: from its first to its last contact. Accelerations are the samples themselves; "
                "where an impact acts at a probe their peaks grow with finer samples, those of the table of peaks do not.")


def impact_catalogue(result: Result) -> list:
    impacts = _impacts(result)
    figure, (left, right) = plt.subplots(1, 2, figsize=(WIDTH, 3.6))
    for name in _names(result):
        own = impacts["contact"].astype(str) == name
        if not own.any():
            continue
        colour = contact_colour(_names(result), name)
        start, impulse = impacts["start"][own], impacts["impulse"][own]
        left.vlines(start, 0, impulse, color=colour, lw=1.2)
        left.plot(start, impulse, "o", color=colour, ms=4, label=f"{name} ({own.sum()})")
        right.plot(impulse, 1e3 * impacts["duration"][own], "o", color=colour, ms=4.5, alpha=0.8, label=name)
    left.set(xlabel="time [s]", ylabel="impulse [N s]", title="impulse in time", ylim=(0, None))
    right.set(xlabel="impulse [N s]", ylabel="duration [ms]", title="duration and impulse")
    log_scale(right, "x", impacts["impulse"])
    log_scale(right, "y", 1e3 * impacts["duration"])
    left.legend(loc="best")
    right.legend(loc="best")
    right.grid(True, which="minor", lw=0.3)
    return save(figure, result.folder, "impacts.png", "Impact catalogue",
                "Every impact: impulse and duration, by contact (number of impacts in brackets).",
                columns=[[left], [right]])


def energy_balance(result: Result) -> list:
    table = result.energy
    if not table or len(table["time"]) == 0:
        raise Missing("no energy.csv" if not table else "energy.csv has no line")
    terms = (("input_work", "work of the ground", "#222222"), ("kinetic", "kinetic", "#0072B2"),
             ("strain", "strain", "#009E73"), ("damping_loss", "damping", "#E69F00"),
             ("contact_work", "contact", "#C0392B"))
    not_always = (("friction_loss", "friction", "#56B4E9"), ("device_work", "links and dashpots", "#CC79A7"),
                  ("plastic_loss", "yielding and crushing", "#7A5195"))
    drawn = {"time", "residual", "gravity_work", "load_work", *(term[0] for term in terms + not_always)}
    not_always += tuple((column, column.replace("_", " "), None) for column in table if column not in drawn)
    terms += tuple(term for term in not_always if np.any(table.get(term[0], 0)))
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(WIDTH, 5.4), sharex=True, height_ratios=(3, 2))
    for column, label, colour in terms:
        if column in table:
            plot_series(upper, table["time"], table[column], color=colour, label=label, lw=1.2)
    upper.set_ylabel("energy [J]")
    upper.legend(loc="upper left", ncol=3)
    upper.set_ylim(top=1.28 * upper.get_ylim()[1] - 0.28 * upper.get_ylim()[0])
    residual = np.where(table["residual"] != 0, np.abs(table["residual"]), np.nan)
    scale = np.nanmax(np.abs(table["input_work"]), initial=0.0)
    residual = residual / (scale if scale > 0 else 1)
    plot_series(lower, table["time"], residual, color="#666666", lw=0.9)
    log_scale(lower, "y", residual, plain=False)
    lower.set(ylabel="|residual| / largest\nwork of the ground" if scale > 0 else "|residual| [J]", xlabel="time [s]")
    return save(figure, result.folder, "energy.png", "Energy balance",
                "Terms of the energy balance of the scheme, and its residual.")


def _axes_of(contact: dict) -> tuple:
    """The axis of the normal, and the two along the face in their order."""
    normal = int(np.argmax(np.abs(contact.get("normal") or (1, 0, 0))))
    return normal, [axis for axis in range(3) if axis != normal]


def _parts(result: Result) -> list:
    try:
        return scene_mesh.load(result.folder)[1]
    except Missing:
        return []


def _areas(impulse: np.ndarray, largest: float) -> np.ndarray:
    """Of circles [points squared], in proportion to the impulse."""
    return 12 + 400 * impulse / largest


def _hit_points(result: Result, name: str, along: list) -> tuple:
    """Places (n, 3) [m] and impulses [N s] of the pairs of a contact; without the table of them the means of its impacts."""
    table = result.contact_points
    own = table["contact"].astype(str) == name if table else np.array([False])
    if own.any():
        return np.stack([table[way][own] for way in DIRECTIONS], 1), table["impulse"][own]
    impacts = result.impacts
    own = impacts["contact"].astype(str) == name
    places = np.full((own.sum(), 3), np.nan)
    places[:, along[0]], places[:, along[1]] = impacts["lateral"][own], impacts["vertical"][own]
    return places, impacts["impulse"][own]


def _outlines(axes, result: Result, first: int, second: int) -> None:
    """The extent of each structure in the plane of two axes."""
    boxes = {}
    for name, structure in result.summary.get("structures", {}).items():
        for low, high in [structure["extent"]] if structure.get("extent") else []:
            boxes.setdefault((low[first], low[second], high[first], high[second]), []).append(name)
    for (left, bottom, right, top), names in boxes.items():
        axes.add_patch(plt.Rectangle((left, bottom), right - left, top - bottom, fill=False, ec="#888888", lw=0.9, ls="--", zorder=0.5))
        axes.annotate(", ".join(names), (left, bottom), xytext=(3, 3), textcoords="offset points", fontsize=8, color="#666666")
        axes.autoscale_view()


def impact_places(result: Result) -> list:
    impacts, contacts = result.impacts, result.summary.get("contacts", {})
    if not impacts or len(impacts["start"]) == 0:
        raise Missing("no impact" if impacts else "no impacts.csv")
    if "lateral" not in impacts or not contacts:
        raise Missing("impacts.csv has no places, or summary.json no contacts")
    hit = {name: int((impacts["contact"].astype(str) == name).sum()) for name in contacts}
    planes = {name: _axes_of(contacts[name])[1] for name in contacts if hit[name]}
    points = {name: _hit_points(result, name, plane) for name, plane in planes.items()}
    parts, largest = _parts(result), max(impulse.max() for _, impulse in points.values())
    in_plan = parts or not all(np.isnan(places).any() for places, _ in points.values())
    views = sorted({tuple(plane) for plane in planes.values()} | ({(0, 1)} if in_plan else set()), reverse=True)
    figure, grid = plt.subplots(1, len(views), figsize=(WIDTH, 4.2), squeeze=False)
    for axes, (first, second) in zip(grid[0], views):
        for part in parts:
            axes.scatter(part.points[:, first], part.points[:, second], s=0.3, color="#CCCCCC", zorder=0)
        _outlines(axes, result, first, second)
        for name, (places, impulse) in points.items():
            if (first, second) not in ((0, 1), tuple(planes[name])) or np.isnan(places[:, [first, second]]).any():
                continue
            colour, felt = contact_colour(result.contacts, name), impulse > 0
            if result.contact_points:
                axes.scatter(places[:, first], places[:, second], s=7, color="#777777", marker="s", lw=0, zorder=1)
            count = f", {felt.sum()} of {len(felt)} points" if result.contact_points else ""
            axes.scatter(places[felt, first], places[felt, second], s=_areas(impulse[felt], largest), color=colour, alpha=0.35,
                         edgecolor=colour, zorder=2, label=f"{name}: {hit[name]} impact{'' if hit[name] == 1 else 's'}, "
                         f"{readable(impulse.sum())} N s{count}")
        axes.set(title="In plan" if (first, second) == (0, 1) else f"On the faces, along {DIRECTIONS[first]} and {DIRECTIONS[second]}",
                 xlabel=f"{DIRECTIONS[first]} [m]", ylabel=f"{DIRECTIONS[second]} [m]")
        axes.set_aspect("equal", "datalim")
        axes.margins(0.12)
        if (first, second) != (0, 1):
            axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), markerscale=0.3)
    return save(figure, result.folder, "impact_places.png", "Where they hit",
                "Each point that was hit, the area of its circle in proportion to the impulse that it took in all; the largest "
                f"is {readable(largest)} N s. Squares: all pairs of the joints that closed; dashed: the extent of each structure"
                + ("; grey: nodes." if parts else "."), columns=[[axes] for axes in grid[0]])


JOINT = [gaps, strongest_impact, impact_catalogue, impact_places]
