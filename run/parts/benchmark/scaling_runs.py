"""Steps of models on more and more ranks, measured in turns."""

from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from .machine import Machine, Series
from .workers import ELEMENT_MEMORY, Stepper, block_cells, step_benchmark, storey_cells, usable_memory


@dataclass
class Point:
    """A model on some ranks. Kinds: apart (every rank a model of its own), pair."""

    kind: str
    case: str
    dofs: int
    ranks: int
    seconds: Series = field(default_factory=Series)
    contact: Series = field(default_factory=Series)
    contact_rows: int = 0


class Bench:
    """Runs groups of points; all of a group take turns."""

    def __init__(self, folder: Path, scratch: Path, motion: Path, machine: Machine, rounds: int, lasting: float):
        self.folder, self.scratch, self.motion = folder, scratch, motion
        self.machine, self.rounds, self.lasting = machine, rounds, lasting
        self.points = []
        self.skipped = []

    def apart(self, dofs_per_rank: int, ranks: list) -> None:
        """The same block on every rank, nothing exchanged: what a step costs a full machine."""
        cells = block_cells(dofs_per_rank)
        self._group("apart", "block " + "x".join(str(n) for n in cells) + " on every rank",
                    {number: brick(cells) for number in ranks}, dofs_per_rank * sum(ranks), "-apart")

    def pair(self, dofs: int, ranks: list) -> None:
        """The pair of buildings, the interface looked at in every step."""
        n = storey_cells(dofs)
        self._group("pair", f"two buildings, {n} bricks per metre",
                    {number: ["-storeys", n] for number in ranks}, dofs * len(ranks))

    def _group(self, kind: str, case: str, models: dict, dofs: int, *words) -> None:
        """`models`: per number of ranks; `dofs`: of all of them together."""
        needed = ELEMENT_MEMORY * dofs
        if needed > usable_memory():
            self.skipped.append(f"{kind}, {case}: not run, needs about {needed / 1e9:.0f} GB of memory")
            return
        with ExitStack() as stack:
            turns = []
            for ranks, model in models.items():
                stepper = stack.enter_context(Stepper(step_benchmark(
                    self.folder, ranks, self.motion, model, ["element"], *words)))
                told = stepper.ways["element"]
                point = Point(kind, case, told["dofs"], ranks, contact_rows=told["contact_rows"])
                turns.append((point.seconds, ranks, partial(self._step, stepper, point)))
                self.points.append(point)
            self.machine.take_turns(self.rounds, turns, f"{kind}, {case}")

    def _step(self, stepper: Stepper, point: Point) -> float:
        answer = stepper.ask(f"element {self.lasting}")
        point.contact.add(answer["contact_seconds_per_step"])
        return answer["seconds_per_step"]


def brick(cells: tuple) -> list:
    return ["-cells", ",".join(str(n) for n in cells)]
