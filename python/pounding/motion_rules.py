"""Motions judged by a table of rules: what `pounding-spectra --accept RULES` does.

    from pounding.motion_rules import judge, motions_of, read_rules
    verdicts = judge(read_rules("rules.csv"), motions_of(signals, "xyz"), anchor=0.3 * 9.80665)

A rule is a row of a CSV file: a name, a kind, the least and the most that its number may be, and what it looks at.
docs/manual/motions.md lists kinds and columns; petsc-options/rules has tables to begin from.
"""

import argparse
import csv
import os
import re
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .files import write_text
from .motion_signals import (G, STRONG, MotionError, Signal, Target, correlation, mean_around, read_signals, read_target,
                             response_spectra)

DIRECTIONS = ("x", "y", "z")
REFUSED = 3  # exit status
FAR = 8.0  # spectra that differ from their target by so much at its highest frequency are in another unit
OCTAVE = 2.0  # a gap in a density is seen beside so much to both sides
ALWAYS = ("name", "kind", "least", "most")
OPTIONAL = ("from", "to", "directions", "damping", "of", "window", "smoothing", "shift")
SPECTRAL = ("grid", "target", "pga", "damping", "from", "to", "directions", "of")
OWN = ("directions",)


@dataclass(frozen=True)
class Motion:
    """Components that shake together: direction -> Signal."""

    name: str
    components: dict


@dataclass(frozen=True)
class Rule:
    """A row of a table; `cells` has the columns that are not empty, `place` the table and line for messages."""

    name: str
    kind: str
    least: float
    most: float
    cells: dict
    place: str
    folder: Path

    def fail(self, why: str):
        raise MotionError(f"{self.place} ({self.name}): {why}")

    def numbers(self, column: str, preset: tuple) -> tuple:
        return tuple(map(float, self.cells[column].split(":"))) if column in self.cells else preset

    def looks_at(self, direction: str) -> bool:
        return direction in self.cells.get("directions", "xyz")

    def peak(self, anchor: float | None) -> float:
        """Peak acceleration of the target [m/s2]."""
        if self.cells["pga"] != "anchor":
            return acceleration(self.cells["pga"])
        if anchor is None:
            self.fail("pga is `anchor`, and there is none; give --anchor, as 0.3g")
        return anchor

    def beyond(self, number: float) -> float:
        """How far a number is outside its limits, over them; below 0 inside."""
        over = (number - self.most) / (abs(self.most) or 1) if np.isfinite(self.most) else -np.inf
        below = (self.least - number) / (abs(self.least) or 1) if np.isfinite(self.least) else -np.inf
        return max(over, below)


@dataclass(frozen=True)
class Finding:
    """A number and where it was found."""

    number: float
    motion: str = ""
    component: str = ""
    frequency: float | None = None  # [Hz]
    time: float | None = None  # [s]


@dataclass(frozen=True)
class Verdict:
    """What became of a rule: `holds`, `refused`, `stated` where it has no limit, `idle` where it had nothing to look at; the
    worst finding, how many were looked at, and the motions that it refuses."""

    rule: Rule
    word: str
    worst: Finding
    looked_at: int = 0
    refused: tuple = ()
    motions: tuple = field(default_factory=tuple)


def acceleration(text: str) -> float:
    """A number with its unit [m/s2]. Throws MotionError."""
    found = re.fullmatch(r"\s*([\d.]+(?:[eE][-+]?\d+)?)\s*(g|m/s2|cm/s2)\s*", text)
    try:
        value = float(found[1]) * {"g": G, "m/s2": 1.0, "cm/s2": 0.01}[found[2]] if found else 0.0
    except ValueError:
        value = 0.0
    if not 0 < value < 1e3:
        raise MotionError(f"peak acceleration '{text}' is not a number above 0 with its unit, as 0.3g or 3m/s2")
    return value


def motions_of(signals: list, directions: str) -> list:
    """Motions of signals that follow one another, each with a component per direction. Throws MotionError."""
    if not directions or len(signals) % len(directions):
        raise MotionError(f"{len(signals)} components are no motions of {len(directions)} each; --directions names those of one "
                          "motion, as x,y")
    count = len(directions)
    parts = [dict(zip(directions, signals[k:k + count])) for k in range(0, len(signals), count)]
    names = [_shared_name([one.name for one in part.values()]) for part in parts]
    return [Motion(name if names.count(name) == 1 else f"{name} (motion {number})", part)
            for number, (name, part) in enumerate(zip(names, parts), 1)]


def _shared_name(names: list) -> str:
    """The beginning that the names of components have in common, or all of them."""
    shared = os.path.commonprefix(names).rstrip("-_. :")
    return shared if len(shared) > 2 else " ".join(names)


class Bench:
    """The motions that are judged and what was computed of them once."""

    def __init__(self, motions: list, anchor: float | None, program: Path | None):
        self.motions, self.anchor, self.program = motions, anchor, program
        self._spectra = {}

    def components(self, rule: Rule) -> list:
        """(motion, direction, signal) of all that a rule looks at."""
        return [(motion, direction, signal) for motion in self.motions for direction, signal in motion.components.items()
                if rule.looks_at(direction)]

    def spectra(self, rule: Rule) -> tuple:
        """Frequencies of a rule and the spectra of all components, direction and name of the motion before each."""
        key = rule.cells["grid"], float(rule.cells.get("damping", 0.05))
        if key not in self._spectra:
            signals = [signal for motion in self.motions for signal in motion.components.values()]
            try:
                self._spectra[key] = response_spectra(signals, *key, self.program)
            except MotionError as error:
                rule.fail(f"grid {key[0]}, damping {key[1]:g}: {error}")
        frequency, values = self._spectra[key]
        inside = between(rule, frequency)
        labels = [(motion, direction) for motion in self.motions for direction in motion.components]
        for motion, direction, signal in self.components(rule):
            if signal.length < 1 / frequency[inside][0]:
                rule.fail(f"motion {signal.name} lasts {signal.length:.3g} s, less than a period of {frequency[inside][0]:g} Hz; take "
                          "a longer motion, or give from")
        return frequency[inside], [(*label, row[inside]) for label, row in zip(labels, values) if rule.looks_at(label[1])]


def between(rule: Rule, frequency: np.ndarray) -> np.ndarray:
    low, high = float(rule.cells.get("from", 0)), float(rule.cells.get("to", np.inf))
    inside = (frequency >= low * (1 - 1e-9)) & (frequency <= high * (1 + 1e-9))
    if not inside.any():
        rule.fail(f"no frequency of the grid is from {low:g} to {high:g} Hz")
    return inside


def curves(rule: Rule, rows: list) -> list:
    """(name of the motion, direction, values) of each component, or of the mean of a set per direction."""
    if rule.cells.get("of", "each") == "each":
        return [(motion.name, direction, values) for motion, direction, values in rows]
    if len({motion.name for motion, _, _ in rows}) < 2:
        rule.fail("of is `mean`, and there is one motion; give the set of them")
    found = {}
    for _, direction, values in rows:
        found.setdefault(direction, []).append(values)
    return [("mean of the set", direction, np.mean(values, 0)) for direction, values in found.items()]


def ratios(rule: Rule, bench: Bench) -> list:
    """(motion, direction, frequencies, spectrum over target) of all that a spectral rule looks at."""
    frequency, rows = bench.spectra(rule)
    target = own_target(rule).at(frequency, rule.peak(bench.anchor))
    for motion, direction, values in rows:
        if not 1 / FAR < values[-1] / target[-1] < FAR:
            rule.fail(f"motion {motion.name}, {direction}: {values[-1]:.3g} m/s2 at {frequency[-1]:g} Hz beside a target of {target[-1]:.3g}: is "
                      "the unit of the motion, or of pga, right?")
    return [(name, direction, frequency, values / target) for name, direction, values in curves(rule, rows)]


def own_target(rule: Rule, power: bool = False) -> Target:
    try:
        return read_target(rule.cells["target"], rule.folder, power)
    except MotionError as error:
        rule.fail(str(error))


def points_below(rule: Rule, bench: Bench) -> list:
    return [Finding(int((ratio < 1 - 1e-9).sum()), name, direction, float(f[ratio.argmin()]))
            for name, direction, f, ratio in ratios(rule, bench)]


def largest_below(rule: Rule, bench: Bench) -> list:
    return [Finding(float(max(100 * (1 - ratio.min()), 0)), name, direction, float(f[ratio.argmin()]))
            for name, direction, f, ratio in ratios(rule, bench)]


def largest_above(rule: Rule, bench: Bench) -> list:
    return [Finding(float(max(100 * (ratio.max() - 1), 0)), name, direction, float(f[ratio.argmax()]))
            for name, direction, f, ratio in ratios(rule, bench)]


def longest_run(below: np.ndarray) -> tuple:
    """Length of the longest run of what is true, and the place of its middle."""
    ends = np.flatnonzero(np.diff(np.concatenate([[0], below.astype(int), [0]])))
    if not len(ends):
        return 0, 0
    first, last = max(ends.reshape(-1, 2), key=lambda pair: pair[1] - pair[0])
    return int(last - first), int(first + last - 1) // 2


def neighbours_below(rule: Rule, bench: Bench) -> list:
    found = []
    for name, direction, f, ratio in ratios(rule, bench):
        length, middle = longest_run(ratio < 1 - 1e-9)
        found.append(Finding(length, name, direction, float(f[middle]) if length else None))
    return found


def points_per_decade(rule: Rule, bench: Bench) -> list:
    """The fewest, where two neighbours of the grid are furthest apart."""
    frequency = bench.spectra(rule)[0]
    steps = np.diff(np.log10(frequency))
    if not len(steps):
        rule.fail("its grid has one frequency")
    return [Finding(float(round(1 / steps.max(), 6)), "", "", float(frequency[steps.argmax()]))]


def densities(rule: Rule, bench: Bench, low: float, high: float) -> tuple:
    """Frequencies, and (motion, direction, density) of all components, each the mean from low to high times a frequency."""
    frequency, _ = bench.spectra(rule)
    window = rule.numbers("window", STRONG)
    rows = [(motion, direction, mean_around(*signal.power(window), frequency, low, high))
            for motion, direction, signal in bench.components(rule)]
    return frequency, rows


def psd_ratio(rule: Rule, bench: Bench) -> list:
    width = rule.numbers("smoothing", (20.0,))[0] / 100
    frequency, rows = densities(rule, bench, 1 - width, 1 + width)
    target = own_target(rule, power=True).at(frequency, rule.peak(bench.anchor))
    return [Finding(float((values / target).min()), name, direction, float(frequency[(values / target).argmin()]))
            for name, direction, values in curves(rule, rows)]


def psd_gap(rule: Rule, bench: Bench) -> list:
    width = rule.numbers("smoothing", (20.0,))[0] / 100
    frequency, near = densities(rule, bench, 1 - width, 1 + width)
    below, above = (densities(rule, bench, *ends)[1] for ends in ((1 / OCTAVE, 1), (1, OCTAVE)))
    found = []
    for (name, direction, values), *flanks in zip(*(curves(rule, rows) for rows in (near, below, above))):
        depth = values / np.sqrt(flanks[0][2] * flanks[1][2])
        found.append(Finding(float(depth.min()), name, direction, float(frequency[depth.argmin()])))
    return found


def of_each(number: Callable) -> Callable:
    """A rule on a number, and the time at which it is found, of each component alone."""
    def look(rule: Rule, bench: Bench) -> list:
        found = [(*number(rule, signal), motion.name, direction) for motion, direction, signal in bench.components(rule)]
        return [Finding(value, name, direction, None, time) for value, time, name, direction in found]

    return look


def _strong(rule: Rule, signal: Signal) -> tuple:
    first, last = signal.strong_part(rule.numbers("window", STRONG))
    return last - first, first


def _largest(values: np.ndarray) -> float:
    return float(abs(values).max())


def _when(signal: Signal, values: np.ndarray) -> float:
    return float(abs(values).argmax() * signal.step)


def _moving(signal: Signal) -> Signal:
    signal.strong_part()
    return signal


def correlated(rule: Rule, bench: Bench) -> list:
    """Of the components of a motion, or of the motions of a set along each direction."""
    shift, found = rule.numbers("shift", (0.0,))[0], []
    if rule.cells.get("of", "components") == "components":
        for motion in bench.motions:
            ways = [way for way in motion.components if rule.looks_at(way)]
            for i, j in [(i, j) for j in range(len(ways)) for i in range(j)]:
                value, time = correlation(motion.components[ways[i]], motion.components[ways[j]], shift)
                found.append(Finding(abs(value), motion.name, f"{ways[i]} {ways[j]}", None, time if shift else None))
        return found
    for j, other in enumerate(bench.motions):
        for one in bench.motions[:j]:
            for way in filter(rule.looks_at, one.components):
                value, time = correlation(one.components[way], other.components[way], shift)
                found.append(Finding(abs(value), f"{one.name}, {other.name}", way, None, time if shift else None))
    return found


def count(_rule: Rule, bench: Bench) -> list:
    return [Finding(len(bench.motions))]


@dataclass(frozen=True)
class Kind:
    """How a kind of rule finds its numbers, their unit, and the columns that it has beside those of every rule."""

    look: Callable
    unit: str
    columns: tuple


KINDS = {
    "points_below": Kind(points_below, "", SPECTRAL),
    "largest_below": Kind(largest_below, "%", SPECTRAL),
    "largest_above": Kind(largest_above, "%", SPECTRAL),
    "neighbours_below": Kind(neighbours_below, "", SPECTRAL),
    "points_per_decade": Kind(points_per_decade, "", ("grid", "from", "to")),
    "psd_ratio": Kind(psd_ratio, "", ("grid", "target", "pga", "from", "to", "directions", "of", "window", "smoothing")),
    "psd_gap": Kind(psd_gap, "", ("grid", "from", "to", "directions", "of", "window", "smoothing")),
    "time_step": Kind(of_each(lambda _, one: (one.step, None)), "s", OWN),
    "length": Kind(of_each(lambda _, one: (one.length, None)), "s", OWN),
    "strong_duration": Kind(of_each(_strong), "s", (*OWN, "window")),
    "peak_acceleration": Kind(of_each(lambda _, one: (one.peak, _when(one, one.values))), "m/s2", OWN),
    "peak_displacement": Kind(of_each(lambda _, one: (_largest(one.displacement), _when(one, one.displacement))), "m", OWN),
    "final_velocity": Kind(of_each(lambda _, one: (abs(float(one.velocity[-1])), one.length)), "m/s", OWN),
    "final_displacement": Kind(of_each(lambda _, one: (abs(float(one.displacement[-1])), one.length)), "m", OWN),
    "v_over_a": Kind(of_each(lambda _, one: (_largest(one.velocity) / _moving(one).peak, _when(one, one.velocity))), "s", OWN),
    "ad_over_v2": Kind(of_each(lambda _, one: (_moving(one).peak * _largest(one.displacement) / _largest(one.velocity) ** 2,
                                               _when(one, one.displacement))), "", OWN),
    "correlation": Kind(correlated, "", (*OWN, "of", "shift")),
    "motions": Kind(count, "", ()),
}
FORMS = {"from": 1, "to": 1, "damping": 1, "smoothing": 1, "shift": 1, "window": 2}


def _limit(rule_place: str, column: str, text: str, preset: float) -> float:
    try:
        value = float(text) if text else preset
    except ValueError:
        value = np.nan
    if np.isnan(value):
        raise MotionError(f"{rule_place}: {column}: '{text}' is not a number")
    return value


def _check_cells(rule: Rule) -> None:
    """Throws MotionError for cells that the kind has not, lacks, or cannot read."""
    kind = KINDS[rule.kind]
    for column in rule.cells:
        if column not in kind.columns:
            rule.fail(f"{column}: '{rule.cells[column]}': a rule of the kind {rule.kind} has no {column}; leave it empty")
    for column in kind.columns:
        if column not in rule.cells and column not in OPTIONAL:
            rule.fail(f"{column} is empty; a rule of the kind {rule.kind} needs it")
    for column, wanted in FORMS.items():
        if column not in rule.cells:
            continue
        try:
            values = rule.numbers(column, ())
        except ValueError:
            values = ()
        if len(values) != wanted or not all(0 <= value < np.inf for value in values):
            rule.fail(f"{column}: '{rule.cells[column]}' is not {'two numbers as 5:75' if wanted == 2 else 'a number from 0 on'}")
    if "window" in rule.cells and not 0 <= rule.numbers("window", STRONG)[0] < rule.numbers("window", STRONG)[1] <= 100:
        rule.fail(f"window: '{rule.cells['window']}' is not two parts of the Arias intensity in %, as 5:75")
    if not 0 < rule.numbers("smoothing", (20.0,))[0] < 100 or not 0 <= rule.numbers("damping", (0.05,))[0] < 1:
        rule.fail("smoothing is above 0 and below 100 %, damping from 0 to below 1")
    if set(rule.cells.get("directions", "x")) - set("xyz"):
        rule.fail(f"directions: '{rule.cells['directions']}' is not some of x y z")
    choices = ("components", "motions") if rule.kind == "correlation" else ("each", "mean")
    if rule.cells.get("of", choices[0]) not in choices:
        rule.fail(f"of: '{rule.cells['of']}' is neither {choices[0]} nor {choices[1]}")
    if rule.cells.get("pga", "anchor") != "anchor":
        try:
            acceleration(rule.cells["pga"])
        except MotionError as error:
            rule.fail(f"pga: {error}")


def read_rules(path: Path | str) -> list:
    """The rules of a table. Throws MotionError."""
    path = Path(path)
    if not path.is_file():
        raise MotionError(f"{path}: no such table of rules")
    lines = [(number, line) for number, line in enumerate(path.read_text(encoding="utf-8-sig", errors="replace").splitlines(), 1)
             if line.strip(" ,\t") and not line.startswith("#")]
    rows = list(csv.reader(line for _, line in lines))
    names = [name.strip() for name in rows[0]] if rows else []
    known = dict.fromkeys([*ALWAYS, *(column for kind in KINDS.values() for column in kind.columns)])
    for column in names:
        if column not in known:
            raise MotionError(f"{path}: column '{column}' is none of {', '.join(known)}")
    if len(rows) < 2 or "name" not in names or "kind" not in names:
        raise MotionError(f"{path}: holds no rule: a line of names, at least name and kind, and a row for each rule")
    rules = []
    for (number, _), row in zip(lines[1:], rows[1:]):
        place = f"{path}, line {number}"
        if len(row) > len(names):
            raise MotionError(f"{place}: {len(row)} cells below {len(names)} names; commas in a cell need quotation marks")
        cells = {name: cell.strip() for name, cell in zip(names, row) if cell.strip()}
        if "directions" in cells:
            cells["directions"] = re.sub(r"[\s,]", "", cells["directions"])
        name, kind = cells.pop("name", ""), cells.pop("kind", "")
        if kind not in KINDS:
            raise MotionError(f"{place}: kind '{kind}' is none of {', '.join(KINDS)}")
        least, most = (_limit(place, column, cells.pop(column, ""), preset) for column, preset in (("least", -np.inf),
                                                                                                    ("most", np.inf)))
        rule = Rule(name or kind, kind, least, most, cells, place, path.parent)
        if least > most:
            rule.fail(f"least {least:g} is above most {most:g}")
        _check_cells(rule)
        rules.append(rule)
    if not any(np.isfinite([rule.least, rule.most]).any() for rule in rules):
        raise MotionError(f"{path}: no rule has a least or a most, so nothing would ever be refused")
    return rules


def source_of(path: Path | str) -> str:
    """What the table says of its source, in a comment `# source: ...`, or ''."""
    found = re.search(r"^# *source: *(.+)$", Path(path).read_text(encoding="utf-8", errors="replace"), re.MULTILINE | re.IGNORECASE)
    return found[1].strip() if found else ""


def judge(rules: list, motions: list, anchor: float | None = None, program: Path | None = None) -> list:
    """A verdict for each rule. `anchor` [m/s2]: the peak of targets whose pga is `anchor`. Throws MotionError where a rule
    cannot be looked at, and where none has anything to look at."""
    bench, found = Bench(motions, anchor, program), []
    for rule in rules:
        findings = rule_findings(rule, bench)
        if not findings:
            found.append(Verdict(rule, "idle", Finding(float("nan"))))
            continue
        worst = max(findings, key=lambda one: rule.beyond(one.number))
        if not np.isfinite([rule.least, rule.most]).any():
            found.append(Verdict(rule, "stated", max(findings, key=lambda one: one.number), len(findings)))
            continue
        refused = tuple(one for one in findings if not rule.least <= one.number <= rule.most)
        found.append(Verdict(rule, "refused" if refused else "holds", worst, len(findings), refused,
                             tuple(dict.fromkeys(one.motion for one in refused if one.motion))))
    if all(one.word == "idle" for one in found):
        raise MotionError("no rule has anything to look at in these motions; do their directions fit?")
    return found


def rule_findings(rule: Rule, bench: Bench) -> list:
    """Findings of a rule; none where the motions have none of its directions, or one of what is compared."""
    if "directions" in KINDS[rule.kind].columns and not bench.components(rule):
        return []
    return KINDS[rule.kind].look(rule, bench)


def is_accepted(verdicts: list) -> bool:
    return all(one.word != "refused" for one in verdicts)


def limits_text(rule: Rule) -> str:
    return " ".join(f"{sign} {value:g}" for sign, value in ((">=", rule.least), ("<=", rule.most)) if np.isfinite(value)) or "-"


def place_text(one: Finding) -> str:
    parts = [f"{one.frequency:.4g} Hz"] if one.frequency is not None else []
    parts += [f"{one.time:.4g} s"] if one.time is not None else []
    return ", ".join([*parts, *filter(None, (one.component, one.motion))])


def lines_of(verdicts: list, source: str) -> list:
    """The verdicts as lines of a terminal."""
    rows = [("rule", "number", "limits", "verdict", "place")]
    for one in verdicts:
        unit = KINDS[one.rule.kind].unit
        number = "-" if one.word == "idle" else f"{one.worst.number:.4g} {unit}".rstrip()
        share = f" {len(one.refused)} of {one.looked_at}" if one.word == "refused" and one.looked_at > 1 else ""
        rows.append((one.rule.name, number, limits_text(one.rule), one.word + share, place_text(one.worst)))
    widths = [max(len(row[k]) for row in rows) for k in range(4)]
    lines = ["  ".join([*(cell.ljust(width) for cell, width in zip(row, widths)), row[4]]).rstrip() for row in rows]
    refused = [one.rule.name for one in verdicts if one.word == "refused"]
    idle = [one.rule.name for one in verdicts if one.word == "idle"]
    held = sum(one.word == "holds" for one in verdicts)
    end = f"refused by {', '.join(refused)}" if refused else f"accepted: {held} rules hold"
    end += f"; nothing to look at for {', '.join(idle)}" if idle else ""
    return [*lines, "", f"{end} ({source or 'the table names no source'})"]


def table_of(verdicts: list) -> str:
    """The verdicts as a CSV file, a row for each rule."""
    def cell(value) -> str:
        text = "" if value is None or value != value else f"{value:.9g}" if isinstance(value, float) else str(value)
        return f'"{text}"' if "," in text else text

    rows = [("rule", "kind", "number", "unit", "least", "most", "motion", "component", "frequency_hz", "time_s", "looked_at", "refused",
             "verdict")]
    rows += [(one.rule.name, one.rule.kind, float(one.worst.number), KINDS[one.rule.kind].unit,
              *(value if np.isfinite(value) else None for value in (one.rule.least, one.rule.most)), one.worst.motion, one.worst.component,
              one.worst.frequency, one.worst.time, one.looked_at, len(one.refused), one.word) for one in verdicts]
    return "".join(",".join(map(cell, row)) + "\n" for row in rows)


def write_table(path: Path, text: str) -> None:
    """Takes the place of an earlier table of verdicts, and of nothing else. Throws MotionError."""
    if path.exists() and not path.is_file():  # /dev/stdout
        path.write_text(text, encoding="utf-8")
        return
    if path.exists() and not path.read_text(encoding="utf-8", errors="replace").startswith("rule,kind,"):
        raise MotionError(f"--output {path}: there is a file of that name that is no table of verdicts; give another file")
    write_text(path, text)


def main(words: list) -> int:
    """The program's path and the words of its command line; 0 for motions that are accepted, REFUSED for others."""
    program = Path(words[0])
    parser = argparse.ArgumentParser(prog="pounding-spectra", allow_abbrev=False, add_help=False)
    for name in ("accept", "anchor", "directions", "output"):
        parser.add_argument(f"--{name}", f"-{name}")
    options, reading = parser.parse_known_args(words[1:])
    rules = read_rules(options.accept)
    anchor = acceleration(options.anchor) if options.anchor else None
    signals = read_signals(reading, program)
    directions = re.sub(r"[\s,]", "", options.directions or "xyz"[:len(signals)])
    if set(directions) - set(DIRECTIONS) or len(set(directions)) < len(directions):
        raise MotionError(f"--directions {options.directions}: not different ones of x, y and z")
    verdicts = judge(rules, motions_of(signals, directions), anchor, program)
    if options.output:
        write_table(Path(options.output), table_of(verdicts))
    print("\n".join(lines_of(verdicts, source_of(options.accept))))
    return 0 if is_accepted(verdicts) else REFUSED


def run() -> int:
    try:
        status = main(sys.argv[1:])
        sys.stdout.flush()
        return status
    except (MotionError, OSError) as error:
        print(f"pounding-spectra: {' '.join(str(error).split())}", file=sys.stderr)
    except KeyboardInterrupt:
        print("pounding-spectra: interrupted", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(run())
