"""Tables, figures and page of a study."""

from pathlib import Path

import numpy as np

from pounding import UserError, joint
from pounding.tables import cells_of, markdown, write_csv, write_rows
from pounding.plot import design_spectra
from pounding.plot.answer import plural
from pounding.plot.markup import answer_box, figure_parts, html_table, paragraphs, write_page
from pounding.fragility import Fragility, moments

from . import figures, spans, stability, struck
from .analysis import CONTACT, EXCEEDED, TOLERANCE, Analysis, fit_row, gap_text, name_of
from .controlled import CAPTION
from .design import OWN_FIELD
from .outcomes import Outcomes

PLACES = ("gap [m]", "pga [m/s2]")


def write_design(analysis: Analysis, folder: Path) -> None:
    """design.csv: of each sample its motion and what was drawn."""
    axes = analysis.study.axes
    names = [one.name for one in analysis.study.variables]
    head = ["sample", *(f"motion {name}" for name in axes),
            *(f"{name} deviation [m]" if name.endswith("_gap") else name for name in names)]
    write_rows(folder / "design.csv", head, ([sample, *(one.motions[motion] for one in axes.values()),
                                              *(f"{value:.9g}" for value in analysis.design.samples[sample])]
                                             for sample, motion in enumerate(analysis.design.motions)))


def write_spectra(analysis: Analysis, folder: Path) -> None:
    """A table per cell in the folder spectra."""
    place = folder / "spectra"
    place.mkdir(exist_ok=True)
    for gap, level in analysis.cells:
        write_csv(place / f"gap-{gap_text(gap)}_pga-{level:g}.csv", analysis.spectra_rows(gap, level))


def enough_summary(rows: list) -> list:
    """The most that any channel and damping ratio asks for, of the runs apart and of each gap."""
    found = []
    for gap in dict.fromkeys(row["gap [m]"] for row in rows):
        mine = [row for row in rows if row["gap [m]"] == gap]
        worst = max(mine, key=lambda row: row["largest cov"])
        keys = ("pga [m/s2]", "channel", "damping", "at [Hz]", "largest cov")
        found.append({"gap [m]": gap, **{key: worst[key] for key in keys}, **{
            key: max(row[key] for row in mine) for key in ("mean 68 %", "mean 95 %", "ln mean 68 %", "ln mean 95 %")}})
    return found


def repeats_summary(rows: list) -> list:
    """Of each channel the errors of its repeats and what a little more shaking does."""
    found = []
    for channel in dict.fromkeys(row["channel"] for row in rows):
        mine = [row for row in rows if row["channel"] == channel]
        one = {"channel": channel, "repeats": len(mine)}
        for key in ("rms", "rms of noise"):
            values = [row[key] for row in mine]
            one |= {f"{key}, median": float(np.median(values)), f"{key}, worst": max(values)}
        found.append(one)
    return found


def elevation_runs(analysis: Analysis, gap: float, level: float) -> dict:
    """Rows of the joint by elevation, with pounding in a joint and of the runs apart, at a level. Throws UserError."""
    study, members = analysis.study, analysis.of(gap, level)
    try:
        return {"with pounding": joint.by_elevation(analysis.outcomes, study.elevations, members, torsion=study.torsion.factor),
                "apart": joint.by_elevation(analysis.outcomes, study.elevations, analysis.of(None, level),
                                            analysis.outcomes.pair_gap[members], study.torsion.factor)}
    except joint.JointError as error:
        raise UserError(f"{study.path}: {error}") from error


def write(analysis: Analysis, full: Outcomes | None, rules: dict, notes: list, folder: Path) -> tuple:
    """Writes everything and returns the page's path and what the terminal shows."""
    study, at_both = analysis.study, analysis.controlled
    write_design(analysis, folder)
    write_spectra(analysis, folder)
    fits = {event: analysis.fits(event) for event in analysis.events}
    first = analysis.first_contact()
    fit_rows = [fit_row(event, gap, fit, first[:, study.gaps.index(gap)] if event == CONTACT else None,
                        study.uncertainty)
                for event in analysis.events for gap, fit in fits[event].items()]
    enough_rows = analysis.enough_rows()
    pages = figures.summary(analysis, folder) + figures.curves(analysis, fits, folder)
    pages += figures.joints(analysis, rules, folder)
    gap, level, *_ = figures.shown(analysis)
    by_elevation = elevation_runs(analysis, gap, level)
    joint.write(folder, by_elevation)
    pages = joint.draw(folder, by_elevation) + pages
    alone = {None: analysis}
    across = spans.write(alone, folder, gap)
    pages += spans.figure(across, alone, folder, level)
    of_mats = stability.write(alone, folder, gap)
    of_places = struck.write(alone, folder, gap)
    more, widths = figures.enough(analysis, folder)
    pages += more + (figures.scatter_parts(analysis, folder) if study.exchange else [])
    first_rows = [{"sample": sample, "motion": analysis.design.motions[sample],
                   **{f"joint {gap:g} m: first contact at [m/s2]": float(first[sample, place])
                      for place, gap in enumerate(study.gaps)}} for sample in range(study.samples)]
    tables = {"members": analysis.member_rows(), "probability": analysis.probability_rows(), "curves": fit_rows,
              "joint": analysis.joint_rows(rules), "first_contact": first_rows, "enough": enough_rows,
              "confidence": widths, "scatter": analysis.scatter_rows(), "joint_share": analysis.joint_share_rows(),
              "fields": analysis.field_rows(),
              "full_order": analysis.repeat_rows(full) if full else [], "both_orders": at_both.rows if at_both else []}
    if at_both:
        at_both.write_spectra(folder)
    for name, rows in tables.items():
        if rows:
            write_csv(folder / f"{name}.csv", rows)
        else:
            (folder / f"{name}.csv").unlink(missing_ok=True)
    parts = [("Probability", tables["probability"]), ("Lognormal curves", fit_rows),
             ("Deviation of the logarithm of spectra, 5 % damping", of_shown(analysis, tables["joint_share"])),
             ("Other deviations and lengths of the joints' fields, 5 % damping", fields_summary(tables["fields"])),
             (f"{analysis.study.width_title} that would be needed [m]".capitalize(), tables["joint"]),
             (f"Members that the mean of any spectrum needs, within {100 * TOLERANCE:g} %",
              enough_summary(enough_rows)), ("Repeats at full order: ln-ratio of the spectra", repeats_summary(tables["full_order"])),
             (CAPTION, [row for row in tables["both_orders"] if not row["quantity"].startswith(
                 ("mean", "84 %")) or (row["gap [m]"], row["pga [m/s2]"]) == (gap_text(gap), level)])]
    parts = [*stability.parts(of_mats), *parts]
    parts = [(struck.CAPTION, struck.shown(of_places)), *parts] if of_places else parts
    lines = told(analysis, fits, full, tables) + (at_both.told() if at_both else []) + spans.told(across, level) + notes
    box = answer_box(lines, any(row["hits"] for row in tables["probability"] if row["event"] == name_of(CONTACT)))
    shown = [*figure_parts(folder, pages), ("Floor spectra", floor_table(analysis)),
             (spans.CAPTION, spans.table(across, [level], analysis)),
             *((caption, html_table("", *cells_of(rows), text=(0,))) for caption, rows in parts)]
    names = ", ".join(f"{name}.csv" for name, rows in tables.items() if rows)
    after = paragraphs([f"Tables beside this page: {names}, design.csv, motions.csv, correlation.csv, {joint.TABLE}, spectra/*.csv."])
    text = "\n".join(f"{line}" for line in lines) + "\n\n" + "\n".join(
        markdown(caption, *cells_of(rows)) for caption, rows in parts if rows)
    return write_page(folder / "fragility.html", study.title, shown, answer=box, after=after, under=f"study {study.path.name}"), text


def fields_summary(rows: list) -> list:
    """Of each joint, band and pair of factors the median of the channels, and the channel that changes most."""
    groups = {}
    for row in rows:
        key = tuple(row[name] for name in ("gap [m]", "pga [m/s2]", "band [Hz]", "deviation times", "length times", "touch"))
        groups.setdefault(key, []).append(row)
    found = []
    for (gap, level, band, deviation, length, touch), some in groups.items():
        worst = max(some, key=lambda row: abs(np.log(row["84 % ratio, furthest"])))
        one = {"gap [m]": gap, "pga [m/s2]": level, "band [Hz]": band, "deviation times": deviation, "length times": length,
               "touch": touch, "84 % ratio, median": float(np.median([row["84 % ratio, median"] for row in some])),
               "furthest": worst["84 % ratio, furthest"], "of": worst["channel"]}
        if some[0]["joint"] != "":
            one["deviation by the joint, median"] = float(np.median([row["joint"] for row in some]))
        found.append(one)
    return found


def fields_told(rows: list, study) -> list:
    """How far other fields than the study's own change the answer, in a sentence for each pair of factors."""
    lines = []
    for pair in dict.fromkeys((row["deviation times"], row["length times"]) for row in rows):
        mine = [row for row in rows if (row["deviation times"], row["length times"]) == pair]
        worst = max(mine, key=lambda row: abs(np.log(row["furthest"])))
        if pair != OWN_FIELD:
            middle = "; ".join(f"{row['84 % ratio, median']:.3g} at {row['band [Hz]']} Hz" for row in mine
                               if row["gap [m]"] == worst["gap [m]"])
            lines.append(f"Fields of {pair[0]:g} times the deviation and {pair[1]:g} times the length make the 84 % spectra of "
                         f"the {study.joint_named(float(worst['gap [m]']))} at {worst['pga [m/s2]']:g} m/s2, in the median, {middle} "
                         f"times those of the study's, and {worst['furthest']:.3g} times at most ({worst['of']}).")
    return lines


def of_shown(analysis: Analysis, rows: list) -> list:
    """Rows of the cell that the figures show."""
    gap, level = figures.shown(analysis)[:2] if rows else (None, None)
    return [row for row in rows if (row["gap [m]"], row["pga [m/s2]"]) == (gap_text(gap), level)]


def floor_table(analysis: Analysis) -> str:
    """Floor spectra of the cell that the figures show, with and without pounding: 84 % of the members, widened."""
    found = analysis.outcomes
    gap, level, _, damping = figures.shown(analysis)
    at = np.array([f for f in design_spectra.SHOWN if found.frequency[0] <= f <= found.frequency[-1]], float)
    rows = []
    for channel in analysis.main(found.spectra[analysis.of(gap, level)]):
        name = found.channels[channel]
        for cell, words in ((gap, "with pounding"), (None, "without")):
            high = moments(found.spectra[analysis.of(cell, level)][:, channel, damping]).high
            rows.append((f"{name}, {words}", *(f"{value:.3g}" for value in design_spectra.design_spectrum(found.frequency, high, at))))
    return html_table(f"84 % of the members in a {analysis.study.joint_named(gap)} at {level:g} m/s², {100 * found.damping[damping]:g} % damping, "
                      f"widened by {100 * design_spectra.BROADENING:g} % [m/s²], by frequency [Hz]",
                      ["", *(f"{f:g}" for f in at)], rows)


def percent(part: float) -> str:
    """A part in percent, of two digits or whole: 0.52, 74, 100."""
    value = 100 * float(part)
    return f"{value:.2g}" if abs(value) < 9.95 else f"{value:.0f}"


def needed_joint(rows: list, study) -> str:
    """Width that the joints need so that none of them closes, at each level, with its interval."""
    part = EXCEEDED[-1]
    key = f"{100 * part:g} %"

    def end(value) -> str:
        return f"{1e3 * value:.3g}" if value != "" else "beyond these samples"

    def width(value: float) -> str:
        return study.width_told(value) if study.is_surveyed else f"{1e3 * value:.3g} mm"

    widths = "; ".join(f"{width(row[f'{key} [m]'])} at {row['pga [m/s2]']:g} m/s2 ({end(row[f'{key} low'])} to "
                       f"{end(row[f'{key} high'])})" for row in rows if row["joint"] == "any")
    return (f"So that no joint closes in {100 * (1 - part):g} % of the cases it {'' if study.is_surveyed else 'must be as wide as '}"
            f"{widths}; in brackets{' the change in mm,' if study.is_surveyed else ''} the "
            f"interval at {100 * study.confidence:g} % confidence{study.torsion.told}.")


def touching(fits: dict, analysis: Analysis) -> list:
    study, lines = analysis.study, []
    if len(study.levels) == 1:  # no curve, but its only point
        for gap in study.gaps:
            _, part, low, high = (one[0] for one in analysis.probability(CONTACT, gap))
            lines.append(f"{study.joint_named(gap).capitalize()}: touches in {percent(part)} % of the cases at "
                         f"{study.levels[0]:g} m/s2 ({percent(low)} to {percent(high)}).")
        return lines
    for gap, fit in fits[CONTACT].items():
        if isinstance(fit, Fragility):
            lines.append(f"{study.joint_named(gap).capitalize()}: touches in half of the cases at {fit.theta:.3g} m/s2 "
                         f"({fit.theta_interval[0]:.3g} to {fit.theta_interval[1]:.3g}), beta {fit.beta:.2g} "
                         f"({fit.beta_interval[0]:.2g} to {fit.beta_interval[1]:.2g}).")
        else:
            lines.append(f"{study.joint_named(gap).capitalize()}: no curve, {fit}.")
    return lines


def failing(analysis: Analysis) -> list:
    """How likely each item of equipment fails at the strongest level, in every joint and apart."""
    study, lines = analysis.study, []
    for item in analysis.equipment:
        shares = []
        for gap in analysis.gaps_of(item):
            _, part, low, high = (one[-1] for one in analysis.probability(item, gap))
            place = "apart" if gap is None else f"in a {study.joint_named(gap)}"
            shares.append(f"{100 * part:.3g} % {place} ({percent(low)} to {percent(high)})")
        lines.append(f"{item.title} fails at {study.levels[-1]:g} m/s2 in {', '.join(shares)}.")
    return lines


def scattered(analysis: Analysis, rows: list) -> list:
    """How much of the scatter of spectra the joint makes, in the cell that the figures show."""
    mine, lines = of_shown(analysis, rows), []
    for band in dict.fromkeys(row["band [Hz]"] for row in mine):
        some = [row for row in mine if row["band [Hz]"] == band]
        worst = max(some, key=lambda row: row["share of the joint"])
        low, high = (f"{100 * min(worst[end], 1):.0f}" for end in ("low", "high"))
        lines.append(f"{percent(np.median([row['share of the joint'] for row in some]))} % at {band} Hz, at most "
                     f"{percent(worst['share of the joint'])} % ({low} to {high}; {worst['channel']})")
    return [f"Of the variance of ln-spectra in a {analysis.study.joint_named(float(mine[0]['gap [m]']))} at {mine[0]['pga [m/s2]']:g} m/s2 "
            f"the joint's own width makes, in the median of the channels, {'; '.join(lines)}."] if lines else []


def told(analysis: Analysis, fits: dict, full: Outcomes | None, tables: dict) -> list:
    """The answer in sentences: joint, contact, equipment, and how they were found."""
    study = analysis.study
    lines = [needed_joint(tables["joint"], study)]
    cells = len(study.gaps) * len(study.levels) * study.samples
    disturbed = f", and {len(analysis.design.repeated)} disturbed" if analysis.design.repeated else ""
    lines += touching(fits, analysis) + failing(analysis) + scattered(analysis, tables["joint_share"])
    lines += fields_told(fields_summary(tables["fields"]), study)
    exchanged = ", as many in the joint of the next sample" if study.exchange else ""
    others = sum(one.factors != OWN_FIELD for one in analysis.design.members)
    exchanged += f", at {study.levels[-1]:g} m/s2 in other fields ({others})" if others else ""
    lines += [f"{len(analysis.design.members)} runs: {study.samples} samples of motion and building at "
             f"{plural(len(study.levels), 'level')}, in {plural(len(study.gaps), 'joint')} ({cells}){exchanged}, apart "
             f"({len(study.levels) * study.samples}){disturbed}."]
    wrong = analysis.contradictions()
    lines.append(f"The runs apart say of {cells - wrong} of {cells} runs with a joint whether they touch as these do.")
    if full:
        rows = tables["full_order"]
        worst = max(rows, key=lambda row: row["rms"])
        errors, noise = ([row[key] for row in rows] for key in ("rms", "rms of noise"))
        lines.append(f"{len(analysis.design.repeated)} members repeated at full order: rms of a spectrum's ln-ratio "
                     f"{np.median(errors):.2g} in the median and {worst['rms']:.2g} at worst ({worst['channel']}), beside "
                     f"{np.median(noise):.2g} and {max(noise):.2g} of {100 * study.noise:g} % more shaking.")
    return lines
