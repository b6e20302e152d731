"""What contact costs where whole faces of bricks close at once: its part of a step by the number of
rows, beside the step of a building of half a million dofs."""

import json
import tempfile
from pathlib import Path

import numpy as np

from pounding.tables import by_ranks, leave

from .workers import run_program

YOUNG, DENSITY = 30e9, 2400.0  # of concrete
STEPS = 60  # of the short run; the long one has twice as many, all of them in contact
SHALLOW = (4, 4)  # cells away from the face, of the two blocks
DEEP = (9, 11)  # these give half a million dofs with 10,000 rows
HALF_A_MILLION = 500_000  # dofs
LARGE = 100  # nodes along an edge of the case that has DEEP blocks


def structure(name: str, mesh: str, start: float, depth: int, cells: int) -> list:
    return [f"-{name}_mesh", f"tests/meshes/{mesh}.geo",
            f"-{name}_mesh_set", f"x0={start},nx={depth},ny={cells},nz={cells}",
            f"-{name}_body_element", "hex8", f"-{name}_body_material", "concrete"]


def scene(first_cells: int, second_cells: int, depth: tuple) -> tuple:
    """Two cubes of 1 m that meet at 1 m/s from the first step on: words up to the end time, and the step."""
    shortest = 1 / max(first_cells, second_cells, *depth)
    step = 0.3 * shortest / np.sqrt(YOUNG / DENSITY)
    words = ["-structures", "one,two", "-contacts", "joint", "-joint_secondary", "one:x_max", "-joint_primary",
             "two:x_min", "-joint_gap", 0, "-one_initial_velocity", "1,0,0", "-probes", "back", "-back_structure",
             "one", "-back_group", "x_min", "-modes", 0, "-material_concrete_young", YOUNG,
             "-material_concrete_poisson", 0.2, "-material_concrete_density", DENSITY, "-time_step", repr(float(step)),
             *structure("one", "box", -1, depth[0], first_cells), *structure("two", "box", 0, depth[1], second_cells)]
    return words + ["-end_time"], step


def run(build: Path, ranks: int, words: list, step: float, steps: int) -> dict:
    """The summary of a run of so many steps."""
    with tempfile.TemporaryDirectory() as folder:
        end = repr(float(step * (steps - 0.5)))
        run_program(build, ranks, [*words, end, "-output_interval", end, "-output", folder])
        with open(Path(folder) / "summary.json") as file:
            return json.load(file)


def cost(build: Path, ranks: int, first: int, second: int, depth: tuple, rounds: int) -> dict:
    """Medians of a pair of faces; what both a short and a long run do is left out."""
    words, step = scene(first, second, depth)
    turns = []
    for _ in range(rounds):
        short, long = (run(build, ranks, words, step, n * STEPS) for n in (1, 2))
        turns.append([1e6 * (long["phases"][phase] - short["phases"][phase])
                      / (long["steps"] - short["steps"]) for phase in ("contact", "step")])
    contact, inner = (float(np.median(column)) for column in zip(*turns))
    return {"rows": long["contact_rows"], "coupled_rows": long["coupled_rows"], "ranks": ranks,
            "dofs": sum(part["dofs"] for part in long["structures"].values()),
            "contact_microseconds": contact, "step_microseconds": inner,
            "residual": long["impacts"]["complementarity_residual"],
            "megabytes": long["peak_memory"] / 1e6}


def measure(build: Path, edges: list, ranks: list, rounds: int) -> list:
    """Unmatched faces of so many nodes along an edge."""
    rows = []
    for count in ranks:
        for nodes in edges:
            depth = DEEP if nodes >= LARGE else SHALLOW
            second = max(1, round(0.77 * (nodes - 1)))
            rows.append(cost(build, count, nodes - 1, second, depth, rounds))
    for row in rows:
        # The largest building gives the cost of a dof.
        largest = max((other for other in rows if other["ranks"] == row["ranks"]), key=lambda other: other["dofs"])
        step = largest["step_microseconds"] * HALF_A_MILLION / largest["dofs"]
        row["over_half_a_million_dofs"] = row["contact_microseconds"] / step
    return rows


def write(folder: Path, rows: list) -> str:
    """Writes faces.md and faces.csv; returns the table."""
    shown = [{**row, "residual": f"{row['residual']:.0e}"} for row in rows]
    text = by_ranks("Faces of bricks that close at once", "coupled_rows", shown, {
        "coupled rows": "coupled_rows", "free dofs": "dofs", "contact [µs per step]": "contact_microseconds",
        "the rest of the step [µs]": "step_microseconds",
        "contact over a step of 500,000 dofs": "over_half_a_million_dofs",
        "complementarity residual": "residual", "peak memory [MB]": "megabytes"})
    return leave(folder, "faces", text, rows)
