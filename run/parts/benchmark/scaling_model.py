"""What a step of the pair of buildings would take on more ranks than there are.

The slowest part counts, its times added up:

    compute    work x cost(work) x c, work = elements held x dofs per element of the mesh
    within     messages to parts on its node x time of one of the mean length
    between    messages to parts on other nodes x latency, and what its node sends there over its bandwidth
    rows       constraints with a node in the part
    exchange   u and then v-, v_free of its dofs in constraints that another part holds as well, to each of those parts
    agreement  sums and minima over ranks: of the smallest gap over those with constraints, of the ledger over all

The elements that touch no ghost are done while messages between nodes travel: `overlapped` has the longer of the two in
place of their sum. Messages within a node are copies that the cores make themselves, nothing hides them.

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

from .workers import SOURCE, MeasuringError, with_environment

SHARED = 3 * 8  # per dof of a shared constraint [B]
LEDGER = 2 / 100  # sums over all ranks per step: two where the ledger has a line
DIVIDED = 5  # a brick that METIS sees, along an edge, where the pair is larger than its indices


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

    def step(self, dofs):
        """[s], of one or many; constant cost per dof outside of what was measured."""
        return dofs * np.interp(np.log(np.maximum(dofs, 1)), np.log(self.dofs), self.seconds_per_dof)


class Messages:
    """Time of one message over its length, the shortest measured."""

    def __init__(self, measured: list):
        self.bytes = measured[0]["bytes"]
        self.seconds = np.min([one["seconds"] for one in measured], axis=0)
        self.latency = float(self.seconds[0])
        self.bandwidth = float(self.bytes[-1] / self.seconds[-1])

    def time(self, length):
        """[s], of one or many."""
        beyond = np.maximum(np.asarray(length, dtype=float) - self.bytes[-1], 0)
        return np.interp(length, self.bytes, self.seconds) + beyond / self.bandwidth


@dataclass
class Network:
    """Between nodes of so many cores; the bandwidth is that of a node [B/s]."""

    latency: float
    bandwidth: float
    cores: int


def undivided(part: dict) -> dict:
    """One part of all that a line of the study has."""
    alone = {name: [0] for name in part["of_parts"]}
    return {**part, "parts": 1, "contact_members": 1, "of_parts": {
        **alone, "elements": [part["elements"]], "inner": [part["elements"]], "rows": [part["contact_rows"]]}}


@dataclass
class Model:
    alone: CostCurve  # one core busy
    busy: CostCurve  # all cores busy
    messages: Messages
    network: Network | None = None  # none: all parts are on one node
    factor: float = 1  # measured over modelled step of one rank, without contact
    row_seconds: float = 0  # of one constraint

    def calibrate(self, point) -> None:
        """To a measured pair on one rank."""
        contact = point.contact.median
        self.row_seconds = contact / point.contact_rows
        self.factor = (point.seconds.median - contact) / float(self.alone.step(point.dofs))

    def predict(self, part: dict) -> dict:
        """Seconds of a step with the partition `part`, a line of the study: times of the slowest part and their sum;
        `overlapped`; `alone`: of an equal share that exchanges nothing."""
        of = {name: np.array(values, dtype=float) for name, values in part["of_parts"].items()}
        curve = self.alone if part["parts"] == 1 else self.busy
        latency, bandwidth, cores = self.messages.latency, self.messages.bandwidth, part["parts"]
        if self.network:
            latency, bandwidth, cores = self.network.latency, self.network.bandwidth, self.network.cores
        node = np.arange(part["parts"]) // cores
        stages = {ranks: math.ceil(math.log2(max(ranks, 1))) for ranks in (part["contact_members"], part["parts"])}
        within = of["messages"] - of["messages_away"]
        copied = 8 * np.maximum(np.maximum(of["sent"], of["received"]) - of["sent_away"], 0)
        times = {"compute": self.factor * curve.step(of["elements"] * part["dofs"] / part["elements"]),
                 "within": within * self.messages.time(copied / np.maximum(within, 1)),
                 "between": of["messages_away"] * latency + 8 * np.bincount(node, of["sent_away"])[node] / bandwidth,
                 "exchange": 2 * of["partners"] * latency + of["contact_sent"] * SHARED / bandwidth,
                 "rows": of["rows"] * self.row_seconds,
                 "agreement": np.where(of["rows"] > 0, stages[part["contact_members"]] * latency, 0)
                 + LEDGER * stages[part["parts"]] * latency}
        total = sum(times.values())
        inner = times["compute"] * of["inner"] / np.maximum(of["elements"], 1)
        slowest = int(np.argmax(total))
        return {**{name: float(values[slowest]) for name, values in times.items()}, "step": float(total[slowest]),
                "overlapped": float(np.max(total - np.minimum(times["between"], inner))),
                "alone": self.factor * float(curve.step(part["dofs"] / part["parts"]))}


@dataclass
class Study:
    """Lines of partition_study for one pair and several numbers of parts, and the model that they go into. Kinds: pair,
    large (apart from what is run)."""

    kind: str
    case: str
    model: Model
    parts: list


def study(folder: Path, kind: str, case: str, model: Model, cells: int, parts: list, divided: int = 1) -> Study:
    """METIS partitions of the pair of so many bricks per metre, each divided after it."""
    cores = f"/{model.network.cores}" if model.network else ""
    command = [folder / "tests" / "partition_study", f"{cells}x{divided}" if divided > 1 else cells,
               *(f"{number}{cores}" for number in parts)]
    run = subprocess.run(with_environment(command), cwd=SOURCE, capture_output=True, text=True,
                         preexec_fn=ending_with_us())
    if run.returncode != 0:
        raise MeasuringError(run.stderr.strip() or f"partition_study ended with {run.returncode}")
    return Study(kind, case, model, [json.loads(line) for line in run.stdout.splitlines()])
