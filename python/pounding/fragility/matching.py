"""The motions of a study matched to the targets of its rules, as run/match would: each sample's components, at the largest level."""

import hashlib
import json
from dataclasses import dataclass, replace
from pathlib import Path

from pounding import UserError
from pounding.files import write_text
from pounding.motion_kinds import Motion
from pounding.motion_matching import Limits, match_motion, misses_of, text_of
from pounding.motion_rules import is_accepted, judge, read_rules
from pounding.motion_signals import MotionError, Signal
from pounding.tables import write_rows

from .study_file import Reader

SPARE = 1 / 3  # of the motions that a study chooses: candidates beside them, in place of those that are refused


@dataclass(frozen=True)
class Matching:
    """How motions are matched: times the target that is sought, turns at most, and limits."""

    aim: float
    turns: int
    limits: Limits

    def told(self) -> list:
        return [self.aim, self.turns, self.limits.peak_displacement, self.limits.final_displacement, self.limits.correlation]


def read(reader: Reader, rules: Path | None, correlation: float) -> Matching | None:
    """The block `match` of a study, whose components are to be correlated by less than a number. Throws UserError."""
    if "match" not in reader.values:
        return None
    if rules is None:
        raise UserError(f"{reader.path}: match: goes with motion_rules, whose targets the motions are matched to")
    one = reader.part("match", ("aim", "turns", "peak_displacement", "final_displacement"))
    return Matching(one.number("aim", 1.06, 0.0), one.whole("turns", 40, 1),
                    Limits(one.number("peak_displacement", 0.05, 0.0), one.number("final_displacement", 0.001, 0.0), correlation))


def make(study, made, step: float, folder: Path | None) -> None:
    """Puts matched records in the place of the study's motions; they are kept in the folder of the motions (`made`). match.csv goes
    into `folder`, if there is one. Throws UserError."""
    if not any(one.matched for one in study.axes.values()):
        found = _chosen(study, (_matched(study, made, step, number) for number in range(study.motion_count)))
        for axis, one in study.axes.items():
            own = tuple(each[axis] for each in found)
            study.axes[axis] = replace(one, records=tuple(each["file"] for each in own), target="", seeds=(), matched=own,
                                       options=(("unit", "m/s2"),), made_of=f"{one.kind}, matched to {study.rules.name}")
    if folder:
        write_rows(folder / "match.csv", ["sample", "axis", "motion", *ROW.values()],
                   ([number, axis, study.axes[axis].matched[number]["of"], *(f"{study.axes[axis].matched[number][name]:.6g}" for name in ROW)]
                    for number in range(study.motion_count) for axis in study.axes))


def _chosen(study, matched) -> list:
    """All samples; of those that the study chooses itself the first accepted ones, and others where there are too few."""
    accepted, refused = [], []
    for one in matched:
        (accepted if all(axis["accepted"] for axis in one.values()) or not study.wanted else refused).append(one)
        if study.wanted and len(accepted) == study.wanted:
            break
    return accepted + refused[:max(0, study.wanted - len(accepted))]


ROW = {"scale": "scale", "turns": "turns", "change": "change of peak displacement [%]", "final": "change of final displacement [mm]",
       "peak": "peak over that of the level"}


def _matched(study, made, step: float, number: int) -> dict:
    """Axis -> file, peak over the level and numbers of run/match, of a sample, and of the whole sample limits that it does not keep
    (`misses`) and whether it is `accepted`."""
    level, matching = study.levels[-1], study.matching
    motion = {axis: one.motions[number] for axis, one in study.axes.items()}
    told = [study.rules.read_text(encoding="utf-8"), level, matching.told(), [[made.name(*pair), study.axes[pair[0]].ratio_of(number)] for pair in motion.items()]]
    key = hashlib.sha256(str(told).encode()).hexdigest()[:12]
    kept = made.folder / f"matched-{key}.json"
    if not kept.is_file():
        components = {axis: Signal(f"{axis} {Path(str(one)).name}", step, made.record(axis, one, level * study.axes[axis].ratio_of(number)))
                      for axis, one in motion.items()}
        rules = read_rules(study.rules)
        try:
            found = match_motion(Motion(f"sample {number}", components), rules, level, matching.limits, None, matching.aim, matching.turns)
        except MotionError as error:
            raise UserError(f"{study.path}: match: {error}") from error
        signals = Motion(f"sample {number}", {axis: one.signal for axis, one in found.items()})
        misses = misses_of(found, matching.limits)
        accepted = not misses and is_accepted(judge(rules, [signals], level))
        values = {}
        for axis, one in found.items():
            file = (made.folder / f"matched-{key}-{axis}.csv").absolute()
            write_text(file, text_of(one, f"{one.record.name} times {one.scale:.6g}, matched to {study.rules.name}"))
            values[axis] = {"file": file.name, "of": str(motion[axis]), "peak": one.signal.peak / level, "scale": one.scale,
                            "turns": one.turns, "change": 100 * one.peak_change, "final": 1e3 * one.final_change,
                            "misses": misses, "accepted": accepted}
        write_text(kept, json.dumps(values))
        print(f"fragility: motion {number + 1} matched, {'accepted' if accepted else 'refused'}", flush=True)
    try:
        values = json.loads(kept.read_text(encoding="utf-8"))
        for axis in motion:
            values[axis]["file"] = str((made.folder / values[axis]["file"]).absolute())
    except (ValueError, KeyError, TypeError) as error:
        raise UserError(f"{kept} cannot be read ({' '.join(str(error).split())}); remove it") from error
    return values


def notes(study) -> list:
    """Sentences about matched motions, doubts where limits are not kept."""
    if not study.matching:
        return []
    first = next(iter(study.axes.values()))
    misses = [f"sample {number}: {miss}" for number, one in enumerate(first.matched) for miss in one["misses"]]
    return [f"The motions are matched to the targets of {study.rules.name}, match.csv.",
            *[f"Doubt: matched motions do not keep limits: {'; '.join(misses)}."] * bool(misses)]
