"""Spans of a study: what goes from one building to another; largest motions of its ends against each other over the members,
spectra at both ends, and histories of the members that govern."""

from pathlib import Path

import numpy as np

from pounding import UserError, load
from pounding.fragility import moments, of_worst, widened
from pounding.plot.markup import html_table
from pounding.plot.style import WIDTH, WITH, WITHOUT, log_scale, plt, save
from pounding.results import DIRECTIONS
from pounding.spans import MOTIONS, unit_of
from pounding.tables import write_csv

from .study_file import ALONE, Reader, given_options, place_of

ENDS = {"from": "a", "to": "b"}  # end of a span -> last letter of the probe that the study puts there
ROUND_OFF = 1e-6  # of the largest motion of its kind: below it nothing moves
SAME = 1e-6  # of a largest value: as near as that of a single run is to a member's
MOST_DRAWN = 6
LENGTHS = {"u": "|u|", "r": "|r|"}  # of vectors, on pages
VALUES = ("mean", "84 %", "largest", "apart 84 %", "apart largest")
CAPTION = "What spans the joint: motion of the second end against the first since the start, with pounding and apart"


def read(reader: Reader, given: dict) -> dict:
    """Options of the study's spans and of the probes at their ends, beside those of its scene. `given`: these. Throws
    UserError."""
    blocks = reader.values.get("spans")
    if blocks is None:
        return {}
    if not isinstance(blocks, dict) or not blocks:
        reader.fail("spans", "is no list of named spans, as `spans: {tray: {from: roof, to: {structure: right, at: \"6,2,3\"}}}`")
    lists = {key: [one for one in given.get(key, "").split(",") if one not in ("", "none")] for key in ("structures", "probes", "spans")}
    found = {}
    for name, block in blocks.items():
        one = Reader(block or {}, reader.path, f"spans: {name}", tuple(ENDS))
        if name in lists["spans"]:
            raise UserError(f"{reader.path}: spans: {name} is a span of the scene already; give another name")
        stands = []
        for key, letter in ENDS.items():
            probe, options = _end(one, key, f"{name}_{letter}", lists)
            found |= {f"{name}_{key}": probe, **options}
            lists["probes"] += [probe] * (probe not in lists["probes"])
            stands.append({**given, **options}.get(f"{probe}_structure"))
        if stands[0] == stands[1] is not None:
            raise UserError(f"{reader.path}: spans: {name}: both ends are on structure {stands[0]}; a span goes from one "
                            "structure to another")
    return {**found, "spans": ",".join([*lists["spans"], *blocks]), "probes": ",".join(lists["probes"])}


def _end(span: Reader, key: str, name: str, lists: dict) -> tuple:
    """Probe at an end, and its options where the study places it."""
    end = span.values.get(key)
    if end is None:
        raise UserError(f"{span.path}: {span.place}: {key} is missing: a probe of the scene, or a structure and a point, as "
                        f"`{key}: {{structure: right, at: \"6,2,3\"}}`")
    if not isinstance(end, dict):
        if str(end) not in lists["probes"]:
            span.fail(key, f"is no probe of the scene; it has {', '.join(lists['probes']) or 'none'}")
        return str(end), {}
    place = span.part(key, ("structure", "at", "group"))
    structure = str(place.values.get("structure", ""))
    if structure not in lists["structures"]:
        raise UserError(f"{span.path}: {place.place}: structure: {structure!r} is no structure of the scene; it has "
                        f"{', '.join(lists['structures'])}")
    if ("at" in place.values) == ("group" in place.values):
        raise UserError(f"{span.path}: {place.place}: give one of at, a point x,y,z, and group")
    if name in lists["probes"]:
        raise UserError(f"{span.path}: {span.place}: {name} would be the probe at its end, and is one already; give the span "
                        "another name")
    options = {f"{name}_structure": structure}
    if "group" in place.values:
        return name, {**options, f"{name}_group": str(place.values["group"])}
    point = place.numbers("at")
    if len(point) != 3:
        place.fail("at", "is not a point x,y,z")
    return name, {**options, f"{name}_at": ",".join(f"{x:.9g}" for x in point)}


def rows_of(analyses: dict, gap: float) -> list:
    """A row per span, level and motion: mean, 84 % and largest over the samples in the joint of a nominal gap, each in the
    condition in which it is largest; of the largest that condition, when, and the sample and its motions; and 84 % and largest of
    the runs apart. `analyses`: condition -> Analysis; None stands for the only one of a study."""
    first = next(iter(analyses.values()))
    rows = []
    for number, span in enumerate(first.outcomes.spans):
        for level in first.study.levels:
            for k, motion in enumerate(MOTIONS):
                (found, condition, sample), (apart, *_) = (
                    of_worst({name: one.outcomes.span_peak[one.of(cell, level), number, k] for name, one in analyses.items()})
                    for cell in (gap, None))
                one = analyses[condition]
                row = {"span": span, "pga [m/s2]": level, "motion": f"{motion} [{unit_of(motion)}]", **found,
                       "apart 84 %": apart["84 %"], "apart largest": apart["largest"]}
                length = max(one.outcomes.span_peak[one.of(gap, level), number, 4 * (k // 4) + 3].max() for one in analyses.values())
                moves = row["largest"] > ROUND_OFF * length
                rows.append(row | ({"time [s]": float(one.outcomes.span_time[one.of(gap, level)[sample], number, k]), "sample": sample,
                                    "motions": motions_of(one, sample), **place_of(condition)} if moves else dict.fromkeys(VALUES, 0.0)))
    return rows


def told(rows: list, level: float) -> list:
    """How far the ends of each span move and turn against each other at a level, a sentence each."""
    lines = []
    for span in dict.fromkeys(row["span"] for row in rows):
        way, turn = (next(row for row in rows if (row["span"], row["pga [m/s2]"], row["motion"]) == (span, level, motion))
                     for motion in ("u [m]", "r [rad]"))
        lines.append(f"The ends of {span} move {1e3 * way['84 %']:.3g} mm against each other in 84 % of the cases at {level:g} m/s2 "
                     f"({1e3 * way['largest']:.3g} at most), and turn {1e3 * turn['84 %']:.3g} mrad ({1e3 * turn['largest']:.3g}).")
    return lines


def table(rows: list, levels: list, one) -> str:
    """Rows of some levels for a page, a column per motion: values in mm and mrad, times, and where the largest is governed: soil,
    state and sample. Nothing of a study without spans."""
    head = ["span", "m/s²", "", *(f"{motion} [m{unit_of(motion)}]" if motion in ("ux", "rx") else LENGTHS.get(motion, motion)
                                  for motion in MOTIONS)]
    lines = []
    for span in dict.fromkeys(row["span"] for row in rows):
        for level in levels:
            mine = [row for row in rows if row["span"] == span and row["pga [m/s2]"] == level]
            lines += [(span, level, value, *(1e3 * row[value] for row in mine)) for value in VALUES]
            lines.append((span, level, "largest at [s]", *(row.get("time [s]", "") for row in mine)))
            lines.append((span, level, "largest in", *(", ".join([str(row[key]) for key in ("soil", "state") if row.get(key, ALONE) != ALONE]
                                                                 + [f"#{row['sample']}"]) if "sample" in row else "" for row in mine)))
    return html_table("#: sample of motion. Mean, 84 % and largest of the samples, each the largest over soils and states",
                      head, lines, text=(0, 2)) if rows else ""


def motions_of(one, sample: int) -> str:
    """Records or seeds of a sample, by axis."""
    motion = one.design.motions[sample]
    return ", ".join(f"{name}: {'' if axis.records else 'seed '}{axis.name_of(motion)}" for name, axis in one.study.axes.items())


def spectra(analyses: dict, probes: tuple, level: float) -> np.ndarray:
    """84 % spectra at the ends of a span, the largest of all joints, with pounding and apart, and conditions, shape (ends,
    directions, damping ratios, frequencies)."""
    first = next(iter(analyses.values()))
    channels = [[first.outcomes.channels.index(f"{end} {way}") for way in DIRECTIONS] for end in probes]
    return np.max([moments(one.outcomes.spectra[one.of(gap, level)][:, channels]).high
                   for one in analyses.values() for gap in [*first.study.gaps, None]], axis=0)


def spectra_rows(analyses: dict, span: str) -> list:
    """Spectra at both ends of a span, the larger of the two, and that widened, at all levels."""
    first, rows = next(iter(analyses.values())), []
    for level in first.study.levels:
        high = spectra(analyses, ends_of(first, span), level)
        broad = widened(first.outcomes.frequency, high.max(0))
        rows += [{"pga [m/s2]": level, "direction": way, "damping": f"{ratio:g}", "frequency": f"{f:.9g}", "from": f"{high[0, d, r, k]:.6g}",
                  "to": f"{high[1, d, r, k]:.6g}", "envelope": f"{high[:, d, r, k].max():.6g}", "widened": f"{broad[d, r, k]:.6g}"}
                 for d, way in enumerate(DIRECTIONS) for r, ratio in enumerate(first.outcomes.damping)
                 for k, f in enumerate(first.outcomes.frequency)]
    return rows


def ends_of(one, span: str) -> tuple:
    """Probes at the ends of a span."""
    options = {**given_options(one.study.scene), **one.study.options}
    return tuple(options[f"{span}_{key}"] for key in ENDS)


def write(analyses: dict, folder: Path, gap: float) -> list:
    """spans.csv and the spectra of each span; returns the rows of spans.csv, none of a study without spans."""
    rows = rows_of(analyses, gap)
    for span in next(iter(analyses.values())).outcomes.spans:
        write_csv(folder / f"span_{span}_spectra.csv", spectra_rows(analyses, span))
    if rows:
        write_csv(folder / "spans.csv", rows)
    return rows


def write_histories(rows: list, analyses: dict, folder: Path, gap: float, level: float) -> list:
    """span_NAME.csv of each span: the history of the member whose relative displacement is largest at a level, from a run of
    its own, which is kept. Returns a line for each, a doubt where that run's largest value is another than the member's. Throws
    UserError."""
    lines = []
    for row in rows:
        if row["pga [m/s2]"] != level or not row["motion"].startswith("u [") or "sample" not in row:
            continue
        one = next(one for condition, one in analyses.items() if place_of(condition).items() <= row.items())
        member = one.design.members[one.of(gap, level)[row["sample"]]]
        span = load(one.runner.history(member)).spans[row["span"]]
        span.write_history(folder / f"span_{row['span']}.csv")
        found = float(span.largest[0][MOTIONS.index("u")])
        lines.append(f"span_{row['span']}.csv: history of sample {row['sample']} ({row['motions']}) at {level:g} m/s2"
                     + "".join(f", {key} {value}" for key, value in row.items() if key in ("soil", "state") and value != ALONE) + ".")
        if abs(found - row["largest"]) > SAME * row["largest"]:
            lines.append(f"Doubt: {row['span']}: a single run of sample {row['sample']} moves its ends {found:.9g} m apart, the member "
                         f"{row['largest']:.9g}.")
    return lines


def figure(rows: list, analyses: dict, folder: Path, level: float) -> list:
    """Largest relative displacements and rotations of each span, with pounding and apart, and the spectra at its ends; nothing of
    a study without spans."""
    spans = list(dict.fromkeys(row["span"] for row in rows))[:MOST_DRAWN]
    if not spans:
        return []
    first = next(iter(analyses.values()))
    damping = first.damping(0.05)
    drawn, panels = plt.subplots(len(spans), 3, figsize=(1.35 * WIDTH, 3.3 * len(spans)), squeeze=False)
    for line, span in zip(panels, spans):
        mine = [row for row in rows if row["span"] == span and row["pga [m/s2]"] == level]
        for axes, unit, some in ((line[0], "mm", mine[:4]), (line[1], "mrad", mine[4:])):
            place, height = np.arange(len(some)), 0.36
            for shift, key, colour, label in ((-0.19, "", WITH, "with pounding"), (0.19, "apart ", WITHOUT, "apart")):
                axes.barh(place + shift, [1e3 * row[f"{key}84 %"] for row in some], height, color=colour, label=f"{label}, 84 %")
                axes.plot([1e3 * row[f"{key}largest"] for row in some], place + shift, "|", color="black", ms=9, mew=1.6)
            axes.set_yticks(place, [LENGTHS.get(motion, motion) for motion in (row["motion"].split(" ")[0] for row in some)])
            axes.invert_yaxis()
            axes.grid(axis="y", visible=False)
            axes.legend(fontsize=9, loc="upper center", bbox_to_anchor=(0.5, -0.17), ncol=2, title=unit, title_fontsize=10, handlelength=1, columnspacing=1)
            axes.set(title=f"{span}: relative {'displacement' if unit == 'mm' else 'rotation'}", xlim=(0, None))
        high = spectra(analyses, ends_of(first, span), level)[:, :2, damping].max(1)
        for values, style, end in zip(high, ("-", "--"), ends_of(first, span)):
            line[2].plot(first.outcomes.frequency, values, style, color=WITH, lw=1.3, label=end)
        log_scale(line[2], "x", first.outcomes.frequency)
        log_scale(line[2], "y", high)
        line[2].set(xlabel="frequency [Hz]", title="horizontal spectra at its ends [m/s²]")
        line[2].legend(fontsize=9)
    return save(drawn, folder, "spans.png", "What spans the joint",
                f"Motion of the second end of each span against the first, since the start, at {level:g} m/s²: bars 84 % of "
                f"{first.study.samples} samples, marks the largest; spectra: 84 %, {100 * first.outcomes.damping[damping]:g} % damping, "
                "the larger of x and y, the largest of all joints, with and without pounding.",
                columns=[[panels[row][column] for row in range(len(spans))] for column in range(3)])
