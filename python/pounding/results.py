"""What a run left in its result folder, as numpy arrays. SI units throughout."""

import csv
import json
from collections import Counter
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np

from pounding import UserError
from . import summary_shape
from .equipment import CABINET, judge

DIRECTIONS = ("x", "y", "z")
GROUND = "ground"  # stands for a probe in the rows of spectra.csv that are the ground's


# File -> number of its layout that is read here. A number rises when names or numbers mean another thing.
SCHEMAS = {"summary.json": 1, "history.h5": 1, "fields.h5": 1, "modes.h5": 1, "model.h5": 1, "ensemble.h5": 1}


TABLES = ("history", "spectra", "impacts", "contact_points", "forces", "energy", "yielding", "equipment")
QUANTITIES = ("displacement", "velocity", "acceleration")
LABELS = ("channels", "contacts", "links", "forces", "bases", "rotations")  # lists of names in history.h5


class ResultError(UserError):
    """The folder or one of its files cannot be used: one line for the user."""


class Missing(Exception):
    """What a figure needs is not in the folder: one line for the user."""


def _listed(names) -> str:
    names = list(dict.fromkeys(map(str, names)))
    return ", ".join(names[:20]) + (f" and {len(names) - 20} more" if len(names) > 20 else "") or "none"


@dataclass(repr=False)
class Result:
    """A result folder; what the run did not leave is empty."""

    folder: Path
    summary: dict = field(default_factory=dict)
    history: dict = field(default_factory=dict)  # dataset name -> array
    offset: dict = field(default_factory=dict)  # dataset name -> shift of its time stamps [s]
    spectra: dict = field(default_factory=dict)  # column -> array
    impacts: dict = field(default_factory=dict)
    contact_points: dict = field(default_factory=dict)  # of contact_points.csv: pairs, and the impulse of each
    forces: dict = field(default_factory=dict)  # of forces.csv: largest values
    energy: dict = field(default_factory=dict)
    yielding: dict = field(default_factory=dict)  # of yielding.csv: laws of elements and how far they went
    others: dict = field(default_factory=dict)  # of tables that are none of these: name -> columns
    title: str = ""
    without: "Result | None" = None  # the run without pounding, where one is set beside it

    def table(self, name: str) -> dict:
        """Column -> array of the table NAME.csv, empty where the run left none."""
        return getattr(self, name) if name in COLUMNS else self.others.setdefault(name, {})

    @property
    def probes(self) -> list:
        names = [channel.rpartition(".")[0] for channel in self.history.get("channels", [])]
        return list(dict.fromkeys(names))

    @cached_property
    def spans(self) -> dict:
        """Name -> Span, how the ends of what goes from one structure to another move (pounding.spans)."""
        from .spans import of_run
        return of_run(self)

    @property
    def contacts(self) -> list:
        return list(self.history.get("contacts", []))

    @property
    def spectrum_probes(self) -> list:
        """Probes that spectra.csv has, without the ground and the cabinets of equipment."""
        names = dict.fromkeys(str(name) for name in self.spectra.get("probe", []))
        cabinets = {name + CABINET for name in self.summary.get("equipment", {})}
        return [name for name in names if (name != GROUND or name in self.probes) and name not in cabinets]

    @cached_property
    def _judged(self) -> tuple:
        return judge(self.summary, self.spectrum) if self.spectra else ({}, {})

    @property
    def verdicts(self) -> dict:
        """Items of equipment -> whether their capacity holds, the smallest ratio of it over the widened spectrum of their
        floor, its frequency and direction, the same by direction, and the rules that they are judged by. Nothing of a
        folder without spectra."""
        return self._judged[0]

    @property
    def equipment(self) -> dict:
        """Column -> array: equipment, direction, counted (1: in the band that counts), frequency [Hz], required and
        capacity [m/s2]."""
        return self._judged[1]

    def __repr__(self) -> str:
        words = [f"probes {_listed(self.probes or self.spectrum_probes)}"]
        if "end_time" in self.summary:
            words.insert(0, f"{self.summary['end_time']:g} s")
        episodes = self.summary.get("impacts", {}).get("episodes")
        if episodes is not None:
            words.append(f"{episodes} impacts")
        return f"Result({str(self.folder)!r}: {'; '.join([self.title, *words] if self.title else words)})"

    def series_if_any(self, quantity: str, probe: str, direction: str):
        """As series, or None if it was not recorded."""
        if quantity not in self.history or f"{probe}.{direction}" not in self.history.get("channels", []):
            return None
        column = self.history["channels"].index(f"{probe}.{direction}")
        time = self.history["time"] + self.offset.get(quantity, 0.0)
        return time, self.history[quantity][:, column]

    def series(self, quantity: str, probe: str, direction: str):
        """Time stamps and values of one channel. Throws ResultError, with what there is, if it was not recorded."""
        found = self.series_if_any(quantity, probe, direction)
        if found is None:
            recorded = [name for name in ("displacement", "velocity", "acceleration") if name in self.history]
            raise ResultError(f"{self.folder}: no {quantity} of {probe} along {direction} was recorded; there are "
                              f"{_listed(recorded)} of {_listed(self.history.get('channels', []))}")
        return found

    def to_frame(self, table: str = "history"):
        """A table as a DataFrame of pandas: of the history the channels by time, as "acceleration left_roof.x", times of
        quantities that are means over an interval at its end; else `spectra`, `impacts`, `contact_points`, `forces`,
        `energy`, `yielding` or `equipment` by its columns. Throws ResultError, without pandas as well."""
        try:
            import pandas
        except ImportError as error:
            raise ResultError("to_frame needs pandas, which is not installed: pip install pandas, or use the arrays "
                              "(history, spectra, ...)") from error
        if table not in TABLES:
            raise ResultError(f"to_frame: no table {table!r}; there are {', '.join(TABLES)}")
        if not getattr(self, table):
            raise ResultError(f"{self.folder}: the run left no {table}")
        if table != "history":
            return pandas.DataFrame(getattr(self, table))
        columns = {f"{quantity} {channel}": self.history[quantity][:, i] for quantity in QUANTITIES if quantity in self.history
                   for i, channel in enumerate(self.history["channels"])}
        columns |= {f"{quantity} {name}": self.history[quantity][:, i] for quantity in ("gap", "contact_force")
                    if quantity in self.history for i, name in enumerate(self.contacts)}
        return pandas.DataFrame(columns, index=pandas.Index(self.history["time"], name="time"))

    def base(self, structure: str, direction: str):
        """Times and displacements [m] of what a structure stands on, or None where that follows the ground."""
        name = f"{structure}.{direction}"
        if name not in self.history.get("bases", []):
            return None
        return self.history["time"], self.history["base_displacement"][:, self.history["bases"].index(name)]

    def force(self, name: str):
        """Times and values of one force, "base.Fx" or "corner.17.My1". Throws ResultError, with what there is, if it was
        not recorded."""
        if name not in self.history.get("forces", []):
            raise ResultError(f"{self.folder}: no force {name} was recorded; there are "
                              f"{_listed(self.history.get('forces', []))}")
        return self.history["time"], self.history["force"][:, self.history["forces"].index(name)]

    def spectrum_if_any(self, probe: str, direction: str, damping: float | None = None):
        """As spectrum, or None if there is none."""
        if not self.spectra or len(self.spectra["damping"]) == 0:
            return None
        ratio = self.spectra["damping"].min() if damping is None else damping
        rows = ((self.spectra["probe"] == probe) & (self.spectra["direction"] == direction)
                & np.isclose(self.spectra["damping"], ratio, rtol=1e-9, atol=0))
        if not rows.any():
            return None
        return self.spectra["frequency"][rows], self.spectra["pseudo_acceleration"][rows]

    def spectrum(self, probe: str, direction: str, damping: float | None = None):
        """Frequencies [Hz] and pseudo-acceleration [m/s2] of one floor response spectrum; without `damping` those of
        the smallest ratio. Throws ResultError, with what there is, if there is none."""
        found = self.spectrum_if_any(probe, direction, damping)
        if found is None:
            if not self.spectra:
                raise ResultError(f"{self.folder}: no spectra.csv; a run without probes has none")
            ratio = "" if damping is None else f" at a damping ratio of {damping:g}"
            raise ResultError(f"{self.folder}: no spectrum of {probe} along {direction}{ratio}; there are those of "
                              f"{_listed(self.spectra['probe'])} along {_listed(self.spectra['direction'])}, at "
                              f"{_listed(f'{one:g}' for one in self.spectra['damping'])}")
        return found

    def closings(self) -> dict:
        """Contact -> by how much its gap closed at most [m], from the recorded gaps; none of a history without."""
        found = {}
        if "gap" not in self.history:
            return found
        for column, name in enumerate(self.contacts):
            gap = self.history["gap"][:, column]
            one = self.summary.get("contacts", {}).get(name, {})
            if not one.get("initial_gap") or not np.isfinite(gap).any():
                continue
            # The history has the smallest gap alone; how far each pair closed is in the summary.
            found[name] = float(one.get("largest_closing", one["initial_gap"][-1] - np.nanmin(gap)))
        return found

    def scaled_by_closing(self, contact: str) -> str:
        """All that the closing factor of a contact multiplies: "motion", or "motion and loads"."""
        return self.summary["contacts"][contact].get("closing_factor_scales", "motion")

    def closing_factors(self) -> dict:
        """Contact -> how many times as strong a motion would just close it, as long as everything stays linear: the
        least of its pairs (see scaled_by_closing). Where summary.json does not tell, no more than that, from the widest gap
        at rest and the smallest gap of the history. Contacts that never close have none."""
        found = {}
        for name, closing in self.closings().items():
            one = self.summary["contacts"][name]
            widest = float(one["initial_gap"][-1])
            factor = one["closing_factor"] if "closing_factor" in one else max(widest, 0.0) / closing if closing > 0 else None
            if factor is not None and closing > 1e-3 * abs(widest):
                found[name] = float(factor)
        return found

    def need(self, *datasets: str) -> None:
        for name in datasets:
            if name not in self.history or len(self.history[name]) == 0:
                raise Missing(f"history.h5 has no {name}" if self.history else "no history.h5")


def require_schema(name: str, found) -> None:
    """Throws ValueError unless the file of this name has the schema that is read here; `found`: its attributes, or the
    object of a JSON file."""
    number = found.get("schema") if hasattr(found, "get") else None
    wanted = SCHEMAS[name]
    if number is None:
        raise ValueError(f"it has no schema number, so an earlier version wrote it and this one reads schema {wanted}: "
                         "make the run anew, or read it with that version")
    if number != wanted:
        raise ValueError(f"it is of schema {float(number):g}, this version reads schema {wanted}: "
                         "read it with the version that wrote it, or make the run anew")


def low_pass(values, time, frequency: float):
    """The low-pass of docs/manual/results.md: two poles of Butterworth forwards and backwards, both passes together
    leave 1/sqrt(2) at `frequency` [Hz]. Returns the values as they are where their samples hold no such filter."""
    if len(values) < 2 or frequency * (interval := time[1] - time[0]) > 0.25 * (1 + 1e-9):
        return values
    from scipy import signal
    cut = np.arctan(np.tan(np.pi * frequency * interval) / (np.sqrt(2) - 1) ** 0.25) / np.pi
    b, a = signal.butter(2, 2 * cut)
    return signal.filtfilt(b, a, values, padlen=0)


# What damaged files make of their readers.
UNREADABLE = (OSError, ValueError, KeyError, TypeError, IndexError, AttributeError, RuntimeError, ArithmeticError,
              MemoryError, csv.Error)


def _read_summary(path: Path) -> dict:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except RecursionError as error:
        raise ValueError("it is nested without end") from error
    if isinstance(found, dict) and "schema" in found:
        require_schema(path.name, found)
    summary_shape.check(found)
    require_schema(path.name, found)
    return found


def _read_history(path: Path, result: Result) -> None:
    with h5py.File(path, "r") as file:
        require_schema(path.name, file.attrs)
        result.title = text_of(file.attrs.get("title", ""))
        for name, dataset in file.items():
            if not isinstance(dataset, h5py.Dataset):
                continue
            values = dataset[()]
            if values.dtype.kind in "SO":
                values = [text_of(value).strip("\0 ") for value in values]
            result.history[name] = values
            result.offset[name] = float(np.ravel(dataset.attrs.get("time_offset", 0.0))[0])
    history = result.history
    if "time" not in history:
        raise ValueError("no dataset time")
    if np.ndim(history["time"]) != 1 or history["time"].dtype.kind not in "fiu":
        raise ValueError("time is no row of numbers")
    for labels in LABELS:
        if not isinstance(history.get(labels, []), list):
            raise ValueError(f"{labels} holds no names")
    if "records" in history:  # rows behind them were still being written when the run ended
        rows, whole = len(history["time"]), int(np.ravel(history.pop("records"))[0])
        if not 0 <= whole <= rows:
            raise ValueError(f"{whole} records of {rows}")
        for name, values in history.items():
            if name not in LABELS and len(values) == rows:
                history[name] = values[:whole]
    for name, labels in (("displacement", "channels"), ("velocity", "channels"),
                         ("acceleration", "channels"), ("gap", "contacts"),
                         ("contact_force", "contacts"), ("link_elongation", "links"), ("link_force", "links"),
                         ("force", "forces"), ("base_displacement", "bases"), ("rotation", "rotations"),
                         ("ground_acceleration", DIRECTIONS)):
        columns = len(labels if labels is DIRECTIONS else history.get(labels, []))
        shape = (len(history["time"]), columns)
        if name in history and history[name].shape != shape:
            raise ValueError(f"{name} has shape {history[name].shape}, not {shape}")


def text_of(value) -> str:
    """A text of an HDF5 file, whose letters h5py may leave as bytes."""
    if isinstance(value, np.ndarray):
        value = value.item() if value.size == 1 else ""
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def _read_table(path: Path) -> dict:
    """Columns of a CSV file: numbers where every value is one, else text. Lines of comments ('#') are passed over,
    which the files of earlier versions begin with."""
    lines = [line for line in path.read_text(encoding="utf-8").split("\n") if line and not line.startswith("#")]
    if not lines:
        raise ValueError("no header line")
    header, *rows = csv.reader(lines)
    if any(len(row) != len(header) for row in rows):
        raise ValueError(f"a line does not have {len(header)} values")
    table = {}
    for index, name in enumerate(header):
        values = [row[index] for row in rows]
        try:
            table[name.strip()] = np.array(values, dtype=float)
        except ValueError:
            table[name.strip()] = np.array(values, dtype=str)
    return table


# Columns that must be there; those of names hold text, the others numbers.
NAMES = ("probe", "direction", "contact", "item", "component", "element", "law")
COLUMNS = {
    "spectra": ("probe", "direction", "damping", "frequency", "pseudo_acceleration"),
    "impacts": ("contact", "start", "end", "duration", "impulse"),
    "contact_points": ("contact", "x", "y", "z", "impulse"),
    "forces": ("item", "component", "element", "peak", "time"),
    "energy": ("time", "kinetic", "strain", "input_work", "residual"),
    "yielding": ("law", "element", "ductility", "x", "y", "z"),
}


def _check_table(table: dict, kind: str) -> None:
    for name in COLUMNS[kind]:
        if name not in table:
            raise ValueError(f"no column {name}")
        if name not in NAMES and table[name].dtype.kind != "f":
            raise ValueError(f"column {name} has a value that is no number")
    if kind == "spectra":
        groups = Counter(zip(table["probe"], table["direction"], table["damping"]))
        most = max(groups.values(), default=0)
        for (probe, way, damping), count in groups.items():
            if count < most:
                raise ValueError(f"it is cut: {probe} {way} at {damping:g} has {count} of {most} frequencies")


def result_files(folder: Path) -> list:
    """Names of all files that a run may leave in its folder, as it says there before its first step; of a folder without
    that none."""
    head = "# Files of results: "
    try:
        lines = (folder / "resolved.yaml").read_text(errors="replace").splitlines()
    except OSError:
        return []
    return next((line.removeprefix(head).split() for line in lines if line.startswith(head)), [])


def load(folder: Path | str) -> Result:
    """Reads the folder. Throws ResultError if it is not there, holds nothing, or a file is bad."""
    folder = Path(folder)
    if not folder.is_dir():
        raise ResultError(f"{folder} is not a folder; give the output folder of a run")
    result = Result(folder)
    found = 0
    readers = {
        "summary.json": lambda path: result.summary.update(_read_summary(path)),
        "history.h5": lambda path: _read_history(path, result),
    }
    tables = dict.fromkeys([*COLUMNS, *(name[:-4] for name in result_files(folder) if name.endswith(".csv"))])
    for table in tables:
        readers[f"{table}.csv"] = lambda path: result.table(path.stem).update(_read_table(path))
    for name, read in readers.items():
        path = folder / name
        if not path.exists():
            continue
        found += 1
        try:
            if not path.is_file():  # a pipe would be waited for
                raise ValueError("no file with contents")
            read(path)
            if path.stem in COLUMNS:
                _check_table(result.table(path.stem), path.stem)
        except UNREADABLE as error:
            reason = " ".join(str(error).split()) or type(error).__name__
            raise ResultError(f"{path} cannot be read: {reason}") from error
    if not found:
        raise ResultError(f"{folder} holds no results (summary.json, history.h5, ...)")
    result.title = str(result.summary.get("title") or result.title or folder.name)
    return result


@dataclass(repr=False)
class Modes:
    """Lowest modes of one structure: `coordinates` (nodes, 3) [m], `frequencies` (modes) [Hz], `shapes`
    (modes, nodes, 3 or 6): x, y, z and the rotations about them, phi^T M phi = 1, of either sign."""

    coordinates: np.ndarray
    frequencies: np.ndarray
    shapes: np.ndarray

    def __repr__(self) -> str:
        return (f"Modes({len(self.frequencies)} of {len(self.coordinates)} nodes, "
                f"{_listed(f'{one:.4g}' for one in self.frequencies)} Hz)")


def load_modes(folder: Path) -> dict:
    """Structure -> Modes of the modes.h5 that `write_modes: true` leaves. Throws ResultError."""
    path = Path(folder) / "modes.h5"
    if not path.is_file():
        raise ResultError(f"{path}: no such file; run with -write_modes")
    try:
        with h5py.File(path, "r") as file:
            require_schema(path.name, file.attrs)
            return {name: Modes(group["coordinates"][()], group["frequencies"][()],
                                np.stack([group["shapes"][key][()] for key in sorted(group["shapes"])]))
                    for name, group in file.items() if isinstance(group, h5py.Group)}
    except UNREADABLE as error:
        raise ResultError(f"{path} cannot be read: {' '.join(str(error).split())}") from error
