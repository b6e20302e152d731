"""Recorded motions in the places of their synthetic counterparts: three components in one table."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pounding import UserError
from pounding.files import write_text

G = 9.80665  # of a file in g [m/s2]
# Components x, y, z: the larger horizontal one along the direction of the impacts.
FILES = {
    "El Centro": ("elcentro_1940/RSN6_IMPVALL.I_I-ELC180.AT2", "elcentro_1940/RSN6_IMPVALL.I_I-ELC270-hor2.AT2",
                  "elcentro_1940/RSN6_IMPVALL.I_I-ELC-UP.AT2"),
    "Northridge": ("northridge_1994/Rinaldi228.AT2", "northridge_1994/Rinaldi318.AT2",
                   "northridge_1994/RinaldiUP.AT2"),
    "Kobe": ("kobe_1995/RSN1106_KOBE_KJM000.AT2", "kobe_1995/RSN1106_KOBE_KJM090.AT2",
             "kobe_1995/RSN1106_KOBE_KJM-UP.AT2"),
}
RAMP = 0.2  # at the start of a window that is cut out of a record [s]


@dataclass(frozen=True)
class Record:
    """A table of time and three accelerations [m/s2], scaled alike by the program."""

    table: Path
    peak: float  # of x in the table [m/s2]
    directions: tuple = ("x", "y", "z")

    def words(self, pga: float) -> list:
        words = []
        for column, direction in enumerate(self.directions, start=2):
            words += [f"-motion_{direction}_record", str(self.table), f"-motion_{direction}_unit", "m/s2",
                      f"-motion_{direction}_column", str(column), f"-motion_{direction}_scale", repr(pga / self.peak)]
        return words


def read_at2(path: Path) -> tuple[float, np.ndarray]:
    """Time step [s] and accelerations [m/s2] of a PEER file of four header lines, in g."""
    try:
        lines = path.read_text(errors="replace").split("\n")
        fields = lines[3].replace("=", " ").replace(",", " ").split()
        count, step = int(fields[fields.index("NPTS") + 1]), float(fields[fields.index("DT") + 1])
        values = np.array(" ".join(lines[4:]).split(), dtype=float)[:count]
    except (OSError, ValueError, IndexError) as error:
        raise UserError(f"{path} is not a PEER AT2 file with NPTS and DT in its fourth line: {error}") from error
    if not 0 < step < 10 or len(values) < 2 or not np.isfinite(values).all():
        raise UserError(f"{path}: {len(values)} finite accelerations every {step:g} s are no record")
    return step, G * values


def strongest(values: np.ndarray, step: float, length: float) -> int:
    """First sample of the stretch of `length` seconds with the largest integral of a^2."""
    count = min(len(values), round(length / step))
    energy = np.concatenate([[0], np.cumsum(values**2)])
    return int(np.argmax(energy[count:] - energy[:-count]))


def load(folder: Path, motion: str, length: float, table: Path) -> Record:
    """Writes the table of a record, or if it is longer the strongest stretch of `length` seconds."""
    read = [read_at2(folder / name) for name in FILES[motion]]
    if len({step for step, _ in read}) != 1:
        raise UserError(f"the components of {motion} in {folder} have different time steps")
    step, count = read[0][0], min(len(values) for _, values in read)
    values = np.stack([values[:count] for _, values in read], 1)
    if length < (count - 1) * step:
        first = strongest(values[:, 0], step, length)
        values = values[first:first + round(length / step) + 1]
        if first > 0:
            values = values * np.clip(step * np.arange(len(values)) / RAMP, 0, 1)[:, None]
    table.parent.mkdir(parents=True, exist_ok=True)
    lines = ["time,x,y,z"] + [f"{i * step:.6f}," + ",".join(f"{value:.9g}" for value in row)
                              for i, row in enumerate(values)]
    write_text(table, "\n".join(lines) + "\n")
    return Record(table, float(abs(values[:, 0]).max()))


def load_all(folder: Path, length: float, tables: Path) -> dict:
    """Motion -> Record, for the motions that `folder` holds all three components of."""
    found = {motion: load(folder, motion, length, tables / f"{motion.lower().replace(' ', '-')}.csv")
             for motion, files in FILES.items() if all((folder / name).is_file() for name in files)}
    if not found:
        raise UserError(f"{folder} holds none of the records (expected e.g. {FILES['El Centro'][0]})")
    return found
