"""The answer of a study over all of its soils and states: the largest of each number, and the condition that governs it."""

from functools import cached_property
from pathlib import Path

import numpy as np

from pounding import joint
from pounding.fragility import Fragility, hclpf, moments, widened
from pounding.plot.markup import answer_box, figure_parts, html_table, linked, write_page
from pounding.plot.style import WIDTH, WITH, WITHOUT, g_axis, log_scale, plt, save
from pounding.tables import cells_of, markdown, write_csv

from . import figures, report, spans, stability, struck
from .analysis import CONTACT, EXCEEDED, Analysis, gap_text, name_of, quantile
from .conditions import ALONE, Condition
from .controlled import CAPTION
from .study import Study

SHOWN_BY_ELEVATION = ("contact", "from [m]", "to [m]", "gap [m]", "closing mean [m]", "closing 84 % [m]", "closing largest [m]", "ratio",
                      "margin [m]")
SHOWN = (5.0, 20.0, 100.0)  # frequencies of the sensitivities unless the study shows others [Hz]


class Envelope:
    """`analyses`: Condition -> Analysis of all of its members; the first condition is the one that others are seen
    beside, and one on coherent ground is kept apart. Rows and figures of several pages are made once; `folder`: of the
    study, where the figures go."""

    def __init__(self, study: Study, analyses: dict, folder: Path):
        self.study, self.folder, self.linked = study, folder, list(analyses)
        self.coherent: Analysis | None = next((one for condition, one in analyses.items() if condition.coherent), None)
        self.analyses = {condition: one for condition, one in analyses.items() if not condition.coherent}
        self.conditions: list[Condition] = list(self.analyses)
        self.first: Analysis = self.analyses[self.conditions[0]]
        self.gap, self.level, self.channel, self.damping = figures.shown(self.first)
        self.notes: list[str] = []  # of histories of spans, a line each
        self.by_elevation: dict = {}  # level -> rows of each condition

    @property
    def frequencies(self) -> list:
        """Numbers of the shown frequencies among those of the study."""
        return self.first.frequencies_shown(SHOWN)

    def governing(self, values) -> tuple:
        """Number of the condition whose value is the largest, and its places."""
        at = int(np.argmax(values))
        return at, self.conditions[at].place

    def most_hit(self, event, gap: float | None, level: float) -> tuple:
        """Members in which an event comes about and their number, where their share is largest, and the places of that condition."""
        number = self.study.levels.index(level)
        counts = [(int(one.hits(event, gap)[:, number].sum()), one.study.samples) for one in self.analyses.values()]
        at, place = self.governing([count / samples for count, samples in counts])
        return *counts[at], place

    # Tables.

    @cached_property
    def full_order_rows(self) -> list:
        """Of each number at full order the row of the soil and state in which it is largest, with these; none of a study without."""
        most = {}
        for condition, one in self.analyses.items():
            for row in one.controlled.rows if one.controlled else ():
                key = row["quantity"], row["gap [m]"], row["pga [m/s2]"]
                if key not in most or row["value"] > most[key]["value"]:
                    most[key] = {**row, **condition.place}
        return list(most.values())

    @cached_property
    def joint_rows(self) -> list:
        rows = []
        for name in [*self.study.joints, "any"]:
            needed = [one.needed(None if name == "any" else one.outcomes.contacts.index(name)) for one in self.analyses.values()]
            for number, level in enumerate(self.study.levels):
                for part in EXCEEDED:
                    found = [quantile(values[:, number], 1 - part, self.study.confidence) for values in needed]
                    at, place = self.governing([value for value, _, _ in found])
                    largest, low, high = found[at]
                    rows.append({"joint": name, "pga [m/s2]": level, "exceeded in": f"{100 * part:g} %", "needed [m]": largest,
                                 "low": low, "high": high, **place})
        return rows

    def probability_rows(self) -> list:
        rows = []
        of_each = [one.probability_rows() for one in self.analyses.values()]
        for same in zip(*of_each):
            at, place = self.governing([row["probability"] for row in same])
            rows.append({**same[at], **place})
        return rows

    def spectra(self, gap: float | None, level: float) -> np.ndarray:
        """84 % of the members of a cell, shape (conditions, channels that move, damping ratios, frequencies)."""
        return np.array([moments(one.outcomes.spectra[one.of(gap, level)][:, self.first.channels]).high
                         for one in self.analyses.values()])

    def spectra_rows(self, gap: float | None, level: float) -> list:
        found, high = self.first.outcomes, self.spectra(gap, level)
        largest, governs_at = high.max(0), high.argmax(0)
        broad = widened(found.frequency, largest)
        return found.rows(self.first.channels, lambda at: {"p84": f"{largest[at]:.6g}", "p84_widened": f"{broad[at]:.6g}",
                                                           **self.conditions[governs_at[at]].place})

    def condition_rows(self) -> list:
        """Of each condition the joint needed, members that touch and the 84 % spectrum that figures show, at the level of
        the figures."""
        rows, number = [], self.study.levels.index(self.level)
        for condition, one in self.analyses.items():
            high = self.high(one)
            rows.append({**condition.place, "pga [m/s2]": self.level,
                         **{f"joint, {100 * part:g} % [m]": float(np.quantile(one.needed()[:, number], 1 - part)) for part in EXCEEDED},
                         **{f"touch, {1e3 * gap:g} mm": f"{int(one.hits(CONTACT, gap)[:, number].sum())} of {one.study.samples}"
                            for gap in self.study.gaps},
                         **{f"{one.outcomes.channels[self.channel]}, {one.outcomes.frequency[k]:.3g} Hz [m/s2]": float(high[k])
                            for k in self.frequencies}})
        return rows

    def high(self, one: Analysis, gap: float | None = None) -> np.ndarray:
        cell = one.of(self.gap if gap is None else gap, self.level)
        return moments(one.outcomes.spectra[cell][:, self.channel, self.damping]).high

    def elevation_runs(self, level: float) -> dict:
        """Condition -> rows of the joint by elevation in the joint of the figures, see report.elevation_runs; made once."""
        if level not in self.by_elevation:
            self.by_elevation[level] = {condition: report.elevation_runs(one, self.gap, level) for condition, one in self.analyses.items()}
        return self.by_elevation[level]

    def governing_by_elevation(self, level: float) -> dict:
        """Run, with pounding and apart -> of each contact and band of elevation the row of the soil and state in which it
        closes most, with these."""
        most = {}
        for condition, runs in self.elevation_runs(level).items():
            for run, rows in runs.items():
                for row in rows:
                    key = run, row["contact"], row["from [m]"]
                    if key not in most or row["closing largest [m]"] > most[key]["closing largest [m]"]:
                        most[key] = {**row, **condition.place}
        return {run: [row for key, row in most.items() if key[0] == run] for run in dict.fromkeys(key[0] for key in most)}

    def elevation_rows(self, levels) -> list:
        """Rows of governing_by_elevation at levels: least gap as built, closing, their ratio and margin."""
        return [{"level [m/s²]": level, "runs": run, **{name: row[name] for name in (*SHOWN_BY_ELEVATION, "soil", "state")}}
                for level in levels for run, rows in self.governing_by_elevation(level).items() for row in rows]

    @cached_property
    def span_rows(self) -> list:
        """Of what spans the joint, see spans.rows_of; its tables are written with it."""
        return spans.write(self.analyses, self.folder, self.gap)

    @cached_property
    def span_figure(self) -> list:
        return spans.figure(self.span_rows, self.analyses, self.folder, self.level)

    def make_histories(self) -> None:
        """Histories of the spans in the members that govern, at the level of the figures, from runs of their own."""
        self.notes = spans.write_histories(self.span_rows, self.analyses, self.folder, self.gap, self.level)

    @cached_property
    def mat_rows(self) -> list:
        """Stability of the mats, see stability.rows_of; its tables are written with it."""
        return stability.write(self.analyses, self.folder, self.gap)

    @cached_property
    def struck_rows(self) -> list:
        """Places that are struck, see struck.rows_of; their table is written with it."""
        return struck.write(self.analyses, self.folder, self.gap)

    def hclpf_rows(self) -> list:
        rows = []
        for event in self.first.events:
            for gap in self.first.gaps_of(event):
                fits = [one.fits(event)[gap] for one in self.analyses.values()]
                row = {"event": name_of(event), "gap [m]": gap_text(gap)}
                known = [fit for fit in fits if isinstance(fit, Fragility)]
                if len(known) < len(fits):
                    rows.append({**row, "refused": f"no curve in {len(fits) - len(known)} of {len(fits)} conditions"})
                    continue
                rows.append({**row, **hclpf([fit.theta for fit in known], [fit.beta for fit in known], self.study.uncertainty)})
        return rows

    # What moves the answer.

    @cached_property
    def sensitivity_rows(self) -> list:
        """Range of the needed joint (84 %, strongest level) and of the 84 % spectrum that figures show at some
        frequencies, by what moves it alone: soils in the first state, states on the first soil, coherence, the width of the
        joint, and the motion and whatever is drawn beside it, from 16 to 84 % of the samples."""
        first, rows = self.conditions[0], []
        needed = {condition: one.needed()[:, -1] for condition, one in self.analyses.items()}
        quantities = [("joint needed [m]", {condition: float(np.quantile(values, 0.84)) for condition, values in needed.items()},
                       {}, float(np.quantile(self.coherent.needed()[:, -1], 0.84)) if self.coherent else None, needed[first])]
        found = self.first.outcomes
        for k in self.frequencies:
            values = {condition: float(self.high(one)[k]) for condition, one in self.analyses.items()}
            by_gap = {f"{1e3 * gap:g} mm": float(self.high(self.first, gap)[k]) for gap in self.study.gaps}
            samples = found.spectra[self.first.of(self.gap, self.level), self.channel, self.damping, k]
            quantities.append((f"{found.channels[self.channel]} at {found.frequency[k]:.3g} Hz [m/s2]", values, by_gap,
                               float(self.high(self.coherent)[k]) if self.coherent else None, samples))
        for name, of_conditions, of_gaps, coherent, samples in quantities:
            ranges = {"soil": {one.soil: value for one, value in of_conditions.items() if one.state == first.state},
                      "state": {one.state: value for one, value in of_conditions.items() if one.soil == first.soil},
                      "coherence": {"as given": of_conditions[first], "coherent": coherent} if self.coherent else {},
                      "gap": of_gaps,
                      "motion": {"16 %": float(np.quantile(samples, 0.16)), "84 %": float(np.quantile(samples, 0.84))}}
            reference = of_conditions[first]
            for mover, values in ranges.items():
                if len(values) > 1:
                    low, high = min(values, key=values.get), max(values, key=values.get)
                    rows.append({"quantity": name, "moved by": mover, "low": values[low], "at": low, "high": values[high], "at ": high,
                                 "reference": reference, "range over reference": (values[high] - values[low]) / reference})
        return rows

    # Figures.

    @cached_property
    def sensitivity_figure(self) -> list:
        rows = self.sensitivity_rows
        names = list(dict.fromkeys(row["quantity"] for row in rows))
        figure, panels = plt.subplots(1, len(names), figsize=(1.35 * WIDTH, 2.6), sharey=False, squeeze=False)
        for axes, name in zip(panels[0], names):
            mine = [row for row in rows if row["quantity"] == name][::-1]
            scale = 1e3 if name.endswith("[m]") else 1.0
            axes.barh([row["moved by"] for row in mine], [scale * (row["high"] - row["low"]) for row in mine],
                      left=[scale * row["low"] for row in mine], color=WITHOUT, height=0.6)
            axes.axvline(scale * mine[0]["reference"], color=WITH, lw=1.5)
            axes.set(title=name.rsplit(" [", 1)[0], xlabel="mm" if scale > 1 else "m/s²")
        first = self.conditions[0].title
        return save(figure, self.folder, "sensitivity.png", "How far each thing moves the answer alone",
                    f"Bars: from the least to the largest value as soil, state, coherence or joint are changed alone, and from 16 to "
                    f"84 % of the samples (motion). Line: {first}. Joint: wide enough for 84 % of the samples at {self.study.levels[-1]:g} "
                    f"m/s²; spectra: 84 %, {100 * self.first.outcomes.damping[self.damping]:g} % damping, {self.study.joint_named(self.gap)}, "
                    f"{self.level:g} m/s².", columns=[[axes] for axes in panels[0]])

    @cached_property
    def spectra_figure(self) -> list:
        found = self.first.outcomes
        figure, axes = plt.subplots(figsize=(0.75 * WIDTH, 3.8))
        high = [self.high(one) for one in self.analyses.values()]
        for number, (condition, values) in enumerate(zip(self.conditions, high)):
            axes.plot(found.frequency, values, color=figures.COLOURS[number % len(figures.COLOURS)], lw=1, label=condition.title)
        axes.plot(found.frequency, widened(found.frequency, np.max(high, axis=0)), color="black", lw=1.8, label="envelope, widened by 15 %")
        log_scale(axes, "x", found.frequency)
        log_scale(axes, "y", np.array(high))
        axes.set(xlim=(found.frequency[0], found.frequency[-1]), xlabel="frequency [Hz]", ylabel="pseudo-acceleration [m/s²]",
                 title=f"{found.channels[self.channel]}, {self.study.joint_named(self.gap)}, {self.level / 9.81:.2g} g")
        axes.legend(loc="upper left", fontsize=9)
        g_axis(axes)
        return save(figure, self.folder, "envelope.png", "Floor spectra by soil and state",
                    f"84 % of the members in each condition, {100 * found.damping[self.damping]:g} % damping, and "
                    "their envelope with its peaks widened.")

    def told(self) -> list:
        lines = []
        for row in self.joint_rows:
            if row["joint"] == "any" and row["exceeded in"] == "5 %":
                lines.append(f"So that no joint closes in 95 % of the cases at {row['pga [m/s2]']:g} m/s2 it "
                             f"{self.study.width_told(row['needed [m]'])}; {governs(row)}{self.study.torsion.told}.")
        for gap in self.study.gaps:
            count, samples, place = self.most_hit(CONTACT, gap, self.study.levels[-1])
            lines.append(f"In a {self.study.joint_named(gap)} the buildings touch at {self.study.levels[-1]:g} m/s2 in "
                         f"{100 * count / samples:.3g} % of the cases at most; {governs(place)}.")
        moved = max((row for row in self.sensitivity_rows if row["quantity"] == "joint needed [m]" and row["moved by"] != "motion"),
                    key=lambda row: row["range over reference"], default=None)
        if moved:
            lines.append(f"The {moved['moved by']} moves the joint needed by {100 * moved['range over reference']:.3g} % "
                         f"({moved['at']}: {1e3 * moved['low']:.3g} mm, {moved['at ']}: {1e3 * moved['high']:.3g} mm).")
        return lines


def governs(place: dict) -> str:
    named = [f"{key} {place[key]}" for key in ("soil", "state") if place[key] != ALONE]
    return f"{' and '.join(named)} govern{'s' if len(named) == 1 else ''}"


def shown_at_full_order(one: Envelope, levels) -> list:
    """Rows of full_order_rows at levels: probabilities of contact and joints, with reduced runs alone beside them."""
    wanted = f"P({name_of(CONTACT)})", "joint"
    return [{name: value for name, value in row.items() if name not in ("full order alone", "correlation", "gain")}
            for row in one.full_order_rows if row["quantity"].startswith(wanted) and row["pga [m/s2]"] in levels]


def write(one: Envelope) -> tuple:
    """Writes tables and the page of the envelope; returns the page's path and what the terminal shows."""
    study, folder = one.study, one.folder
    place = folder / "spectra"
    place.mkdir(parents=True, exist_ok=True)
    for gap, level in one.first.cells:
        write_csv(place / f"gap-{gap_text(gap)}_pga-{level:g}.csv", one.spectra_rows(gap, level))
    tables = {"joint": one.joint_rows, "probability": one.probability_rows(), "conditions": one.condition_rows(),
              "sensitivity": one.sensitivity_rows, "hclpf": one.hclpf_rows(), **({"both_orders": one.full_order_rows} if one.full_order_rows else {})}
    for name, rows in tables.items():
        write_csv(folder / f"{name}.csv", rows)
    joint.write(folder, {f"{run}, {condition.folder}": rows for condition, runs in one.elevation_runs(one.level).items()
                         for run, rows in runs.items()})
    lines = one.told() + spans.told(one.span_rows, one.level) + one.notes
    pages = one.sensitivity_figure + one.spectra_figure + one.span_figure
    parts = [(f"{one.study.width_title} that would be needed [m]".capitalize(), tables["joint"]),
             ("Each soil and state", tables["conditions"]),
             *([(CAPTION, shown_at_full_order(one, study.levels))] if one.full_order_rows else []),
             *stability.parts(one.mat_rows),
             *([(struck.CAPTION, struck.shown(one.struck_rows))] if one.struck_rows else []),
             ("What moves the answer", tables["sensitivity"]), ("Largest probability of each event", tables["probability"]),
             ("Capacity of high confidence and low probability of failure (HCLPF)", tables["hclpf"])]
    box = answer_box(lines, any(row["hits"] for row in tables["probability"] if row["event"] == name_of(CONTACT)))
    shown = [*figure_parts(folder, pages), (spans.CAPTION, spans.table(one.span_rows, [one.level], one.first)),
             *((caption, html_table("", *cells_of(rows), text=(0,))) for caption, rows in parts)]
    after = linked("The study in each condition", [(condition.title, f"conditions/{condition.folder}/fragility.html")
                                                   for condition in one.linked])
    text = "\n".join(lines) + "\n\n" + "\n".join(markdown(caption, *cells_of(rows)) for caption, rows in parts[:3])
    return write_page(folder / "fragility.html", study.title, shown, answer=box, after=after, under=f"study {study.path.name}"), text
