"""Repeated measurements and what is made of them."""

from dataclasses import dataclass, field

import numpy as np

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
