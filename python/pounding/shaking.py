"""The motion of a floor for a shake table: without the slow part that no stroke holds, with velocity and displacement."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pounding.motion_signals import Signal, response_spectra
from pounding.results import Result, ResultError
from pounding.tables import write_rows

LOWEST, HIGHEST = 0.05, 20.0  # of the frequencies from which the motion may be kept [Hz]
UNITS = ("m", "m/s", "m/s2")
NAMES = ("stroke", "velocity", "acceleration")


@dataclass
class Motion:
    """Instants [s], acceleration [m/s2], velocity [m/s] and displacement [m]: of the floor from `above` [Hz] on and, unless
    that is infinite, up to `below`."""

    time: np.ndarray
    acceleration: np.ndarray
    velocity: np.ndarray
    displacement: np.ndarray
    above: float
    below: float

    @property
    def peaks(self) -> tuple:
        """Of displacement, velocity and acceleration, as UNITS."""
        return tuple(float(np.abs(one).max()) for one in (self.displacement, self.velocity, self.acceleration))


def motion_of(run: Result, probe: str, way: str, above: float, below: float = np.inf, interval: float = 0.0) -> Motion:
    """The absolute acceleration of a probe, in means over the interval of the instants [s] (that of the history or longer),
    eased out over its last twentieth, 1/(2 above) s at most, since the floor of a run that ends still moves; zeros of 2/above s
    before and after, in which the table settles; gains of a Butterworth filter of fourth order at both ends, without phase;
    velocity and displacement by division by i omega. Throws ResultError for a probe that was not recorded."""
    _, samples = run.series("acceleration", probe, way)
    step = float(run.summary["output_interval"])
    size = max(1, int(interval / step + 1e-6))
    samples = np.array(samples)[:len(samples) // size * size].reshape(-1, size).mean(1)
    step *= size
    ease = min(len(samples) // 20, int(round(0.5 / above / step)))
    samples[len(samples) - ease:] *= 0.5 * (1 + np.cos(np.pi * np.arange(1, ease + 1) / max(ease, 1)))
    pad = int(np.ceil(2 / above / step))
    count = len(samples) + 2 * pad
    padded = np.zeros(2 ** int(np.ceil(np.log2(2 * count))))
    padded[pad:pad + len(samples)] = samples
    spectrum = np.fft.rfft(padded)
    omega = 2 * np.pi * np.fft.rfftfreq(len(padded), step)
    omega[0] = 1.0
    frequency = omega / (2 * np.pi)
    spectrum *= 1 / (1 + (above / frequency) ** 8)
    if np.isfinite(below):
        spectrum *= 1 / (1 + (frequency / below) ** 8)
    spectrum[0] = 0
    columns = [np.fft.irfft(spectrum / (1j * omega) ** times, len(padded))[:count] for times in (0, 1, 2)]
    return Motion(step * np.arange(count), *columns, above, below)


def excess(motion: Motion, limits: list) -> str:
    """The limits of stroke, velocity and acceleration that a motion exceeds, in words; empty if it keeps them."""
    return ", ".join(f"{name} {peak:.3g} of {limit:g} {unit}" for name, peak, limit, unit
                     in zip(NAMES, motion.peaks, limits, UNITS) if peak > limit)


def lowest_within(run: Result, probe: str, way: str, below: float, interval: float, limits: list) -> float:
    """The lowest frequency [Hz], to a hundredth of it, from which on the motion keeps the limits of stroke and velocity.
    Throws ResultError where none up to HIGHEST does."""
    slow = [*limits[:2], np.inf]

    def within(above: float) -> bool:
        return not excess(motion_of(run, probe, way, above, below, interval), slow)

    low, high = LOWEST, HIGHEST
    if not within(high):
        raise ResultError(f"{run.folder}: no motion of {probe} along {way} from {high:g} Hz on keeps within {limits[0]:g} m and "
                          f"{limits[1]:g} m/s")
    if within(low):
        return low
    while high / low > 1.005:
        middle = np.sqrt(low * high)
        low, high = (low, middle) if within(middle) else (middle, high)
    found = float(f"{high:.3g}")
    return found if within(found) else float(f"{1.005 * high:.3g}")


def write(motion: Motion, path: Path, comment: str) -> None:
    rows = zip(motion.time, motion.acceleration, motion.velocity, motion.displacement)
    write_rows(path, ["time", "acceleration", "velocity", "displacement"],
               ([f"{value:.9g}" for value in row] for row in rows), comment)


def kept(run: Result, probe: str, way: str, motion: Motion) -> tuple:
    """Smallest and largest ratio of the motion's response spectrum to the floor's at the run's smallest damping ratio, from
    twice `above` to half of `below` and of the frequency of the instants; and these frequencies [Hz]. Throws RunError or
    MotionError."""
    damping = float(np.min(run.spectra["damping"]))
    frequency, floor = run.spectrum(probe, way, damping)
    highest = 0.5 * min(motion.below, 0.2 / (motion.time[1] - motion.time[0]))
    inside = (frequency >= 2 * motion.above) & (frequency <= highest) & (floor > 1e-6 * floor.max())
    if not inside.any():
        return None
    table = Signal("motion", motion.time[1] - motion.time[0], motion.acceleration)
    grid = ",".join(f"{one:.9g}" for one in frequency[inside])
    ratio = response_spectra([table], grid, damping, after="ignored")[1][0] / floor[inside]
    return float(ratio.min()), float(ratio.max()), float(frequency[inside][0]), float(frequency[inside][-1]), damping
