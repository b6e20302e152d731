"""Accelerograms as the program reads them, and numbers of their own: Arias intensity, velocity and displacement, power
spectral density, response spectra (the program's, which are exact), target spectra."""

import subprocess
import tempfile
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from pounding import UserError
from .log_interpolation import log_interpolated
from .runs import program as program_of
from .tables import read_csv

G = 9.80665  # [m/s2]
STRONG = (5.0, 75.0)  # part of the Arias intensity between which a motion is strong [%]
WORDS = {"unit": "--unit", "column": "--columns", "time_step": "--time-step"}  # options of a record for pounding-spectra


class MotionError(UserError):
    """What is wrong with a motion, a target or a table of rules: one line for the user."""


@dataclass(frozen=True)
class Signal:
    """Acceleration of the ground [m/s2] every `step` [s], straight between samples, from rest."""

    name: str
    step: float
    values: np.ndarray

    @property
    def length(self) -> float:
        """Time between the first sample and the last [s]."""
        return self.step * (len(self.values) - 1)

    @property
    def peak(self) -> float:
        return float(abs(self.values).max())

    @cached_property
    def velocity(self) -> np.ndarray:
        """At the samples [m/s]."""
        a = self.values
        return np.concatenate([[0.0], np.cumsum(a[:-1] + a[1:])]) * (self.step / 2)

    @cached_property
    def displacement(self) -> np.ndarray:
        """At the samples [m]."""
        a, v = self.values, self.velocity
        return np.concatenate([[0.0], np.cumsum(self.step * v[:-1] + self.step**2 / 6 * (2 * a[:-1] + a[1:]))])

    def strong_part(self, window: tuple = STRONG) -> tuple:
        """Times [s] at which the Arias intensity reaches two parts [%] of its whole. Throws MotionError for rest."""
        a = self.values
        intensity = np.concatenate([[0.0], np.cumsum(a[:-1] ** 2 + a[:-1] * a[1:] + a[1:] ** 2)])
        if not intensity[-1] > 0:
            raise MotionError(f"motion {self.name}: the ground does not move")
        found, along = [], np.linspace(0, 1, 1001)  # of a step, in which the intensity is a cubic
        for wanted in (part / 100 * intensity[-1] for part in window):
            k = min(int(np.searchsorted(intensity, wanted, "left")), len(a) - 1) or 1
            first, change = a[k - 1], a[k] - a[k - 1]
            within = 3 * (first**2 * along + first * change * along**2 + change**2 * along**3 / 3)
            found.append(self.step * (k - 1 + float(np.interp(wanted - intensity[k - 1], within, along))))
        return tuple(found)

    def power(self, window: tuple = STRONG) -> tuple:
        """Frequencies [Hz] and one-sided power spectral density [m2/s3] of the strong part alone: 2 |F|^2 / (2 pi T), F the
        Fourier transform of that part and T its length."""
        first, last = (round(time / self.step) for time in self.strong_part(window))
        part = self.values[first:last + 1]
        if len(part) < 8:
            raise MotionError(f"motion {self.name}: its strong part of {self.step * len(part):.3g} s has {len(part)} samples, "
                              "too few for a power spectral density; take a longer motion")
        transform = self.step * np.fft.rfft(part)
        return np.fft.rfftfreq(len(part), self.step), 2 * abs(transform) ** 2 / (2 * np.pi * self.step * len(part))


def mean_around(frequency: np.ndarray, values: np.ndarray, at: np.ndarray, low: float, high: float) -> np.ndarray:
    """Mean of values, straight between their frequencies, from `low` to `high` times each of the frequencies `at`."""
    whole = np.concatenate([[0.0], np.cumsum(np.diff(frequency) * (values[1:] + values[:-1]) / 2)])

    def until(f: np.ndarray) -> np.ndarray:
        left = np.clip(np.searchsorted(frequency, f, "right") - 1, 0, len(frequency) - 2)
        along = f - frequency[left]
        slope = (values[left + 1] - values[left]) / (frequency[left + 1] - frequency[left])
        return whole[left] + along * (values[left] + along * slope / 2)

    first, last = at * low, np.minimum(at * high, frequency[-1])
    return (until(last) - until(first)) / (last - first)


def correlation(one: Signal, other: Signal, shift: float = 0.0) -> tuple:
    """Correlation coefficient of two signals that is largest in absolute value where one of them starts later by up to
    `shift` [s], and that time [s]. Throws MotionError where their time steps differ."""
    if abs(one.step - other.step) > 1e-6 * one.step:
        raise MotionError(f"motions {one.name} and {other.name} have time steps of {one.step:g} and {other.step:g} s; bring them "
                          "to one")
    length = max(len(one.values), len(other.values))
    first, second = (np.pad(each.values, (0, length - len(each.values))) for each in (one, other))
    first, second = first - first.mean(), second - second.mean()
    norm = np.sqrt((first @ first) * (second @ second))
    if not norm > 0:
        raise MotionError(f"motion {one.name if not one.peak else other.name}: the ground does not move")
    most = min(round(shift / one.step), length - 1)
    padded = 2 * length
    all_lags = np.fft.irfft(np.fft.rfft(first, padded) * np.conj(np.fft.rfft(second, padded)), padded)
    lags = np.arange(-most, most + 1)
    found = all_lags[lags] / norm if most else np.array([first @ second / norm])
    worst = int(abs(found).argmax())
    return float(found[worst]), float(lags[worst] * one.step)


def _ask(words: list, program: Path | None) -> None:
    done = subprocess.run([str(program or program_of("pounding-spectra")), *map(str, words)], capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        lines = [line.removeprefix("pounding-spectra: ") for line in done.stderr.splitlines() if ": warning: " not in line]
        raise MotionError(lines[-1] if lines else f"pounding-spectra ended with exit status {done.returncode}")


def read_signals(words: list, program: Path | None = None) -> list:
    """Signals of the files, columns or channels that the words of a command line of pounding-spectra ask for. Throws
    MotionError."""
    with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
        samples, spectra = Path(folder, "samples.csv"), Path(folder, "spectra.csv")
        _ask([*words, "--frequencies", "1", "--digits", "17", "--samples", samples, "--output", spectra], program)
        names, steps = zip(*((row["probe"] + "." * bool(row["direction"]) + row["direction"], float(row["interval"]))
                             for row in read_csv(spectra)))
        lines = [line.rsplit(",", 2) for line in samples.read_text(encoding="utf-8").splitlines()
                 if not line.startswith(("#", "probe,direction,"))]
    labels, time, values = zip(*((label, float(t), float(a)) for label, t, a in lines))
    cuts = [k for k in range(1, len(time)) if time[k] <= time[k - 1] or labels[k] != labels[k - 1]]
    pieces = np.split(np.array(values), cuts)
    return [Signal(_short(name), step, piece) for name, step, piece in zip(names, steps, pieces, strict=True)]


def read_record(path: Path | str, options: dict) -> Signal:
    """Signal of a record, whose `options` are some of WORDS. Throws MotionError."""
    return read_signals([word for key, value in options.items() for word in (WORDS[key], value)] + [path])[0]


def _short(name: str) -> str:
    """Name of a signal without its folder: stem of the file, and the column where it has several."""
    path, colon, rest = name.rpartition(":")
    return f"{Path(path).stem}:{rest}" if colon and rest.startswith("column") else rest


def response_spectra(signals: list, grid: str, damping: float, program: Path | None = None, after: str = "auto") -> tuple:
    """Frequencies [Hz] and pseudo-accelerations [m/s2] of signals, shape (signals, frequencies), at a list of frequencies in
    the words of pounding-spectra (0.1:50:271log, regulatory, 1,2,3); `after`: what becomes of the free vibration behind the motion,
    in its words as well: auto, which counts it, or ignored."""
    with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
        files = []
        for number, signal in enumerate(signals):
            files.append(Path(folder, f"{number}.txt"))
            rows = zip(signal.step * np.arange(len(signal.values)), signal.values)
            files[-1].write_text("".join(f"{time:.17g} {value:.17g}\n" for time, value in rows))
        place = Path(folder, "spectra.csv")
        _ask([*files, "--unit", "m/s2", "--frequencies", grid, "--damping", repr(damping), "--after", after, "--digits", "17",
              "--output", place], program)
        rows = read_csv(place)
    found = np.array([float(row["pseudo_acceleration"]) for row in rows]).reshape(len(signals), -1)
    return np.array([float(row["frequency"]) for row in rows[:found.shape[1]]]), found


# Shapes of U.S. NRC Regulatory Guide 1.60, 5 % damping, over the peak acceleration: frequency [Hz], ratio; straight between
# them in logarithms, of constant displacement below .25 Hz.
SHAPES = {
    "rg160_horizontal": ((0.1, 0.4716 * 0.16), (0.25, 0.4716), (2.5, 3.13), (9, 2.61), (33, 1), (400, 1)),
    "rg160_vertical": ((0.1, 0.3152 * 0.16), (0.25, 0.3152), (3.5, 2.98), (9, 2.61), (33, 1), (400, 1)),
}
# Power spectral density of the horizontal one at a peak of 1 g, U.S. NRC SRP 3.7.1 appendix A: until which frequency [Hz] it
# is value [m2/s3] times (frequency / own frequency) to the exponent.
POWERS = {"rg160_psd": ((2.5, 0.419, 2.5, 0.2), (9, 0.419, 2.5, -1.8), (16, 0.0418, 9, -3), (400, 0.00742, 16, -8))}


@dataclass(frozen=True)
class Target:
    """A spectrum over frequencies [Hz], by its name or file. `power`: a density, which grows with the square of the peak and
    is stated at 1 g; else a response spectrum over the peak acceleration."""

    name: str
    points: tuple
    power: bool = False

    @property
    def ends(self) -> tuple:
        return (0.01, POWERS[self.name][-1][0]) if self.name in POWERS else (self.points[0][0], self.points[-1][0])

    def at(self, frequency: np.ndarray, peak: float) -> np.ndarray:
        """Values at frequencies and a peak acceleration [m/s2]. Throws MotionError outside of the target's frequencies."""
        frequency = np.asarray(frequency, float)
        low, high = self.ends
        if frequency.min() < low * (1 - 1e-9) or frequency.max() > high * (1 + 1e-9):
            raise MotionError(f"target {self.name} is stated from {low:g} to {high:g} Hz and asked for from {frequency.min():g} to "
                              f"{frequency.max():g} Hz; give from and to, or a longer target")
        scale = (peak / G) ** 2 if self.power else peak
        if self.name in POWERS:
            rows = POWERS[self.name]
            piece = np.minimum(np.searchsorted([row[0] for row in rows], frequency), len(rows) - 1)
            _, value, own, exponent = np.array(rows)[piece].T
            return scale * value * (frequency / own) ** exponent
        return scale * log_interpolated(frequency, *np.array(self.points).T)


def read_target(name: str, folder: Path, power: bool = False) -> Target:
    """A target by its name, or of a file of frequencies [Hz] and ratios or densities below a line of names; the path begins in
    `folder`. Throws MotionError."""
    known = POWERS if power else SHAPES
    if name in known:
        return Target(name, () if power else known[name], power)
    path = folder / name
    if not path.is_file():
        raise MotionError(f"target {name} is none of {', '.join(known)} and no file ({path})")
    points = []
    for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
        cells = line.split("#")[0].replace(",", " ").split()
        if not cells:
            continue
        try:
            first, second = map(float, cells)
        except ValueError:
            if points or len(cells) != 2:
                raise MotionError(f"{path}, line {number}: '{line.strip()}' is not a frequency and a value") from None
            continue  # names of the columns
        if not 0 < first < np.inf or not 0 < second < np.inf or points and first <= points[-1][0]:
            raise MotionError(f"{path}, line {number}: '{line.strip()}': frequencies increase, and both are above 0")
        points.append((first, second))
    if len(points) < 2:
        raise MotionError(f"{path}: holds {len(points)} points; a target has at least 2")
    return Target(name, tuple(points), power)
