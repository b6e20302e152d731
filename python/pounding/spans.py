"""Spans: lines, bridges and trays from one structure to another: motions of their two ends, and of the second against the first,
since the start, from the histories of a run."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from pounding.tables import write_csv, write_rows

from .results import DIRECTIONS, Result, ResultError

COMPONENTS = ("ux", "uy", "uz", "rx", "ry", "rz")
# What has a largest value: displacements and their length, rotations and theirs; the order in ensemble.h5.
MOTIONS = ("ux", "uy", "uz", "u", "rx", "ry", "rz", "r")
ROUND_OFF = 1e-9  # of the length of its kind
INTERVAL = 1e-3  # between the lines of a history unless another is asked for [s]


def unit_of(motion: str) -> str:
    return "m" if motion.startswith("u") else "rad"


@dataclass(eq=False)
class Span:
    """`ends`: probes of the first and the second; `structures`, `places` [m] of these. `motion` (ends, records, 6): displacements
    relative to the ground [m] and rotations [rad] since the start; `ground` (records, 3): displacement of the ground [m]."""

    name: str
    ends: tuple
    structures: tuple
    places: tuple
    time: np.ndarray
    motion: np.ndarray
    ground: np.ndarray
    counted: int = 0  # the first record of which largest values are

    @property
    def relative(self) -> np.ndarray:
        """The second end against the first (records, 6)."""
        return self.motion[1] - self.motion[0]

    @cached_property
    def largest(self) -> tuple:
        """Largest absolute values of MOTIONS [m, rad], and their times [s]."""
        apart = self.relative[self.counted:]
        lengths = [np.linalg.norm(apart[:, part], axis=1) for part in (slice(0, 3), slice(3, 6))]
        values = np.column_stack([abs(apart[:, :3]), lengths[0], abs(apart[:, 3:]), lengths[1]])
        at = values.argmax(0)
        return values[at, range(len(MOTIONS))], np.where(values.max(0) > 0, self.time[self.counted:][at], 0.0)

    def rows(self) -> list:
        """A row per motion: its largest value and when; round-off is 0."""
        length = np.repeat(self.largest[0][3::4], 4)
        return [{"span": self.name, "from": self.ends[0], "to": self.ends[1], "motion": motion, "unit": unit_of(motion),
                 "largest": float(value) if value > ROUND_OFF * of else 0.0, "time [s]": float(time)}
                for motion, value, time, of in zip(MOTIONS, *self.largest, length)]

    def write_history(self, path: Path, interval: float = INTERVAL) -> None:
        """A table with a line per record, or per as many as make up the interval [s]: both ends relative to the ground, the
        second against the first, and the displacements of both in space, which are those relative to the ground and the
        ground's; rotations in space are the same, as the ground does not turn."""
        own = self.time[1] - self.time[0] if len(self.time) > 1 else 1.0
        take = slice(None, None, max(1, round(interval / own)))
        head = ["time", *(f"{part}_{one}" for part in ("from", "to", "relative") for one in COMPONENTS),
                *(f"absolute_{end}_{one}" for end in ("from", "to") for one in COMPONENTS[:3])]
        columns = np.column_stack([self.time, self.motion[0], self.motion[1], self.relative,
                                   *(motion[:, :3] + self.ground for motion in self.motion)])[take]
        write_rows(path, head, ([f"{value:.9g}" for value in row] for row in columns))


def ground_displacement(run: Result) -> np.ndarray:
    """Displacement of the ground at the times of the displacements, by what the steps of the run made of its accelerations
    (records, 3): these are changes of velocity over the output interval, that of the first over half a step."""
    time, half = run.history["time"], run.offset.get("velocity", 0.0)
    interval = time[1] - time[0] if len(time) > 1 else 0.0
    velocity = interval * np.cumsum(run.history["ground_acceleration"], 0)  # half a step after the displacements
    way = interval * (velocity[1:] + velocity[:-1]) / 2 - half * np.diff(velocity, axis=0)
    return np.concatenate([np.zeros((1, 3)), np.cumsum(way, 0)])


def of_run(run: Result) -> dict:
    """Name -> Span of a run; none of a run without spans. Throws ResultError."""
    names = list(dict.fromkeys(rotation.split(".")[0] for rotation in run.history.get("rotations", [])))
    if not names or not len(run.history["time"]):
        return {}
    start = float(run.summary.get("options", {}).get("spectra_start", 0.0))
    half = run.offset.get("velocity", 0.0)
    ground, found = ground_displacement(run), {}
    for name in names:
        columns = [place for place, one in enumerate(run.history["rotations"]) if one.startswith(f"{name}.")]
        ends = tuple(run.history["rotations"][place].partition(".")[2].rpartition(".")[0] for place in columns[::3])
        if len(columns) != 6 or any(f"{end}.{way}" not in run.history["channels"] for end in ends for way in DIRECTIONS):
            raise ResultError(f"{run.folder}: the ends of span {name} are not whole in history.h5")
        motion = np.stack([np.column_stack([*(run.series("displacement", end, way)[1] for way in DIRECTIONS),
                                            run.history["rotation"][:, columns[3 * number:3 * number + 3]]])
                           for number, end in enumerate(ends)])
        told = [run.summary.get("probes", {}).get(end, {}) for end in ends]
        interval = run.history["time"][1] - run.history["time"][0] if len(run.history["time"]) > 1 else 1.0
        counted = int(np.ceil((start - half + interval / 2) / interval - 1e-6)) if start > 0 else 0
        found[name] = Span(name, ends, tuple(one.get("structure", "") for one in told),
                           tuple(tuple(one.get("position", (np.nan,) * 3)) for one in told),
                           run.history["time"], motion - motion[:, :1], ground, counted)
    return found


def spectra_rows(run: Result, span: Span) -> list:
    """Floor spectra at both ends, and the larger of the two, by direction, damping ratio and frequency."""
    rows = []
    for way in DIRECTIONS:
        for ratio in np.unique(run.spectra["damping"]):
            (frequency, first), (_, second) = (run.spectrum(end, way, ratio) for end in span.ends)
            rows += [{"direction": way, "damping": f"{ratio:g}", "frequency": f"{f:.9g}", "from": f"{a:.6g}", "to": f"{b:.6g}",
                      "envelope": f"{max(a, b):.6g}"} for f, a, b in zip(frequency, first, second)]
    return rows


def write(run: Result, folder: Path, interval: float = INTERVAL) -> list:
    """spans.csv, and of each span its history and its spectra in files of their own; returns the rows of spans.csv."""
    folder.mkdir(parents=True, exist_ok=True)
    rows = []
    for name, span in run.spans.items():
        rows += span.rows()
        span.write_history(folder / f"span_{name}.csv", interval)
        if run.spectra:
            write_csv(folder / f"span_{name}_spectra.csv", spectra_rows(run, span))
    write_csv(folder / "spans.csv", rows)
    return rows
