"""What the plant pair costs: its step and the time of 20 s of motion, by the size of its mesh, beside
the same without dashpots and without damping."""

import re
from pathlib import Path

import numpy as np

from parts.tables import markdown, write_csv
from pounding.files import write_text

from .workers import run_program

SCENE = "petsc-options/plant/pair.yaml"
DURATION = 20  # of the motion [s]
NO_DASHPOTS = ["-block_soil_dashpot", "0,0,0", "-frame_soil_dashpot", "0,0,0"]


def dry_run(folder: Path, ranks: int, divisions: int, more: list) -> dict:
    """Numbers that the dry run prints: dofs, limits of the two structures, cost of a step."""
    said = run_program(folder, ranks, [
        "-options_file", SCENE, "-modes", 0,
        "-block_mesh_set", f"m={divisions}", "-frame_mesh_set", f"m={divisions},x0=24.801",
        "-block_damping_reference", 4.7, "-frame_damping_reference", 3.6, "-dry_run", *more])
    limits = re.findall(r"stable time step (\S+) s .*without damping (\S+) s", said)
    step = re.search(r"time step (\S+) s \(", said[said.rindex("\ntime step"):])
    cost = re.search(r"\((\S+) microseconds per step", said)
    return {"dofs": sum(int(n) for n in re.findall(r"nodes, (\d+) dofs", said)),
            "stable": min(float(limit) for limit, _ in limits),
            "undamped": min(float(limit) for _, limit in limits),
            "time_step": float(step.group(1)), "microseconds": float(cost.group(1))}


def measure(folder: Path, divisions: list, ranks: list, rounds: int) -> list:
    """One row per mesh and number of ranks; with and without dashpots in turns."""
    rows = []
    for m in divisions:
        for count in ranks:
            turns = []
            for _ in range(rounds):
                found = dry_run(folder, count, m, [])
                without = dry_run(folder, count, m, NO_DASHPOTS)
                turns.append((found["microseconds"], found["microseconds"] / without["microseconds"]))
            cost, ratio = (float(np.median(column)) for column in zip(*turns))
            steps = DURATION / found["time_step"]
            rows.append({"divisions": m, "dofs": found["dofs"], "ranks": count,
                         "stable_time_step": found["stable"], "undamped": found["undamped"],
                         "damping_shortens": found["undamped"] / found["stable"],
                         "microseconds_per_step": cost, "ns_per_dof": 1e3 * cost / found["dofs"],
                         "over_without_dashpots": ratio, "minutes": cost * steps / 60e6})
    return rows


def write(folder: Path, rows: list) -> str:
    """Writes plant.md and plant.csv; returns the table."""
    write_csv(folder / "plant.csv", rows)
    head = ["free dofs", "ranks", "stable step, microseconds", "of the undamped one over it",
            "microseconds per step", "ns per dof", "over those without dashpots",
            f"minutes for {DURATION} s of motion"]
    text = markdown("The plant pair in shells and beams, uniform damping of 4 %", head, [
        [row["dofs"], row["ranks"], 1e6 * row["stable_time_step"], row["damping_shortens"],
         row["microseconds_per_step"], row["ns_per_dof"], row["over_without_dashpots"], row["minutes"]]
        for row in rows])
    write_text(folder / "plant.md", text)
    return text
