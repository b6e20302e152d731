"""What a step at full order costs a member of an ensemble beside a run of its own, by kind of element and mesh: the differences of long
and short commands, in turns, so that reading and starting drop out."""

import json
import tempfile
from pathlib import Path

import numpy as np

from pounding.tables import leave, markdown, write_rows

from .ensembles import timed
from .shapes import BEAM, SHAPES, SHELL, SOLID, Shape

MEMBERS = 8
STEPS = 100, 600
CASES = {
    "split": Shape(SHAPES["split"].label, parameters="kind=3,size=0.27,thickness=0.5", element=SOLID),
    "extruded": Shape(SHAPES["extruded"].label, parameters="kind=2,size=0.045", element=SOLID),
    "triangles": Shape(SHAPES["triangles"].label, parameters="kind=0,size=0.05", element=SHELL),
    "lattice": Shape(SHAPES["lattice"].label, parameters="n=34", element=BEAM, mesh="lattice.geo"),
}
WATCHED = ["-probes", "top", "-top_structure", "plate", "-modes", 0, "-spectra_frequencies", 10,
           "-spectra_damping", 0.05, "-fields_interval", 0]


def words_of(case: Shape, scratch: Path, motion: Path) -> list:
    """Options of a scene of one plate or lattice, seen at its far corner."""
    return ["-options_file", case.model(scratch, motion)[1], *WATCHED, "-top_at", "34,34,34" if case.element == BEAM else "12,9,0"]


def measure(build: Path, scratch: Path, motion: Path, name: str, rounds: int) -> dict:
    """Medians of the time of a step of a single run, and of a member of an ensemble of eight, on one rank."""
    words, table = words_of(CASES[name], scratch, motion), scratch / "members.csv"
    write_rows(table, ["motion_level"], [[1 - member / 16] for member in range(MEMBERS)])

    def stepped(steps: float, more: list) -> tuple:
        """Time of the steps of a run, or of an ensemble [s], and the summary of a run."""
        with tempfile.TemporaryDirectory(dir=scratch) as folder:
            told = timed(build, 1, [*words, "-end_time", steps * step, "-output_interval", 50 * step, *more, "-output", folder])[1]
            found = json.loads((Path(folder) / "summary.json").read_text(encoding="utf-8")) if not more else {}
            return told or 1e-6 * found["microseconds_per_step"] * found["steps"], found

    step, turns = 1e-5, []
    found = stepped(2, [])[1]
    step, dofs = found["time_step"], found["structures"]["plate"]["dofs"]
    for _ in range(rounds):
        seconds = [(stepped(STEPS[1], more)[0] - stepped(STEPS[0], more)[0]) / (STEPS[1] - STEPS[0]) for more in ([], ["-ensemble", table])]
        turns.append((seconds[0], seconds[1] / MEMBERS, seconds[0] / seconds[1] * MEMBERS))
    alone, member, ratio = (float(np.median(column)) for column in zip(*turns))
    return {"elements": CASES[name].label, "dofs": dofs, "single_ns_per_dof": 1e9 * alone / dofs,
            "member_ns_per_dof": 1e9 * member / dofs, "members_for_one_run": ratio}


def write(folder: Path, rows: list) -> str:
    """Writes batches.md and batches.csv; returns the table."""
    text = markdown("Full order: a member of eight beside a run of its own", ["elements", "dofs", "a single run [ns per dof and step]",
                                                                             "a member of eight [ns]", "times"],
                    [list(row.values()) for row in rows])
    return leave(folder, "batches", text, rows)
