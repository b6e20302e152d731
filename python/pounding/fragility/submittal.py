"""The submittal of a study: question, answer, tables and figures that a review asks for, assumptions and what is not
covered, on one page that prints to fifteen sheets at most."""

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from pounding.finished import digest
from pounding.fragility import binomial_interval
from pounding.joint import draw
from pounding.plot import design_spectra
from pounding.plot.markup import answer_box, figure_parts, html_table, paragraphs, write_page
from pounding.tables import cells_of, write_csv

from . import spans, stability, struck
from .analysis import CONTACT
from .controlled import CAPTION
from .envelope import Envelope, governs, shown_at_full_order
from .study import Study
from .study_file import Reader, given_options

KEYS = ("question", "design", "beyond", "not_covered")
# Rows of docs/measurements/verification.md by options of the scene that use what they verify.
FEATURES = {r"contacts": ("unmatched faces", "slab pounding"), r"\w+_soil_mat": ("soil",), r"\w+_soil_table": ("soil table",),
            r"\w+_gap_deviation": ("gap field",), r"\w+_friction": ("friction",), r"\w+_damping_uniform": ("uniform damping",),
            r"\w+_model": ("modal reduction",), r"\w+_p_delta": ("p delta",), r"supports": ("support motion",),
            r"preload": ("static start",), r"\w+_filler": ("filler",), r"\w+_crushing": ("crushing",),
            r"spectra_\w+": ("floor spectra",)}


@dataclass(frozen=True)
class Submittal:
    """What the study says of it: the question, the design level and one beyond it [m/s2], what is not covered."""

    question: str
    design: float
    beyond: float
    not_covered: list = field(default_factory=list)


def read(study: Study) -> Submittal | None:
    """The block `submittal` of a study; None where it has none. Throws UserError."""
    values = study.named.get("submittal")
    if values is None:
        return None
    reader = Reader(values, study.path, "submittal", KEYS)
    design, beyond = (reader.one_of(key, study.levels, default, "the study's levels")
                      for key, default in (("design", study.levels[0]), ("beyond", study.levels[-1])))
    lines = reader.values.get("not_covered") or []
    if not isinstance(lines, list):
        reader.fail("not_covered", "is no list of sentences")
    question = str(reader.values.get("question") or f"Do the buildings of {study.title} touch, and what follows?")
    return Submittal(question, design, beyond, [str(line) for line in lines])


def answers(one: Envelope, told: Submittal) -> list:
    """The answer at the design level and beyond it."""
    lines, study = [], one.study
    for words, level in dict.fromkeys((("at design level", told.design), ("beyond design", told.beyond))):
        at = study.levels.index(level)
        widths = [np.quantile(each.needed()[:, at], 0.84) for each in one.analyses.values()]
        most, place = one.governing(widths)
        shares = []
        for gap in study.gaps:
            count, samples, where = one.most_hit(CONTACT, gap, level)
            shares.append(f"in a {study.joint_named(gap)} they touch in {count} of {samples} cases"
                          + (f" ({governs(where)})" if len(one.conditions) > 1 and count else ""))
        lines.append(f"{words.capitalize()} ({level:g} m/s²) {'; '.join(shares)}; so that it stays open in 84 % of the "
                     f"cases it {study.width_told(widths[most])}" + (f" ({governs(place)})." if len(one.conditions) > 1 else "."))
        lines += [f"At full order, with the reduced runs as controls, that joint {study.width_told(row['value'])}"
                  + (f" ({1e3 * row['low']:.3g} to {1e3 * row['high']:.3g} mm at {100 * study.confidence:g} % confidence)." if "" not in (row["low"], row["high"]) else ".")
                  for row in shown_at_full_order(one, [level]) if row["quantity"].startswith("joint needed, exceeded in 16 %")]
    return lines + [line for level in dict.fromkeys((told.design, told.beyond)) for line in spans.told(one.span_rows, level)]


def open_points(one: Envelope) -> list:
    """Doubts, refused motions and contradictions, each once: they stand on the first sheet."""
    lines = [note for each in one.analyses.values() for note in each.notes if note.startswith("Doubt:") or "refused" in note]
    lines += [note for note in one.notes if note.startswith("Doubt:")]
    wrong = sum(each.contradictions() for each in one.analyses.values())
    lines += [f"Open: {wrong} members touch otherwise than the runs apart say."] if wrong else []
    worst = max(float(abs(each.outcomes.residual).max()) for each in one.analyses.values())
    lines += [f"Open: the energy balance of a member is off by {worst:.2g} of its largest term."] if worst > 1e-9 else []
    alike = {}
    for line in dict.fromkeys(lines):  # those of other soils and states differ in their numbers
        alike.setdefault(re.sub(r"\d+(\.\d+)?", "", line), []).append(line)
    others = {2: "another soil or state"}
    return [some[0] if len(some) == 1 else f"{some[0].removesuffix('.')} (likewise in {others.get(len(some), f'{len(some) - 1} other soils and states')})."
            for some in alike.values()]


def spectra_rows(one: Envelope, told: Submittal) -> list:
    """Envelope over soils and states of the 84 % spectra, widened, with pounding and without, at both levels."""
    study, found, rows = one.study, one.first.outcomes, []
    at = np.array([f for f in design_spectra.SHOWN if found.frequency[0] <= f <= found.frequency[-1]], float)
    main = one.first.main(found.spectra)
    high = {(level, gap): one.spectra(gap, level)[:, :, one.damping].max(0)
            for level in dict.fromkeys((told.design, told.beyond)) for gap in (one.gap, None)}
    for place, channel in enumerate(one.first.channels):
        for (level, gap), spectra in high.items() if channel in main else ():
            wide = design_spectra.design_spectrum(found.frequency, spectra[place], at)
            rows.append({"floor": found.channels[channel], "level [m/s²]": level,
                         "joint": "apart" if gap is None else study.joint_named(gap).removeprefix("joint "),
                         **{f"{f:g} Hz": f"{value:.3g}" if value >= 1e-3 else "< 0.001" for f, value in zip(at, wide)}})
    return rows


def equipment_rows(one: Envelope, told: Submittal) -> list:
    """How many members each item fails in, with and without pounding, at both levels, on the worst soil and in the worst
    state, and the interval of that share."""
    rows, study = [], one.study
    for item in [*study.capacities, *one.first.equipment]:
        row = {"item": item.name}
        for words, level in dict.fromkeys((("design", told.design), ("beyond", told.beyond))):
            for gap, joint in ((one.gap, "joint"), (None, "apart")):
                count, samples, _ = one.most_hit(item, gap, level)
                low, high = binomial_interval(np.array([count]), samples, study.confidence)
                row[f"{words}, {joint}"] = f"{count} of {samples} ({100 * low[0]:.0f}-{100 * high[0]:.0f} %)"
        rows.append(row)
    return rows


def assumptions(one: Envelope) -> list:
    """Rows of subject and assumption, from the options of the study and its scene."""
    study = one.study
    options = {**given_options(study.scene), **study.options, **study.reduction}
    motions = [f"{name}: {len(axis.motions)} {axis.kind}" for name, axis in study.axes.items()]
    damping = sorted(f"{name}: {value}" for name, value in options.items() if re.fullmatch(r"\w+_(damping_(uniform|ratio|alpha|beta)|modal_damping)", name))
    modes = sorted(f"{name}: {value}" for name, value in options.items() if name.endswith(("modal_vectors", "modal_cutoff")))
    rows = [("Motions", "; ".join(motions) + f"; components of a sample correlated by less than {study.correlation:g}"),
            ("Levels", ", ".join(f"{level:g}" for level in study.levels) + " m/s² (peak ground acceleration)"),
            ("Soils", ", ".join(dict.fromkeys(condition.soil for condition in one.conditions))),
            ("States", ", ".join(dict.fromkeys(condition.state for condition in one.conditions))),
            ("Coherence", f"mats move apart by {study.coherence.model.name}" if study.coherence else "all mats move alike"),
            ("Joint", ", ".join(study.joint_named(gap) for gap in study.gaps) + "; " + "; ".join(
                f"{name}: deviation {'drawn' if joint.deviation else 'none'}, field {'drawn' if joint.field else 'none'}"
                for name, joint in study.joints.items())),
            ("Drawn beside the motion", ", ".join(one_of.name for one_of in study.factors) or "nothing"),
            ("Damping", "; ".join(damping) or "none"), ("Reduction", "; ".join(modes) or "none: full order")]
    if study.torsion.factor != 1:
        rows.append(("Accidental torsion", study.torsion.assumption))
    rows += [(f"Samples{title}", each.controlled.numbers.told) for title, each in
             ((f", {condition.title}" if len(one.conditions) > 1 else "", each) for condition, each in one.analyses.items()) if each.controlled]
    if study.share:
        rows.append(("Error of the reduction", f"{100 * study.share:g} % of the members repeated at full order, see full_order.csv"))
    return rows


def verification_rows(options: dict, page: Path) -> list:
    """Rows of the verification page whose subject the scene's options use; none where the page is not there."""
    names = {row for pattern, rows in FEATURES.items() for name, value in options.items()
             if re.fullmatch(pattern, name) and value not in ("none", "full", "false", "0") for row in rows}
    if not page.is_file():
        return []
    cells = [[cell.strip() for cell in line.strip("|\n ").split("|")] for line in page.read_text(encoding="utf-8").splitlines()
             if line.startswith("| ")]
    return [{"problem": row[0], "reference": row[2], "largest error (allowed)": row[3]} for row in cells
            if len(row) == 5 and row[0] in names]


def write(one: Envelope) -> Path | None:
    """Writes submittal.html beside the study's page, and its tables as CSV; None of a study without a submittal."""
    study, folder, analyses = one.study, one.folder, one.analyses
    told = read(study)
    if told is None:
        return None
    spectra, items = spectra_rows(one, told), equipment_rows(one, told)
    for name, rows in (("submittal_spectra", spectra), ("submittal_equipment", items)):
        if rows:
            write_csv(folder / f"{name}.csv", rows)
    options = {**given_options(study.scene), **study.options, **study.reduction}
    page = Path(__file__).resolve().parents[3] / "docs" / "measurements" / "verification.md"
    inputs = {path: found for each in analyses.values() for path, found in each.inputs.items()}
    inputs[str(study.path)] = digest(study.path)
    touched = any(each.hits(CONTACT, gap).any() for each in analyses.values() for gap in study.gaps)
    points = open_points(one)
    missing = [] if study.coherence else ["Motions that differ from mat to mat (coherence)."]
    missing += [f"Other {word} than the one given." for word, key in (("soils", "soil"), ("states of the concrete", "state"))
                if len({condition.place[key] for condition in one.conditions}) == 1]
    joint = [row for row in one.joint_rows if row["pga [m/s2]"] in (told.design, told.beyond)]
    levels = dict.fromkeys((told.design, told.beyond))
    across = spans.table(one.span_rows, list(levels), one.first)
    parts = [(f"Least gap as built and largest closing by elevation{study.torsion.told}", html_table("", *cells_of(one.elevation_rows(levels)), text=(1, 2))),
             *figure_parts(folder, draw(folder, one.governing_by_elevation(told.beyond))),
             (f"{study.width_title} that would be needed [m]".capitalize(), html_table("", *cells_of(joint), text=(0,))),
             *([(CAPTION, html_table("", *cells_of(shown_at_full_order(one, levels)), text=(0,)))] if one.full_order_rows else []),
             (spans.CAPTION, across), *figure_parts(folder, one.span_figure),
             (f"Floor spectra for design: 84 % of the cases, the envelope of soils and states, widened by 15 %, "
              f"{100 * one.first.outcomes.damping[one.damping]:g} % damping [m/s²]", html_table("", *cells_of(spectra), text=(0, 2))),
             *figure_parts(folder, one.spectra_figure),
             ("Equipment that fails: cases on the worst soil and in the worst state", html_table("", *cells_of(items), text=(0,))),
             *((caption, html_table("", *cells_of(rows), text=(0, 1, 3))) for caption, rows in stability.parts(one.mat_rows, list(levels))),
             *([(struck.CAPTION, html_table("", *cells_of([row for row in struck.shown(one.struck_rows) if row["pga [m/s2]"] in (told.design, told.beyond)]),
                                            text=(0, 1, 2)))] if one.struck_rows else []),
             *figure_parts(folder, one.sensitivity_figure),
             ("Assumptions", html_table("", ["subject", "assumption"], assumptions(one), text=(0, 1))),
             ("Not covered", paragraphs([*told.not_covered, *missing])),
             ("Verification of what is used", html_table("", *cells_of(verification_rows(options, page)), text=(0, 1, 2))),
             ("Annex: files and their hashes", html_table("", ["file", "SHA-256"], sorted(
                 (Path(path).name, found[:16]) for path, found in inputs.items()), text=(0,), hashes=(1,))),
             ("Annex: options of the study beside its scene", html_table(
                 "", ["option", "value"], sorted((name, value) for name, value in {**study.options, **study.reduction}.items()), text=(0, 1)))]
    box = answer_box([told.question, *answers(one, told)], touched)
    before = paragraphs(points or ["No doubt and no open check."], "Doubts and open checks", "note")
    return write_page(folder / "submittal.html", f"{study.title}: submittal", parts, answer=box, before=before,
                      under=f"study {study.path.name}")
