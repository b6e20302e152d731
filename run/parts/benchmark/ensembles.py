"""What a member of an ensemble costs beside a run of its own: whole commands, in turns."""

import json
import re
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

from pounding.tables import leave, markdown, write_rows

from .workers import run_program

OUTPUTS = ["-modes", 0, "-output_interval", 1.8e-4, "-gap_interval", 1e-3]  # those of the studies


class Case(NamedTuple):
    """A scene whose two structures are reduced alike."""

    options: list
    structures: tuple
    reduction: dict
    levels: list  # factors on its motion


CASES = {
    "two-storey pair": Case(
        ["-options_file", "petsc-options/azalee/gap2.yaml", "-probes", "s1_floor2,s2_floor2", "-courant", 0.99],
        ("s1", "s2"), {"modal_vectors": 80, "modal_candidates": 400, "mass_scaling": 5.5e-5},
        [0.5, 1.0, 1.75, 2.5]),
    "plant pair on soil": Case(
        ["-options_file", "petsc-options/plant/medium.yaml"], ("block", "frame"), {"modal_vectors": 200},
        [0.25, 0.5, 0.75, 1.0]),
}


def write_members(path: Path, count: int, levels: list) -> None:
    """A table of so many members: every level of one motion, then of the next."""
    write_rows(path, ["motion_x_seed", "motion_level"],
               ([1 + member // len(levels), levels[member % len(levels)]] for member in range(count)))


def timed(build: Path, ranks: int, words: list) -> tuple:
    """Wall time of a whole command [s], and the seconds that it says its steps took."""
    since = time.monotonic()
    said = run_program(build, ranks, words)
    whole = time.monotonic() - since
    stepped = re.search(r"stepped in (\S+) s", said)
    return whole, float(stepped.group(1)) if stepped else None


def options_of(case: Case, scratch: Path) -> list:
    """Words of a scene whose bases lie in a folder."""
    words = case.options + OUTPUTS
    for structure in case.structures:
        words += [f"-{structure}_model", "modal", f"-{structure}_modal_basis", scratch / f"{structure}.basis"]
        for option, value in case.reduction.items():
            words += [f"-{structure}_{option}", value]
    return words


def compare(build: Path, case: Case, scratch: Path, ranks: int, members: int, rounds: int) -> dict:
    """Medians of a single run of the strongest level and of an ensemble, whose bases are there."""
    words = options_of(case, scratch)
    table, single = scratch / "members.csv", scratch / "single"
    write_members(table, members, case.levels)
    turns = []
    for _ in range(rounds):
        alone, _ = timed(build, 1, [*words, "-motion_level", case.levels[-1], "-output", single])
        with tempfile.TemporaryDirectory(dir=scratch) as folder:
            together, stepped = timed(build, ranks, [*words, "-ensemble", table, "-output", folder])
        turns.append((alone, together / members, stepped / members, alone / (together / members * ranks)))
    alone, member, stepped, ratio = (float(np.median(column)) for column in zip(*turns))
    with open(single / "summary.json") as file:
        steps = json.load(file)["steps"]
    return {"steps": steps, "ranks": ranks, "members": members, "single_seconds": alone,
            "member_seconds": member, "member_stepped_seconds": stepped, "members_for_one_run": ratio}


def measure(build: Path, counts: list, ranks: list, rounds: int) -> list:
    """A row per scene, number of ranks and of members: medians. A single run has one rank: as many as
    there are ranks are thought to run side by side."""
    rows = []
    for name, case in CASES.items():
        with tempfile.TemporaryDirectory(prefix="pounding-") as scratch:
            folder = Path(scratch)
            run_program(build, 1, [*options_of(case, folder), "-output", folder / "single", "-dry_run"])  # the bases
            rows += [{"scene": name, **compare(build, case, folder, count, members, rounds)}
                     for count in ranks for members in counts]
    return rows


def write(folder: Path, rows: list) -> str:
    """Writes ensembles.md and ensembles.csv; returns the table."""
    head = ["scene", "steps", "ranks", "members", "a single run, whole command [s]", "a member of the ensemble's [s]",
            "its steps and spectra [s]", "members per core in the time of a single run"]
    text = markdown("Ensembles beside single runs", head, [
        [row["scene"], row["steps"], row["ranks"], row["members"], row["single_seconds"],
         row["member_seconds"], row["member_stepped_seconds"], row["members_for_one_run"]]
        for row in rows])
    return leave(folder, "ensembles", text, rows)
