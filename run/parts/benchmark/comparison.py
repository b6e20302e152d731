"""One brick stepped in several ways that take turns: which ways, on what ranks, in which rounds."""

import json
import shutil
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from .machine import Machine, Series
from .workers import (ELEMENT_MEMORY, MOTION_STEP, SOURCE, MeasuringError, Stepper, block_cells,
                      slab_cells, step_benchmark, usable_memory)

BYTES_PER_DOF = 32  # read and write of two state arrays; masses, coordinates, elements are shared
SLAB_UP_TO = 60_000  # dofs
LABELS = {"element": "element by element", "aij": "PETSc AIJ, written out", "sbaij": "PETSc SBAIJ, blocks of 3",
          "octave": "Octave, K u and C v"}
MATRIX_WAYS = ["aij", "sbaij"]
# Memory of each program while it is built, the most [B per dof].
NEEDED = {"element": ELEMENT_MEMORY, "matrices": 3000, "octave": 5500}


@dataclass
class Row:
    """One way on some ranks; `reason`: why it was not measured."""

    dofs: int
    cells: tuple
    way: str
    ranks: int
    seconds: Series = field(default_factory=Series)
    memory_per_dof: float | None = None
    bound: float = 0  # time in which the triad moves what a step must move [s]
    reason: str = ""


def check_agreement(squares: dict) -> None:
    """All ways must have moved the brick alike in their first steps: only then are their times
    comparable. `squares`: (way, ranks) -> sum of squared displacements [m2]."""
    for (way, ranks), square in squares.items():
        reference = next(iter(squares.values()))
        if not abs(square - reference) <= 1e-9 * reference:
            raise MeasuringError(f"the ways to step do not agree: {way} on {ranks} ranks has moved by "
                                 f"{square} m2, not {reference}")


class Comparison(ExitStack):
    """All ways for one brick. Use in a with statement: they end with it."""

    def __init__(self, folder: Path, scratch: Path, motion: Path, dofs: int, ranks: list):
        super().__init__()
        self.folder, self.scratch, self.motion, self.ranks = folder, scratch, motion, ranks
        self.cells = slab_cells(dofs) if dofs <= SLAB_UP_TO else block_cells(dofs)
        self.dofs = 3 * self.cells[0] * (self.cells[1] + 1) * (self.cells[2] + 1)
        self.budget = usable_memory()
        self.rows = []
        self.steppers = {}  # (way, ranks) -> Stepper
        self.squares = {}  # (way, ranks) -> displacements squared after the first steps

    def start(self) -> None:
        """Starts every way for which there is room, in the order of the table."""
        for ranks in self.ranks:
            if self._fits("element", ["element"], ranks):
                self._start_program(["element"], ranks)
        for ranks in self.ranks:
            if self._fits("matrices", MATRIX_WAYS, ranks):
                words = ["-export", self.scratch] if ranks == 1 else []
                self._start_program(MATRIX_WAYS, ranks, *words)
        self._start_octave()
        self.rows.sort(key=lambda row: (row.ranks, list(LABELS).index(row.way)))
        check_agreement(self.squares)

    def _fits(self, what: str, ways: list, ranks: int) -> bool:
        needed = NEEDED[what] * self.dofs
        if needed <= self.budget:
            self.budget -= needed
            return True
        for way in ways:
            self._skip(way, ranks, f"needs about {needed / 1e9:.1f} GB of memory")
        return False

    def _skip(self, way: str, ranks: int, reason: str) -> None:
        self.rows.append(Row(self.dofs, self.cells, way, ranks, reason=reason))

    def _start_program(self, ways: list, ranks: int, *words) -> None:
        model = ["-cells", ",".join(str(n) for n in self.cells)]
        stepper = self._enter(ways, ranks, step_benchmark(self.folder, ranks, self.motion, model, ways, *words))
        first = stepper.ways[ways[0]]
        self.rows[-len(ways)].memory_per_dof = (first["memory"] - first["memory_before"]) / self.dofs
        if words:
            kept = {key: first[key] for key in ("time_step", "alpha", "beta", "first_steps")}
            (self.scratch / "model.json").write_text(
                json.dumps({**kept, "motion": str(self.motion), "motion_step": MOTION_STEP}))

    def _start_octave(self) -> None:
        """Octave on the matrix that the program left."""
        if ("aij", 1) not in self.steppers:
            self._skip("octave", 1, "there is no matrix of one rank")
        elif shutil.which("octave-cli") is None:
            self._skip("octave", 1, "not installed: apt-get install --no-install-recommends octave")
        elif self._fits("octave", ["octave"], 1):
            self._enter(["octave"], 1, ["octave-cli", "--norc", "--quiet",
                                        SOURCE / "run/parts/benchmark/octave_step.m", self.scratch])
        for name in ("stiffness.petsc", "mass.petsc"):
            (self.scratch / name).unlink(missing_ok=True)

    def _enter(self, ways: list, ranks: int, command: list) -> Stepper:
        stepper = self.enter_context(Stepper(command))
        for way in ways:
            self.rows.append(Row(self.dofs, self.cells, way, ranks))
            self.steppers[way, ranks] = stepper
            self.squares[way, ranks] = stepper.ways[way]["displacement_square"]
            if stepper.ways[way]["dofs"] != self.dofs:
                raise MeasuringError(f"{way} steps {stepper.ways[way]['dofs']} dofs, not {self.dofs}")
        return stepper

    def measure(self, machine: Machine, rounds: int, lasting: float) -> None:
        """Every way once per round, and the triad on as many bytes as a step must move."""
        name = f"{BYTES_PER_DOF} B × {self.dofs} dofs"
        measured = [row for row in self.rows if (row.way, row.ranks) in self.steppers]
        triads = {ranks: Series() for ranks in self.ranks}
        turns = [(series, ranks, partial(machine.measure_triad, name, ranks, BYTES_PER_DOF * self.dofs, lasting / 3))
                 for ranks, series in triads.items()]
        for row in measured:
            stepper = self.steppers[row.way, row.ranks]
            turns.append((row.seconds, row.ranks, partial(stepper.seconds_per_step, row.way, lasting)))
        machine.take_turns(rounds, turns, f"{self.dofs} dofs")
        for row in measured:
            row.bound = BYTES_PER_DOF * self.dofs / triads[row.ranks].median
