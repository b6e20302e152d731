"""What an ensemble left in its result folder, as numpy arrays. SI units throughout."""

import zlib
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from .results import UNREADABLE, ResultError, require_schema, text_of


@dataclass(repr=False)
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
    force_names: list  # columns of recorded forces, "base.Fx"
    force_time: np.ndarray  # of their samples [s]
    forces: np.ndarray  # shape (members, samples, columns) [N, N m]

    def column(self, name: str) -> np.ndarray:
        """Values of one option as text, a row per member."""
        if name not in self.columns:
            raise ResultError(f"{self.folder}: the table has no column {name}; it has {', '.join(self.columns)}")
        return self.table[:, self.columns.index(name)]

    def __repr__(self) -> str:
        return (f"Ensemble({str(self.folder)!r}: {int(self.done.sum())} of {len(self.done)} members done; columns "
                f"{', '.join(self.columns)}; channels {', '.join(self.channels)})")

    def spectrum(self, probe: str, direction: str, damping: float | None = None):
        """Frequencies [Hz] and pseudo-accelerations [m/s2], shape (members, frequencies); without `damping` those of
        the smallest ratio. Throws ResultError, with what there is, if there are none."""
        channel = f"{probe} {direction}"
        if channel not in self.channels:
            raise ResultError(f"{self.folder}: no spectra of {channel}; there are those of {', '.join(self.channels)}")
        ratio = self.damping.min() if damping is None else damping
        places = np.flatnonzero(np.isclose(self.damping, ratio, rtol=1e-9, atol=0))
        if not len(places):
            raise ResultError(f"{self.folder}: no spectra at a damping ratio of {ratio:g}; there are those at "
                              f"{', '.join(f'{one:g}' for one in self.damping)}")
        return self.frequency, self.pseudo_acceleration[:, self.channels.index(channel), places[0]]


def load_ensemble(folder) -> Ensemble:
    """The ensemble in a result folder, finished or not."""
    path = Path(folder) / "ensemble.h5"
    try:
        with h5py.File(path, "r") as file:
            require_schema(path.name, file.attrs)
            table = file["members/table"]
            for member in damaged(file)[:1]:
                raise ResultError(f"{path}: the numbers of member {member + 1} are not those written; the same command "
                                  "(-ensemble) steps it again")
            contacts = list(map(text_of, file["impacts/contacts"])) if "impacts/contacts" in file else []
            none, has_forces = np.zeros((table.shape[0], 0)), "forces" in file
            return Ensemble(
                Path(folder), text_of(table.attrs["columns"]).split(","), np.char.decode(table[:]),
                file["done"][:] == 1, list(map(text_of, file["spectra/channels"])), file["spectra/damping"][:],
                file["spectra/frequency"][:], file["spectra/pseudo_acceleration"][:], file["peaks/displacement"][:],
                file["peaks/acceleration"][:], file["energy/residual"][:], contacts,
                {name: file["impacts"][name][:] for name in file.get("impacts", []) if name != "contacts"},
                file["gaps/smallest"][:] if contacts else none, list(map(text_of, file["forces/names"])) if has_forces else [],
                file["forces/time"][:] if has_forces else none[0], file["forces/history"][:] if has_forces else none[:, None])
    except UNREADABLE as error:
        raise ResultError(f"{path}: no ensemble that can be read ({' '.join(str(error).split())})") from None


def damaged(file) -> list:
    """Members said to be done whose numbers are not those written: their CRC-32 stands beside them."""
    sums, found = file["members/crc32"], []
    names = text_of(sums.attrs["of"]).split(",")
    for member in np.flatnonzero(file["done"][:] == 1):
        crc = 0
        for name in names:
            crc = zlib.crc32(np.ascontiguousarray(file[name][member]).tobytes(), crc)
        found += [int(member)] if crc != sums[member] else []
    return found
