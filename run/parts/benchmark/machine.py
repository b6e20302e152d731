"""What the machine can do at the moment, measured beside the steps."""

import platform
import sys
from contextlib import ExitStack
from dataclasses import dataclass, field
from datetime import datetime, timezone
from pathlib import Path

import numpy as np

from .workers import Worker, mpirun

QUIET = 0.9  # of the ideal speed-up of the multiply-adds: 1.8 for two ranks


@dataclass
class Series:
    """One figure, measured once in each round. `quiet`, set afterwards: whether the ranks had their
    cores in a round."""

    values: list = field(default_factory=list)
    quiet: list = field(default_factory=list)

    def add(self, value: float) -> None:
        self.values.append(value)

    def kept(self) -> np.ndarray:
        """Values of the quiet rounds; all of them where no round was quiet."""
        values = np.array(self.values, dtype=float)
        return values[self.quiet] if any(self.quiet) else values

    @property
    def disturbed(self) -> bool:
        return len(self.quiet) > 0 and not any(self.quiet)

    @property
    def median(self) -> float:
        return float(np.median(self.kept()))

    @property
    def lowest(self) -> float:
        return float(self.kept().min())

    @property
    def highest(self) -> float:
        return float(self.kept().max())

    def as_json(self, scale: float = 1) -> dict:
        return {"median": scale * self.median, "lowest": scale * self.lowest, "highest": scale * self.highest,
                "rounds": [scale * value for value in self.values], "quiet": self.quiet}



def description() -> dict:
    model = [line.split(":", 1)[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines()
             if line.startswith("model name")]
    return {"processor": model[0] if model else platform.machine(), "cores": len(model),
            "date": datetime.now(timezone.utc).isoformat(timespec="seconds")}


class Machine(ExitStack):
    """One worker per number of ranks; every figure is a Series over the rounds."""

    def __init__(self, folder: Path, ranks: list):
        super().__init__()
        self.ranks = sorted({1, *ranks})
        self.workers = {}
        for number in self.ranks:
            self.workers[number] = self.enter_context(
                Worker(mpirun(number, folder / "tests" / "machine_limits")))
            self.workers[number].read()
        self.flops = {number: Series() for number in self.ranks}  # [flop/s]
        self.triad = {}  # (name, ranks) -> Series [B/s]
        self.messages = []  # per call
        self.turns = []  # (calibrations, turns) of each call of take_turns

    def calibrate(self) -> dict:
        """Multiply-adds in registers per number of ranks [flop/s]: all that the cores give."""
        rates = {number: self.workers[number].ask("fma")["flops_per_second"] for number in self.ranks}
        for number, rate in rates.items():
            self.flops[number].add(rate)
        return rates

    def take_turns(self, rounds: int, turns: list, title: str) -> None:
        """Measures each of `turns`, a list of (Series, ranks, function that measures), once a round,
        with a calibration before, between and after."""
        rates = [self.calibrate()]
        for number in range(rounds):
            print(f"  {title}, round {number + 1} of {rounds}", file=sys.stderr, flush=True)
            for series, _, measure in turns:
                series.add(measure())
            rates.append(self.calibrate())
        self.turns.append((rates, turns))

    def find_quiet_rounds(self) -> None:
        """A round is quiet for a number of ranks if the calibrations before and after it are near the best that one
        rank reached in the whole run, times that number: what is missing was taken by others."""
        best = max(self.flops[1].values)
        for rates, turns in self.turns:
            for series, ranks, _ in turns:
                series.quiet = [min(before[ranks], after[ranks]) >= QUIET * ranks * best
                                for before, after in zip(rates, rates[1:])]

    def measure_triad(self, name: str, ranks: int, total_bytes: float, lasting: float) -> float:
        rate = self.workers[ranks].ask(f"triad {total_bytes} {lasting}")["bytes_per_second"]
        self.triad.setdefault((name, ranks), Series()).add(rate)
        return rate

    def measure_messages(self) -> None:
        """Between two ranks of the largest worker, which must have two."""
        self.messages.append(self.workers[max(self.ranks)].ask("messages"))

    def as_json(self) -> dict:
        return {"multiply_adds": {str(ranks): series.as_json() for ranks, series in self.flops.items()},
                "triad": [{"where": name, "ranks": ranks, **series.as_json()}
                          for (name, ranks), series in self.triad.items()], "messages": self.messages}
