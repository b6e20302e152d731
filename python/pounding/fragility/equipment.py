"""Items of equipment of a study's scene as events: an item fails where its capacity is not enough for the widened spectrum
of its floor, by the rules that its options state."""

from dataclasses import dataclass

import numpy as np

from pounding.equipment import SIXTH, counting, ratio_of
from pounding.fragility import widened
from pounding.log_interpolation import log_interpolated
from pounding.results import Result


@dataclass(frozen=True, eq=False)
class Item:
    """`ways`: directions; `frequency` [Hz] and `capacity` [m/s2] of its curve; `band`: frequencies that count, None: all;
    `needed`: ratio of capacity over required spectrum; `dip`: part of it that may lack between two that have all."""

    title: str
    probe: str
    ways: tuple
    damping: float
    broadening: float
    needed: float
    dip: float
    frequency: np.ndarray
    capacity: np.ndarray
    band: list | None

    @property
    def name(self) -> str:
        return f"{self.title} fails: capacity below {self.needed:.3g} times required"

    def fails(self, frequency: np.ndarray, spectra: np.ndarray) -> np.ndarray:
        """Whether it fails under spectra (..., frequencies) of its floor in one direction, as wide as a floor is recorded."""
        required = widened(frequency, spectra, self.broadening)
        counts = counting(frequency, self.band) & counting(frequency, (self.frequency[0], self.frequency[-1]))
        at = frequency[counts]
        ratio = ratio_of(np.broadcast_to(self._capacity(at), required[..., counts].shape), required[..., counts])
        short = ratio < self.needed
        if self.dip:
            for i in np.flatnonzero(short.reshape(-1, len(at)).any(0)):
                beside = [self._capacity(one) >= self.needed * self._between(frequency, required, one)
                          for one in (at[i] / SIXTH, at[i] * SIXTH)]
                short[..., i] &= ~(beside[0] & beside[1] & (ratio[..., i] >= self.needed * (1 - self.dip)))
        return short.any(-1)

    def _capacity(self, at: np.ndarray) -> np.ndarray:
        return log_interpolated(at, self.frequency, self.capacity)

    @staticmethod
    def _between(frequency: np.ndarray, spectra: np.ndarray, at: float) -> np.ndarray:
        """Spectra at a frequency, linear in logarithms."""
        k = int(np.clip(np.searchsorted(frequency, at), 1, len(frequency) - 1))
        share = np.clip(np.log(at / frequency[k - 1]) / np.log(frequency[k] / frequency[k - 1]), 0, 1)
        return spectra[..., k - 1] ** (1 - share) * spectra[..., k] ** share


def of_run(run: Result) -> list:
    """The items that a run of the scene has, as JSON holds them."""
    return [{"title": name, "probe": one["probe"], "ways": one["directions"], "band": one.get("band"),
             "frequency": one["capacity"]["frequency"], "capacity": one["capacity"]["acceleration"],
             **{key: one[key] for key in ("damping", "broadening", "needed", "dip")}}
            for name, one in run.summary.get("equipment", {}).items()]


def items(kept: list) -> list:
    """Items as `of_run` gave them."""
    return [Item(**{**one, "ways": tuple(one["ways"]), "frequency": np.array(one["frequency"]),
                    "capacity": np.array(one["capacity"])}) for one in kept]
