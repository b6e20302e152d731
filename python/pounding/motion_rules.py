"""Motions judged by a table of rules: what `pounding-spectra --accept RULES` does.

    from pounding.motion_rules import judge, motions_of, read_rules
    verdicts = judge(read_rules("rules.csv"), motions_of(signals, "xyz"), anchor=0.3 * 9.80665)

A rule is a row of a CSV file: a name, a kind, the least and the most that its number may be, and what it looks at.
docs/manual/motions.md lists kinds and columns; petsc-options/rules has tables to begin from.
"""

import argparse
import csv
import io
import os
import re
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .files import write_text
from .motion_kinds import KINDS, Bench, Finding, Motion, Rule, acceleration
from .motion_signals import STRONG, MotionError, read_signals

DIRECTIONS = ("x", "y", "z")
REFUSED = 3  # exit status
ALWAYS = ("name", "kind", "least", "most")
OPTIONAL = ("from", "to", "directions", "damping", "of", "window", "smoothing", "shift")
FORMS = {"from": 1, "to": 1, "damping": 1, "smoothing": 1, "shift": 1, "window": 2}


@dataclass(frozen=True)
class Verdict:
    """What became of a rule: `holds`, `refused`, `stated` where it has no limit, `idle` where it had nothing to look at; the
    worst finding, how many were looked at, and the motions that it refuses."""

    rule: Rule
    word: str
    worst: Finding
    looked_at: int = 0
    refused: tuple = ()
    motions: tuple = ()


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


def directions_of(text: str | None, count: int) -> str:
    """The directions of a text as x,y; the first `count` of x, y and z where there is none. Throws MotionError."""
    directions = re.sub(r"[\s,]", "", text or "xyz"[:count])
    if set(directions) - set(DIRECTIONS) or len(set(directions)) < len(directions):
        raise MotionError(f"--directions {text}: not different ones of x, y and z")
    return directions


def _shared_name(names: list) -> str:
    """The beginning that the names of components have in common, or all of them."""
    shared = os.path.commonprefix(names).rstrip("-_. :")
    return shared if len(shared) > 2 else " ".join(names)


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
        return "" if value is None or value != value else f"{value:.9g}" if isinstance(value, float) else str(value)

    rows = [("rule", "kind", "number", "unit", "least", "most", "motion", "component", "frequency_hz", "time_s", "looked_at", "refused",
             "verdict")]
    rows += [(one.rule.name, one.rule.kind, float(one.worst.number), KINDS[one.rule.kind].unit,
              *(value if np.isfinite(value) else None for value in (one.rule.least, one.rule.most)), one.worst.motion, one.worst.component,
              one.worst.frequency, one.worst.time, one.looked_at, len(one.refused), one.word) for one in verdicts]
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(map(cell, row) for row in rows)
    return text.getvalue()


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
    verdicts = judge(rules, motions_of(signals, directions_of(options.directions, len(signals))), anchor, program)
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
