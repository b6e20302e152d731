"""What whole scenes cost, as their dry runs say it: the step and the motion, the start-up, the memory by phases."""

import re
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

from pounding.tables import by_ranks, leave

from .workers import MeasuringError, run_program

PHASES = ["mesh", "partition", "assembly", "modes", "step"]
# Head -> what `read` calls it.
STEP = {"time step [µs]": "time_step", "stable step without damping over that with it": "undamped_over_stable",
        "µs per step": "microseconds", "ns per dof": "ns_per_dof", "whole motion [min]": "minutes"}
START = {"whole command [s]": "seconds", "of it modes [s]": "modes_seconds", "memory of all ranks [GB]": "gigabytes",
         "µs per step": "microseconds"}
MEMORY = {"Gmsh's process": "gmsh", **{f"`{phase}`": phase for phase in PHASES}}


class Group(NamedTuple):
    """Scenes of one table: label -> words of the command line."""

    title: str
    columns: dict
    scenes: dict


def scene(name: str, *words) -> list:
    return ["-options_file", f"petsc-options/{name}.yaml", *words]


def plant(m: int) -> list:
    """The pair with so many elements along a module."""
    return scene("plant/pair", "-modes", 0, "-block_mesh_set", f"m={m}", "-frame_mesh_set", f"m={m},x0=24.801",
                 "-block_damping_reference", 4.7, "-frame_damping_reference", 3.6)


def frames(size: float, *words) -> list:
    return scene("plant/frames", "-modes", 0, "-a_mesh_set", f"size={size},bays_x=4,x_offset=0,face_at_end=1",
                 "-b_mesh_set", f"size={size},bays_x=3,x_offset=24.05,face_at_end=0", *words)


def bricks(h: float) -> list:
    return scene("plant/bricks", "-bricks_mesh_set", f"h={h}", "-structures", "bricks", "-contacts", "none", "-probes",
                 "bricks_roof", "-modes", 0)


def huge(h: float) -> list:
    return scene("plant/huge", "-bricks_mesh_set", f"h={h}", "-omega_max_tolerance", 0.1)


def reduced(count: int, *words) -> list:
    """So many modes of each building of the medium plant pair."""
    return scene("plant/medium", "-modes", 0, "-block_model", "modal", "-frame_model", "modal",
                 "-block_modal_vectors", count, "-frame_modal_vectors", count, *words)


SCALED = ["-s1_mass_scaling", 2.2e-5, "-s2_mass_scaling", 2.2e-5, "-gap_interval", 0.01]
GROUPS = {
    "pair": Group("The two-storey pair", STEP, {
        "Model A, hexahedra": scene("azalee/gap2", "-courant", 0.99),
        "Model B, shells": scene("azalee/b-gap2", "-courant", 0.99),
        "Model A, scaled mass": scene("azalee/gap2", "-courant", 0.99, *SCALED)}),
    "plant": Group("The plant pair", STEP, {
        **{f"pair, m={m}": plant(m) for m in (5, 10, 14)},
        "on rigid mats, half a module": scene("plant/on_soil", "-modes", 0),
        "large": scene("plant/large", "-modes", 0)}),
    "start_up": Group("Start-up", START, {
        "frames, size=0.5": frames(0.5),
        "frames, size=0.25": frames(0.25),
        "frames, size=0.5, girders with damping of their own":
            frames(0.5, "-a_girder_damping_alpha", 1, "-b_girder_damping_alpha", 1)}),
    "bases": Group("Bases of the plant pair", START, {
        "200 modes of each": reduced(200),
        "400 modes of each": reduced(400),
        "400 modes of each, m=14": reduced(400, "-block_mesh_set", "m=14", "-frame_mesh_set", "m=14,x0=24.801")}),
    "memory": Group("Largest resident memory of all ranks in each phase [B per dof]", MEMORY, {
        "bricks, h=0.5": bricks(0.5), "bricks, h=0.25": bricks(0.25), "large": scene("plant/large", "-modes", 0),
        "huge, h=0.125": huge(0.125), "huge, h=0.1": huge(0.1)}),
}


def read(said: str) -> dict:
    """Numbers that a dry run prints. Throws MeasuringError where one is missing."""
    def one(pattern: str) -> float:
        found = re.search(pattern, said, re.MULTILINE)
        if not found:
            raise MeasuringError(f"no '{pattern}' in what the dry run says")
        return float(found[1])

    phases = {phase: (float(seconds), float(memory)) for phase, seconds, memory in re.findall(
        rf"^  ({'|'.join(PHASES)}) +(\S+) +(\d+) +\d+ +\d+ +\d+$", said, re.MULTILINE)}
    dofs = sum(int(count) for count in re.findall(r"nodes, (\d+) dofs", said))
    limits = re.findall(r"stable time step (\S+) s .*without damping (\S+) s", said)
    undamped = min(float(limit) for _, limit in limits) / min(float(limit) for limit, _ in limits) if limits else None
    microseconds = one(r"\((\S+) microseconds per step")
    gmsh = re.search(r"Gmsh's process held (\d+) MB", said)
    return {"dofs": dofs, "time_step": 1e6 * one(r"^time step (\S+) s \("), "undamped_over_stable": undamped,
            "microseconds": microseconds, "ns_per_dof": 1e3 * microseconds / dofs,
            "minutes": microseconds * one(r"^time step .*, (\d+) steps to") / 60e6,
            "modes_seconds": phases.get("modes", (0.0, 0.0))[0],
            "gigabytes": max(memory for _, memory in phases.values()) / 1e3,
            "gmsh": 1e6 * float(gmsh[1]) / dofs if gmsh else None,
            **{phase: 1e6 * memory / dofs for phase, (_, memory) in phases.items()}}


def measure(build: Path, name: str, ranks: list, rounds: int) -> list:
    """A row per scene of the group and number of ranks: medians."""
    rows = []
    for label, words in GROUPS[name].scenes.items():
        for count in ranks:
            turns = []
            for _ in range(rounds):
                since = time.monotonic()
                found = read(run_program(build, count, [*words, "-dry_run"]))
                turns.append({**found, "seconds": time.monotonic() - since})
            rows.append({"scene": label, "ranks": count,
                         **{key: None if turns[0][key] is None else float(np.median([turn[key] for turn in turns]))
                            for key in turns[0]}})
    return rows


def write(folder: Path, name: str, rows: list) -> str:
    """Writes NAME.md and NAME.csv; returns the table."""
    group = GROUPS[name]
    text = by_ranks(group.title, "scene", rows, {"": "scene", "free dofs": "dofs", **group.columns})
    return leave(folder, name, text, rows)
