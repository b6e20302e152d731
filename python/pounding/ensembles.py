"""What an ensemble left in its result folder, as numpy arrays. SI units throughout."""

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from .results import ResultError


@dataclass
class Ensemble:
    """Many runs of one scene; arrays have a row per member, those that are not done hold no numbers (nan)."""

    folder: Path
    columns: list  # options that differ
    table: np.ndarray  # their values as text, shape (members, columns)
    done: np.ndarray  # per member
    channels: list  # "probe direction"
    damping: np.ndarray
    frequency: np.ndarray  # [Hz]
    pseudo_acceleration: np.ndarray  # shape (members, channels, damping, frequency) [m/s2]
    displacement: np.ndarray  # largest, shape (members, channels) [m]
    acceleration: np.ndarray  # likewise, after the low-pass [m/s2]
    residual: np.ndarray  # of the energy identity, per member
    contacts: list
    impacts: dict  # "episodes", "first_time", "impulse_sum", ... -> shape (members, contacts)
    smallest_gap: np.ndarray  # shape (members, contacts) [m]

    def column(self, name: str) -> np.ndarray:
        """Values of one option as text, a row per member."""
        if name not in self.columns:
            raise ResultError(f"{self.folder}: the table has no column {name}; it has {', '.join(self.columns)}")
        return self.table[:, self.columns.index(name)]

    def spectrum(self, probe: str, direction: str, damping: float | None = None):
        """Frequencies [Hz] and pseudo-accelerations [m/s2], shape (members, frequencies), or None if there are none;
        without `damping` those of the smallest ratio."""
        channel = f"{probe} {direction}"
        ratio = self.damping.min() if damping is None else damping
        if channel not in self.channels or ratio not in self.damping:
            return None
        place = list(self.damping).index(ratio)
        return self.frequency, self.pseudo_acceleration[:, self.channels.index(channel), place]


def _words(values) -> list:
    return [value.decode() for value in values]


def load_ensemble(folder) -> Ensemble:
    """The ensemble in a result folder, finished or not."""
    path = Path(folder) / "ensemble.h5"
    try:
        with h5py.File(path, "r") as file:
            table = file["members/table"]
            contacts = _words(file["impacts/contacts"]) if "impacts/contacts" in file else []
            none = np.zeros((table.shape[0], 0))
            return Ensemble(
                Path(folder), str(_text(table.attrs["columns"])).split(","), np.char.decode(table[:]),
                file["done"][:] == 1, _words(file["spectra/channels"]), file["spectra/damping"][:],
                file["spectra/frequency"][:], file["spectra/pseudo_acceleration"][:], file["peaks/displacement"][:],
                file["peaks/acceleration"][:], file["energy/residual"][:], contacts,
                {name: file["impacts"][name][:] for name in file.get("impacts", []) if name != "contacts"},
                file["gaps/smallest"][:] if contacts else none)
    except (OSError, KeyError) as error:
        raise ResultError(f"{path}: no ensemble that can be read ({error})") from None


def _text(value) -> str:
    return value.decode() if isinstance(value, bytes) else value
