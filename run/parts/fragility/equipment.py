"""Items of equipment of a study's scene as events: an item fails where its capacity is not enough for the widened spectrum
of its floor, by the rules that its options state."""

from dataclasses import dataclass

import numpy as np

from pounding.fragility import widened
from pounding.results import Result

SIXTH = np.log(2) / 6  # of an octave, in logarithms


@dataclass(frozen=True, eq=False)
class Item:
    """`ways`: directions; `frequency` [Hz] and `capacity` [m/s2] where the item has one and its band counts; `needed`:
    ratio of capacity over required spectrum; `dip`: part of it that may lack between two frequencies that have all."""

    title: str
    probe: str
    ways: tuple
    damping: float
    broadening: float
    needed: float
    dip: float
    frequency: np.ndarray
    capacity: np.ndarray

    @property
    def name(self) -> str:
        return f"{self.title} fails: capacity below {self.needed:.3g} times required"

    def fails(self, frequency: np.ndarray, spectra: np.ndarray) -> np.ndarray:
        """Whether it fails under spectra (..., frequencies) of its floor in one direction, as wide as a floor is recorded."""
        place = np.searchsorted(frequency, self.frequency * (1 - 1e-6))
        with np.errstate(divide="ignore"):
            ratio = self.capacity / widened(frequency, spectra, self.broadening)[..., place]
        short = ratio < self.needed
        if self.dip:
            log_f = np.log(self.frequency)
            for i in np.flatnonzero(short.reshape(-1, len(log_f)).any(0)):
                beside = [self._at(ratio, log_f, log_f[i] + way * SIXTH) >= self.needed for way in (-1, 1)]
                short[..., i] &= ~(beside[0] & beside[1] & (ratio[..., i] >= self.needed * (1 - self.dip)))
        return short.any(-1)

    @staticmethod
    def _at(ratio: np.ndarray, log_f: np.ndarray, at: float) -> np.ndarray:
        """The ratio at a frequency, linear in logarithms."""
        k = int(np.clip(np.searchsorted(log_f, at), 1, len(log_f) - 1))
        share = np.clip((at - log_f[k - 1]) / (log_f[k] - log_f[k - 1]), 0, 1)
        return ratio[..., k - 1] ** (1 - share) * ratio[..., k] ** share


def of_run(run: Result) -> list:
    """The items that a run of the scene has, as JSON holds them."""
    found = []
    for name, one in run.summary.get("equipment", {}).items():
        rows = ((run.equipment["equipment"] == name) & (run.equipment["direction"] == next(iter(one["directions"])))
                & (run.equipment["counted"] == 1))
        found.append({"title": name, "probe": one["probe"], "ways": list(one["directions"]),
                      **{key: one[key] for key in ("damping", "broadening", "needed", "dip")},
                      "frequency": run.equipment["frequency"][rows].tolist(),
                      "capacity": run.equipment["capacity"][rows].tolist()})
    return found


def items(kept: list) -> list:
    """Items as `of_run` gave them."""
    return [Item(**{**one, "ways": tuple(one["ways"]), "frequency": np.array(one["frequency"]),
                    "capacity": np.array(one["capacity"])}) for one in kept]
