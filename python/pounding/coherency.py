"""Coherency of ground motion: how much two points of the ground move alike, gamma(f, xi), as data or formulas."""

import csv
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import numpy as np

from pounding import UserError
from pounding.tables import read_csv

# Plane-wave coherency of hard rock, N. A. Abrahamson, Hard-Rock Coherency Functions Based on the Pinyon Flat Data (2007), as
# EPRI 1015110 gives it: [1 + (f t / (a1 fc))^n1]^-1/2 [1 + (f t / a2)^n2]^-1/2, t = tanh(0.4 xi), l = ln(xi + 1), with
# n1 = c0 + c1 l + c2 (l - 3.6)^2 and fc likewise; distances up to 150 m.
HARD_ROCK = {
    "horizontal": {"a1": 1.0, "a2": 40.0, "n1": (3.80, -0.040, 0.0105), "n2": 16.4, "fc": (27.9, -4.82, 1.24)},
    "vertical": {"a1": 1.0, "a2": 200.0, "n1": (2.03, 0.41, -0.078), "n2": 10.0, "fc": (29.2, -5.20, 1.45)},
}
FARTHEST = 150.0  # [m]
WAYS = ("horizontal", "vertical")


class CoherencyError(UserError):
    """One line for the user."""


@dataclass(frozen=True)
class Coherency:
    """A model: gamma of motion of one way, horizontal or vertical, at a frequency [Hz] and distances [m]; `farthest`: the
    distance up to which it is known."""

    name: str
    gamma: Callable[[str, float, np.ndarray], np.ndarray]
    farthest: float = np.inf


def hard_rock(way: str, frequency: float, distance: np.ndarray) -> np.ndarray:
    of = HARD_ROCK[way]
    distance = np.asarray(distance, float)
    length = np.log(distance + 1)
    n1, fc = (c0 + c1 * length + c2 * (length - 3.6) ** 2 for c0, c1, c2 in (of["n1"], of["fc"]))
    reduced = frequency * np.tanh(0.4 * distance)
    return (1 + (reduced / (of["a1"] * fc)) ** n1) ** -0.5 * (1 + (reduced / of["a2"]) ** of["n2"]) ** -0.5


def luco_wong(gamma: float, speed: float) -> Coherency:
    """exp(-(gamma omega xi / V_s)^2), J. E. Luco and H. L. Wong, Earthq. Eng. Struct. Dyn. 14 (1986), 891."""
    def value(_way: str, frequency: float, distance: np.ndarray) -> np.ndarray:
        return np.exp(-(gamma * 2 * np.pi * frequency * np.asarray(distance, float) / speed) ** 2)

    return Coherency(f"Luco-Wong, gamma {gamma:g}, V_s {speed:g} m/s", value)


def from_table(path: Path) -> Coherency:
    """A table of a user: columns frequency [Hz], distance [m], horizontal and, where it differs, vertical, a row for each pair
    of a frequency and a distance; straight between them, held beyond the frequencies. Distance 0 is 1. Throws CoherencyError
    or OSError."""
    try:
        read = np.array([[float(row[name]) for name in ("frequency", "distance", "horizontal")] +
                         [float(row.get("vertical") or row["horizontal"])] for row in read_csv(path)])
    except (KeyError, TypeError, ValueError, csv.Error) as error:
        raise CoherencyError(f"{path}: needs columns frequency, distance, horizontal and perhaps vertical, of numbers "
                             f"({' '.join(str(error).split())})") from error
    if not len(read) or not np.isfinite(read).all() or (read[:, :2] < 0).any() or (abs(read[:, 2:]) > 1).any():
        raise CoherencyError(f"{path}: frequencies and distances are not negative and coherencies from -1 to 1; some row is not so")
    frequencies, distances = np.unique(read[:, 0]), np.unique(read[:, 1])
    order = np.lexsort((read[:, 1], read[:, 0]))
    if len(read) != len(frequencies) * len(distances) or len(np.unique(read[:, :2], axis=0)) < len(read):
        raise CoherencyError(f"{path}: has {len(read)} rows for {len(frequencies)} frequencies and {len(distances)} distances; "
                             "give a row for each pair of them")
    values = dict(zip(WAYS, read[order, 2:].T.reshape(2, len(frequencies), len(distances))))
    known = distances
    if known[0] > 0:
        known = np.concatenate([[0.0], known])
        values = {way: np.column_stack([np.ones(len(frequencies)), value]) for way, value in values.items()}

    def value(way: str, frequency: float, distance: np.ndarray) -> np.ndarray:
        at = [np.interp(frequency, frequencies, column) for column in values[way].T]
        return np.interp(distance, known, at)

    return Coherency(f"table {path}", value, float(known[-1]))


def model_of(told, folder: Path = Path(".")) -> Coherency:
    """The model that a file of a user names: abrahamson_2007_hard_rock, coherent, {luco_wong: {gamma, vs}} or {table: FILE},
    which lies beside it. Throws CoherencyError or OSError."""
    if told == "abrahamson_2007_hard_rock":
        return Coherency("Abrahamson 2007, hard rock (EPRI 1015110)", hard_rock, FARTHEST)
    if told == "coherent":
        return Coherency("coherent", lambda _way, _frequency, distance: np.ones(np.shape(distance)))
    if isinstance(told, dict) and list(told) == ["table"]:
        return from_table(folder / str(told["table"]))
    if isinstance(told, dict) and list(told) == ["luco_wong"]:
        given = told["luco_wong"] if isinstance(told["luco_wong"], dict) else {}
        try:
            found = [float(given[name]) for name in ("gamma", "vs")]
        except (KeyError, TypeError, ValueError):
            found = []
        if len(given) != 2 or len(found) != 2 or not all(0 < one < np.inf for one in found):
            raise CoherencyError(f"model: luco_wong: {told['luco_wong']!r} is not gamma (0.1 to 0.3) and vs [m/s], above 0")
        return luco_wong(*found)
    raise CoherencyError(f"model: {told!r} is unknown; there are abrahamson_2007_hard_rock, coherent, luco_wong: {{gamma, vs}} and "
                         "table: FILE")
