"""Places that are struck in the members of a study: largest mean pressure over areas of the faces, and force per length of edge, beside
strengths; over soils and states the largest, and doubts where one is above its strength."""

from dataclasses import dataclass
from pathlib import Path

from pounding.fragility import of_worst
from pounding.struck import STRENGTHS, Strengths, Window, beside, placed, read_strengths
from pounding.tables import write_csv

from .spans import motions_of
from .study_file import Reader, place_of

KEYS = ("areas", "edges", "level", "contacts", *STRENGTHS)
CAPTION = "Places that are struck: largest mean pressure over areas of the faces and force along edges, beside their strengths"


@dataclass(frozen=True)
class Struck:
    """`windows` over which means are taken; `level`: up to which strengths are asked for [m/s2]."""

    windows: list
    level: float
    strengths: Strengths

    @property
    def options(self) -> dict:
        """Of the members' scene."""
        return {f"struck_{key}": ",".join(f"{one.size:.9g}" for one in self.windows if one.is_edge is edges) or "0"
                for key, edges in (("areas", False), ("edges", True))}


def read(reader: Reader, levels: list) -> Struck | None:
    """The block `struck` of a study; None where it has none. Throws UserError."""
    if reader.values.get("struck") is None:
        return None
    one = reader.part("struck", KEYS)
    windows = [Window(size, key == "edges") for key in ("areas", "edges") if key in one.values for size in one.increasing(key)]
    if not windows:
        one.refuse("", "give areas, in m2, or edges, in m")
    return Struck(windows, one.one_of("level", levels, levels[-1]), read_strengths(one))


def rows_of(analyses: dict, gap: float) -> list:
    """A row per contact, window and level: mean, 84 % and largest over the samples in a joint, each on the soil and in the state in
    which it is largest, beside the strength; of the largest when, where, and in which sample, soil and state."""
    first = next(iter(analyses.values()))
    study, rows = first.study, []
    for c, contact in enumerate(first.outcomes.contacts):
        for w, window in enumerate(study.struck.windows):
            strength = study.struck.strengths.of(contact).of(window)
            for level in study.levels:
                each = {condition: one.outcomes.struck[one.of(gap, level), c, w] for condition, one in analyses.items()}
                means = {condition: values[:, 0] / window.size for condition, values in each.items()}
                found, at, sample = of_worst(means)
                row = {"contact": contact, "over": window.name, "unit": window.unit, "pga [m/s2]": level, **found,
                       **beside(strength, found["84 %"], "84 %"), **beside(strength, means[at][sample])}
                if row["largest"] > 0:
                    row |= {**placed(each[at][sample]), "sample": sample, "motions": motions_of(analyses[at], sample), **place_of(at)}
                rows.append(row)
    return rows


def shown(rows: list) -> list:
    """The rows that pages have, of what is struck: in MPa and kN/m, without some of their columns."""
    found = []
    for row in rows:
        if row["largest"] > 0:
            scale, unit = (1e3, "kN/m") if row["unit"] == "N/m" else (1e6, "MPa")
            found.append({"contact": row["contact"], "over": row["over"], "unit": unit, "pga [m/s2]": row["pga [m/s2]"],
                          **{key: row[key] and row[key] / scale for key in ("mean", "84 %", "largest", "strength")},
                          **{key: row[key] for key in ("largest over strength", "time [s]")},
                          "at [m]": ", ".join(f"{row[f'{axis} [m]']:.3g}" for axis in "xyz"),
                          **{key: row[key] for key in ("soil", "state") if key in row}})
    return found


def write(analyses: dict, folder: Path, gap: float) -> list:
    """struck.csv; returns its rows, none of a study that does not ask for them."""
    if not next(iter(analyses.values())).study.struck:
        return []
    rows = rows_of(analyses, gap)
    write_csv(folder / "struck.csv", rows)
    return rows


def doubts(analysis) -> list:
    """A line for each contact with a mean above its strength in some joint, up to the level for which it is asked."""
    study, lines = analysis.study, []
    for c, contact in enumerate(analysis.outcomes.contacts if study.struck else ()):
        passed = []
        for w, window in enumerate(study.struck.windows):
            strength = study.struck.strengths.of(contact).of(window)
            cells = [(gap, level) for gap in study.gaps for level in study.levels if level <= study.struck.level]
            found = [(analysis.outcomes.struck[analysis.of(*cell), c, w, 0].max() / window.size, *cell) for cell in cells]
            mean, gap, level = max(found, key=lambda one: one[0])
            if mean > strength:
                passed.append(f"{mean:.4g} {window.unit} over {window.name}, {mean / strength:.3g} times its strength ({level:g} m/s2, "
                              f"{study.joint_named(gap)})")
        if passed:
            lines.append(f"Doubt: contact {contact} is struck beyond its strength: {'; '.join(passed)}.")
    return lines
