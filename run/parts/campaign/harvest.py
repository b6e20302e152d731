"""What is kept of a run: spectra of the treated signals, and the series that the figures need."""

import json
import subprocess
from pathlib import Path

import h5py
import numpy as np

from pounding.files import written_beside
from pounding.runs import ending_with_us, program
from pounding.tables import read_csv

from .cases import Case

TREATED, PEAKS, SERIES, HISTORY = "treated.csv", "peaks.csv", "series.npz", "history.h5"
CHANNEL = "s2_floor2.x"  # whose signal is treated
FREQUENCIES = "0.5:400:200log"
STOREY_HEIGHT = 2.5  # [m]
BINS = 4000  # of a series: the smallest and largest value of each are kept


class HarvestError(Exception):
    """One line for the user."""


def impacts(folder: Path) -> list:
    """Lines of impacts.csv, numbers where they are numbers."""
    return [{name: value if name == "contact" else float(value) for name, value in row.items()} for row in read_csv(folder / "impacts.csv")]


def needs_treatment(case: Case, folder: Path) -> bool:
    return case.pounds and bool(impacts(folder))


def is_complete(case: Case, folder: Path) -> bool:
    wanted = [SERIES, "spectra.csv", "impacts.csv"]
    if not all((folder / name).is_file() for name in wanted):
        return False
    return not needs_treatment(case, folder) or all((folder / name).is_file() for name in (TREATED, PEAKS))


def extremes(time: np.ndarray, values: np.ndarray, keep=()) -> tuple[np.ndarray, np.ndarray]:
    """Smallest and largest value of each of `BINS` stretches in their order, and all samples in the
    intervals of time `keep`."""
    kept = np.zeros(len(time), dtype=bool)
    size = max(1, len(values) // BINS)
    starts = np.arange(0, len(values), size)
    for start in starts:
        part = values[start:start + size]
        kept[start + part.argmin()] = kept[start + part.argmax()] = True
    for start, end in keep:
        kept[np.searchsorted(time, start):np.searchsorted(time, end)] = True
    return time[kept], values[kept]


def write_series(case: Case, folder: Path) -> None:
    """Drift of the second storey and acceleration of the second floor of Structure 2 along x; peaks of
    the ground acceleration along x, y, z."""
    hits = impacts(folder) if case.pounds else []
    strongest = max(hits, key=lambda hit: hit["impulse"], default=None)
    around = [(strongest["start"] - 0.01, strongest["end"] + 0.03)] if strongest else []
    with h5py.File(folder / HISTORY, "r") as file:
        channels = [name.decode() for name in file["channels"][()]]
        column = {name: channels.index(name) for name in ("s2_floor1.x", "s2_floor2.x")}
        time, ground = file["time"][()], file["ground_acceleration"][()]
        acceleration = file["acceleration"][:, column["s2_floor2.x"]]
        stamps = time + float(file["acceleration"].attrs["time_offset"])
        lower, upper = (file["displacement"][:, column[name]] for name in ("s2_floor1.x", "s2_floor2.x"))
    drift = (upper - lower) / STOREY_HEIGHT
    drift_time, drift = extremes(time, drift)
    acceleration_time, acceleration = extremes(stamps, acceleration, around)
    with written_beside(folder / SERIES) as draft:
        np.savez_compressed(draft, drift_time=drift_time, drift=drift, acceleration_time=acceleration_time,
                            acceleration=acceleration, ground_peaks=abs(ground).max(axis=0))


def treat(folder: Path) -> None:
    words = ["--channels", CHANNEL, "--treatment", "all", "--frequencies", FREQUENCIES, "--output",
             str(folder / TREATED), "--peaks", str(folder / PEAKS), str(folder / HISTORY)]
    result = subprocess.run([program("pounding-spectra"), *words], capture_output=True, text=True, preexec_fn=ending_with_us())
    if result.returncode != 0:
        raise HarvestError(result.stderr.strip() or f"pounding-spectra ended with {result.returncode}")


def take(case: Case, folder: Path, keep_history: bool) -> None:
    """Everything from the history, which is large and then removed unless it is to be kept."""
    try:
        write_series(case, folder)
    except (OSError, KeyError, ValueError) as error:
        raise HarvestError(f"{folder / HISTORY}: {error}") from error
    if needs_treatment(case, folder):
        treat(folder)
    if not keep_history:
        (folder / HISTORY).unlink()


def one_line(folder: Path) -> str:
    """For the progress: impacts by contact."""
    summary = json.loads((folder / "summary.json").read_text())
    counts = {name: one["episodes"] for name, one in summary.get("impacts", {}).items() if isinstance(one, dict)}
    return ", ".join(f"{count} at {name}" for name, count in counts.items()) or "no contacts"
