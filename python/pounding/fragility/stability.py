"""Stability of the mats in a study: their factors over the members of each soil and state, the worst instants of all, settlement
and slip, doubts where a factor is below what is asked."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pounding import UserError
from pounding.fragility import of_worst
from pounding.stability import CRITERIA, FORCES, MOTIONS, WORST, Found, found, instant_rows, read as read_mats, resolve, safe_name
from pounding.tables import write_csv

from .study_file import Reader, place_of

KEYS = ("asked", "level", "gravity", "mats")
CAPTION = "Mats: least factor over time of sliding, of overturning about the worst edge and of flotation"
MOVED = "Mats: settlement since the start, slip, and displacement that stays, of a micrometre or more [mm]"
LEAST = 1e-6  # of a motion that pages show [m]


@dataclass(frozen=True)
class Stability:
    """`asked`: factor that each of `mats` is to have up to `level` [m/s2]; `gravity` of a scene without [m/s2]."""

    path: Path
    asked: float
    level: float
    gravity: float | None
    mats: dict

    @property
    def options(self) -> dict:
        """Of the members' scene: the forces under the mats that stand on no contact."""
        held = [structure for structure, one in self.mats.items() if not one.contact]
        options = {"forces": ",".join(map(safe_name, held)) or "none"}
        for structure in held:
            options |= {f"{safe_name(structure)}_structure": structure, f"{safe_name(structure)}_kind": "reactions"}
        return options

    def resolve(self, facts: dict, contacts: list) -> list:
        """The mats as factors need them, but for those on a contact, which have none. Throws UserError."""
        place = f"{self.path}: stability"
        for name, one in self.mats.items():
            if one.contact and one.contact not in contacts:
                raise UserError(f"{place}: mats: {name}: {one.contact} is no contact of the scene; it has {', '.join(contacts) or 'none'}")
        return [resolve(one, facts, self.gravity, place) for one in self.mats.values() if not one.contact]


def read_block(reader: Reader, levels: list | None) -> Stability:
    """A block of asked factor, gravity and mats. Throws UserError."""
    level = reader.one_of("level", levels, levels[-1]) if levels else 0.0
    return Stability(reader.path, reader.number("asked", None, 0.0), level, reader.optional("gravity", 0.0), read_mats(reader))


def read(reader: Reader, levels: list, structures: str) -> Stability | None:
    """The block `stability` of a study; None where it has none. `structures`: of its scene, between commas. Throws UserError."""
    if reader.values.get("stability") is None:
        return None
    block = read_block(reader.part("stability", KEYS), levels)
    known = [name.strip() for name in structures.split(",")]
    unknown = next((name for name in block.mats if structures and name not in known), None)
    if unknown is not None:
        raise UserError(f"{reader.path}: stability: mats: {unknown} is no structure of the scene; it has {', '.join(known)}")
    return block


def of_member(analysis, member: int) -> list:
    """Found of each mat in a member, made once."""
    if member not in analysis.stability:
        names, forces = analysis.outcomes.force_names, analysis.outcomes.forces[member]
        analysis.stability[member] = [
            found(analysis.outcomes.force_time, forces[:, [names.index(f"{safe_name(mat.name)}.{part}") for part in FORCES]], mat)
            for mat in analysis.mats]
    return analysis.stability[member]


def of_cell(analysis, gap: float | None, level: float, number: int) -> list[Found]:
    """Found of a mat in the members of a cell, by sample."""
    return [of_member(analysis, member)[number] for member in analysis.of(gap, level)]


def motions_of(analysis, sample: int) -> str:
    """Records or seeds of a sample, axis by axis."""
    motion = analysis.design.motions[sample]
    return " ".join(axis.name_of(motion) for axis in analysis.study.axes.values())


def parts(rows: list, levels: list | None = None) -> list:
    """(Caption, rows) of the tables that pages have, of some levels alone where they are given."""
    rows = [row for row in rows if levels is None or row["pga [m/s2]"] in levels]
    moved = [{f"{key.removesuffix(' [m]')} [mm]" if key.endswith("[m]") else key: 1e3 * value if key.endswith("[m]") else value
              for key, value in row.items() if key != "sample"} for row in rows if row.get("largest [m]", 0) >= LEAST]
    found = (CAPTION, _factors(rows)), (MOVED, moved)
    return [(caption, table) for caption, table in found if table]


def _factors(rows: list) -> list:
    """Factors without some of their columns: of the edges of a mat the one that it is nearest to tipping over."""
    edges = {}
    for row in rows:
        if "least" not in row:
            continue
        key = row["mat"], row["criterion"].split(" ")[0], row["pga [m/s2]"], row["runs"]
        if key not in edges or row["least"] < edges[key]["least"]:
            edges[key] = row
    return [{key: value for key, value in row.items() if key not in ("sample", "would slide 84 % [m]")} for row in edges.values()]


def rows_of(analyses: dict, gap: float) -> tuple:
    """Of each mat, criterion and level, in a joint and apart, the factor's mean, 16 % and least over the members on the worst
    soil and in the worst state, and where the least is; and the worst instants of all members. `analyses`: Condition -> Analysis; the
    condition is None of a page of one alone."""
    first = next(iter(analyses.values()))
    rows, instants = [], []
    for number, mat in enumerate(first.mats):
        for c, criterion in enumerate(CRITERIA):
            for level in first.study.levels:
                for cell, words in ((gap, first.study.joint_named(gap)), (None, "apart")):
                    each = {condition: of_cell(one, cell, level, number) for condition, one in analyses.items()}
                    least = {condition: np.array([one.factor[c, 0] for one in some]) for condition, some in each.items()}
                    at = min(least, key=lambda condition: least[condition].min())
                    sample = int(least[at].argmin())
                    if not np.isfinite(least[at][sample]):
                        continue
                    slid = [[one.slid for one in some] for some in each.values()] if criterion == "sliding" else []
                    rows.append({"mat": mat.name, "criterion": criterion, "pga [m/s2]": level, "runs": words,
                                 "mean": float(min(values.mean() for values in least.values())),
                                 "16 %": float(min(np.quantile(values, 0.16) for values in least.values())),
                                 "least": float(least[at][sample]), "time [s]": float(each[at][sample].time[c, 0]), "sample": sample,
                                 "motions": motions_of(analyses[at], sample), **place_of(at),
                                 **({"would slide 84 % [m]": float(max(np.quantile(some, 0.84) for some in slid)),
                                     "would slide at most [m]": float(max(map(max, slid)))} if slid else {})})
                    instants += _worst_of(analyses, each, number, c, {"pga [m/s2]": level, "runs": words})
    return rows, instants


def moved_rows(analyses: dict, gap: float) -> list:
    """Of each mat whose base can move or that stands on a contact, and level, in a joint and apart, mean, 84 % and largest over the
    members of its motions, each on the soil and in the state in which it is largest."""
    first, rows = next(iter(analyses.values())), []
    for name, given in first.study.stability.mats.items():
        motions = {motion: lambda one, k=k: one.settled[:, one.bases.index(name), k] for k, motion in enumerate(MOTIONS) if name in first.outcomes.bases}
        if given.contact:
            motions["slid"] = lambda one, contact=given.contact: one.slip[:, one.contacts.index(contact)]
        for motion, of_members in motions.items():
            for level in first.study.levels:
                for cell, words in ((gap, first.study.joint_named(gap)), (None, "apart")):
                    each = {condition: of_members(one.outcomes)[one.of(cell, level)] for condition, one in analyses.items()}
                    found, at, sample = of_worst(each)
                    rows.append({"mat": name, "criterion": motion, "pga [m/s2]": level, "runs": words,
                                 **{f"{key} [m]": value for key, value in found.items()}, "sample": sample,
                                 "motions": motions_of(analyses[at], sample), **place_of(at)})
    return rows


def _worst_of(analyses: dict, each: dict, number: int, c: int, place: dict) -> list:
    """The worst instants of all members of a cell, with their numbers."""
    all_rows = []
    for condition, some in each.items():
        mat = analyses[condition].mats[number]
        for sample, one in enumerate(some):
            more = place | {"sample": sample, "motions": motions_of(analyses[condition], sample), **place_of(condition)}
            all_rows += [row for row in instant_rows(mat, one, more) if row["criterion"] == CRITERIA[c]]
    all_rows.sort(key=lambda row: row["factor"])
    return [{**row, "rank": rank} for rank, row in enumerate(all_rows[:WORST], 1)]


def write(analyses: dict, folder: Path, gap: float) -> list:
    """stability.csv and stability_instants.csv; returns the rows of the first, none of a study that asks for no stability."""
    if not next(iter(analyses.values())).study.stability:
        return []
    rows, instants = rows_of(analyses, gap)
    rows += moved_rows(analyses, gap)
    write_csv(folder / "stability.csv", rows)
    write_csv(folder / "stability_instants.csv", instants)
    return rows


def doubts(analysis) -> list:
    """A line for each mat with factors below what is asked, up to the level for which it is, and what is doubtful about the mats."""
    study, lines = analysis.study, [line for mat in analysis.mats for line in mat.doubts]
    for number, mat in enumerate(analysis.mats):
        missed = []
        for c, criterion in enumerate(CRITERIA):
            least = [(float(one.factor[c, 0]), level, cell, sample, float(one.time[c, 0])) for level in study.levels
                     if level <= study.stability.level for cell in [*study.gaps, None] for sample, one in enumerate(of_cell(analysis, cell, level, number))]
            factor, level, cell, sample, time = min(least, key=lambda one: one[0])
            if factor < study.stability.asked:
                where = "apart" if cell is None else f"{study.joint_named(cell)}"
                missed.append(f"{criterion} {factor:.4g} ({level:g} m/s2, {where}, sample {sample}, {time:.4g} s)")
        if missed:
            lines.append(f"Doubt: mat {mat.name} is below the factor of {study.stability.asked:g} that is asked: {'; '.join(missed)}.")
    return lines
