"""Runs the program for the sweeps, and the rows of their table."""

import math
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

SOURCE = Path(__file__).resolve().parents[3]
sys.path.append(str(SOURCE / "tests"))
import program  # noqa: E402

RUNS, STOPPED, REFUSED, CRASHED = "runs", "stopped", "refused", "crashed"


@dataclass
class Row:
    """One line of the table. `measure`: what is compared with `limit`, NaN where there is nothing to
    compare."""

    sweep: str
    case: str
    expected: str
    seen: str
    outcome: str
    measure: float = math.nan
    limit: float = math.nan
    good: bool = False

    @property
    def verdict(self) -> str:
        return "as expected" if self.good else "NOT as expected"


class Outcome:
    """How a run of the program ended, and what it left."""

    def __init__(self, result, folder: Path):
        errors = program.error_lines(result)
        self.end = self._end(result.returncode, errors, folder)
        self.message = errors[0][len("pounding: "):] if errors else self._last_words(result)
        self.summary = program.summary(folder) if self.end == RUNS else {}
        self.history = {}
        if self.end == RUNS:
            with h5py.File(folder / "history.h5", "r") as file:
                self.history = {name: file[name][()] for name in file}
        self.ledger = self._ledger(folder) if self.end == RUNS else {}

    @staticmethod
    def _ledger(folder: Path) -> dict:
        """Columns of energy.csv."""
        columns = program.read_csv(folder / "energy.csv")
        return {name: np.array(values, dtype=float) for name, values in columns.items()}

    @staticmethod
    def _end(status: int, errors: list, folder: Path) -> str:
        if status == 0:
            return RUNS
        if status != 1 or len(errors) != 1:
            return CRASHED
        return STOPPED if (folder / "resolved.yaml").exists() else REFUSED

    def _last_words(self, result) -> str:
        """Of a run that crashed: the last line that is not mpirun's ruling."""
        lines = [line for line in result.stderr.splitlines() if line.strip("- ")]
        return lines[-1] if lines and not self.runs else ""

    @property
    def runs(self) -> bool:
        return self.end == RUNS

    @property
    def residual(self) -> float:
        """Of the energy identity, over the largest energy."""
        return self.summary["energy"]["relative_residual"]

    def finite(self) -> bool:
        return all(np.isfinite(values).all() for values in self.history.values()
                   if values.dtype.kind == "f")

    def difference(self, other: "Outcome", *names: str) -> float:
        """Largest difference of some histories over the largest value; 0: the same bits. Infinite
        if one of the two runs left none."""
        if not (self.runs and other.runs):
            return math.inf
        worst = 0.0
        for name in names:
            mine, theirs = self.history[name], other.history[name]
            if mine.shape != theirs.shape:
                return math.inf
            scale = abs(theirs).max(initial=0.0)
            gap = abs(mine - theirs).max(initial=0.0)
            worst = max(worst, gap / scale if scale > 0 else gap)
        return worst


class Bench:
    """Where the runs take place. `quick`: fewer cases and shorter runs; `long`: also the one that
    takes minutes."""

    def __init__(self, folder: Path, quick: bool = False, long: bool = False):
        self.folder, self.quick, self.long = folder, quick, long
        self.runs = 0

    def run(self, words, ranks: int = 2) -> Outcome:
        """One run in a folder of its own, which is removed once it was read."""
        self.runs += 1
        folder = self.folder / f"run-{self.runs}"
        shutil.rmtree(folder, ignore_errors=True)
        result = program.run(["-csv_digits", 17, *words, "-output", str(folder)], ranks, timeout=7200)
        try:
            return Outcome(result, folder)
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def choose(self, values, quick):
        """The values of a sweep, or the few of a quick one."""
        return quick if self.quick else values


def checked(row: Row, outcome: Outcome) -> Row:
    """Sets the verdict of a row whose run should end well with a measure within its limit."""
    if outcome.runs:
        row.good = outcome.finite() and (math.isnan(row.limit) or row.measure <= row.limit)
    else:
        row.seen = f"{outcome.end}: {outcome.message}" if outcome.message else outcome.end
        row.good = False
    return row
