"""What a step of the pair of buildings would take on more ranks than there are.

Added up for the part that has most of each, nothing overlapping:

    compute   work x cost(work) x c, work = elements held x dofs per element of the mesh
    halo      messages x time of one message of the mean length
    rows      constraints with a node in the part
    exchange  u and then v-, v_free of its dofs in constraints that another part holds as well, to each of those parts

cost: seconds per dof of a block that fits one rank, measured with all cores busy (with one busy
for one part); c brings the model to the measured step of one rank, and is 1 without one. Loads, halos
and constraints are those of METIS partitions.
"""

import json
import math
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pounding.runs import ending_with_us

from .workers import SOURCE, MeasuringError, storey_cells, with_environment

SHARED = 3 * 8  # per dof of a shared constraint [B]


@dataclass
class CostCurve:
    """Seconds per dof of a rank's own share, over its number of dofs."""

    dofs: list
    seconds_per_dof: list

    @classmethod
    def of(cls, points: list, ranks: int):
        """From the points where every one of `ranks` has a model of its own."""
        found = sorted((point.dofs / ranks, point.seconds.median / (point.dofs / ranks))
                       for point in points if point.kind == "apart" and point.ranks == ranks)
        return cls([dofs for dofs, _ in found], [cost for _, cost in found])

    def step(self, dofs: float) -> float:
        """[s]; constant cost per dof outside of what was measured."""
        return dofs * float(np.interp(math.log(dofs), np.log(self.dofs), self.seconds_per_dof))


class Messages:
    """Time of one message over its length: the shortest measured, or by latency and bandwidth."""

    def __init__(self, measured: list, latency: float | None, bandwidth: float | None):
        self.bytes = measured[0]["bytes"]
        self.seconds = np.min([one["seconds"] for one in measured], axis=0)
        self.latency = latency if latency is not None else float(self.seconds[0])
        self.bandwidth = bandwidth or float(self.bytes[-1] / self.seconds[-1])
        self.given = latency is not None or bandwidth is not None

    def time(self, length: float) -> float:
        """[s]"""
        if self.given or length >= self.bytes[-1]:
            return self.latency + length / self.bandwidth
        return float(np.interp(length, self.bytes, self.seconds))


def study(folder: Path, dofs: int, parts: list) -> list:
    """METIS partitions of the pair of about so many dofs, one and `parts`."""
    command = [folder / "tests" / "partition_study", storey_cells(dofs), 1, *parts]
    run = subprocess.run(with_environment(command), cwd=SOURCE, capture_output=True, text=True,
                         preexec_fn=ending_with_us())
    if run.returncode != 0:
        raise MeasuringError(run.stderr.strip() or f"partition_study ended with {run.returncode}")
    return [json.loads(line) for line in run.stdout.splitlines()]


@dataclass
class Model:
    alone: CostCurve  # one core busy
    busy: CostCurve  # all cores busy
    messages: Messages
    factor: float = 1  # measured over modelled step of one rank, without contact
    row_seconds: float = 0  # of one constraint

    def calibrate(self, point) -> None:
        """To a measured pair on one rank."""
        contact = point.contact.median
        self.row_seconds = contact / point.contact_rows
        self.factor = (point.seconds.median - contact) / self.alone.step(point.dofs)

    def predict(self, part: dict) -> dict:
        """Seconds of a step with the partition `part`, a line of the study; `alone`: of an equal share that
        exchanges nothing."""
        work = part["elements_per_part"]["largest"] * part["dofs"] / part["elements"]
        curve = self.alone if part["parts"] == 1 else self.busy
        messages = part["messages"]["largest"]
        exchanged = 8 * max(part["sent"]["largest"], part["received"]["largest"])
        times = {"compute": self.factor * curve.step(work),
                 "halo": messages * self.messages.time(exchanged / messages) if messages else 0.0,
                 "exchange": 2 * part["contact_partners"] * self.messages.latency
                 + part["contact_dofs_sent"] * SHARED / self.messages.bandwidth,
                 "rows": part["contact_rows_per_part"] * self.row_seconds}
        return {**times, "step": sum(times.values()), "alone": self.factor * curve.step(part["dofs"] / part["parts"])}
