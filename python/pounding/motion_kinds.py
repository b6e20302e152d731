"""Kinds of rules on motions: how each finds its numbers, in which unit, and by which columns of a table it is told."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .motion_signals import G, STRONG, MotionError, Signal, Target, correlation, mean_around, read_target, response_spectra

FAR = 8.0  # spectra that differ from their target by so much at its highest frequency are in another unit
OCTAVE = 2.0  # a gap in a density is seen beside so much to both sides
SPECTRAL = ("grid", "target", "pga", "damping", "from", "to", "directions", "of")
OWN = ("directions",)


@dataclass(frozen=True)
class Motion:
    """Components that shake together: direction -> Signal."""

    name: str
    components: dict


@dataclass(frozen=True)
class Rule:
    """A row of a table; `cells` has the columns that are not empty, `place` the table and line for messages."""

    name: str
    kind: str
    least: float
    most: float
    cells: dict
    place: str
    folder: Path

    def fail(self, why: str):
        raise MotionError(f"{self.place} ({self.name}): {why}")

    def numbers(self, column: str, preset: tuple) -> tuple:
        return tuple(map(float, self.cells[column].split(":"))) if column in self.cells else preset

    def looks_at(self, direction: str) -> bool:
        return direction in self.cells.get("directions", "xyz")

    def peak(self, anchor: float | None) -> float:
        """Peak acceleration of the target [m/s2]."""
        if self.cells["pga"] != "anchor":
            return acceleration(self.cells["pga"])
        if anchor is None:
            self.fail("pga is `anchor`, and there is none; give --anchor, as 0.3g")
        return anchor

    def beyond(self, number: float) -> float:
        """How far a number is outside its limits, over them; below 0 inside."""
        over = (number - self.most) / (abs(self.most) or 1) if np.isfinite(self.most) else -np.inf
        below = (self.least - number) / (abs(self.least) or 1) if np.isfinite(self.least) else -np.inf
        return max(over, below)


@dataclass(frozen=True)
class Finding:
    """A number and where it was found."""

    number: float
    motion: str = ""
    component: str = ""
    frequency: float | None = None  # [Hz]
    time: float | None = None  # [s]


def acceleration(text: str) -> float:
    """A number with its unit [m/s2]. Throws MotionError."""
    found = re.fullmatch(r"\s*([\d.]+(?:[eE][-+]?\d+)?)\s*(g|m/s2|cm/s2)\s*", text)
    try:
        value = float(found[1]) * {"g": G, "m/s2": 1.0, "cm/s2": 0.01}[found[2]] if found else 0.0
    except ValueError:
        value = 0.0
    if not 0 < value < 1e3:
        raise MotionError(f"peak acceleration '{text}' is not a number above 0 with its unit, as 0.3g or 3m/s2")
    return value


class Bench:
    """The motions that are judged and what was computed of them once."""

    def __init__(self, motions: list, anchor: float | None, program: Path | None):
        self.motions, self.anchor, self.program = motions, anchor, program
        self._spectra = {}

    def components(self, rule: Rule) -> list:
        """(motion, direction, signal) of all that a rule looks at."""
        return [(motion, direction, signal) for motion in self.motions for direction, signal in motion.components.items()
                if rule.looks_at(direction)]

    def spectra(self, rule: Rule) -> tuple:
        """Frequencies of a rule and the spectra of all components, direction and name of the motion before each."""
        key = rule.cells["grid"], float(rule.cells.get("damping", 0.05))
        if key not in self._spectra:
            signals = [signal for motion in self.motions for signal in motion.components.values()]
            try:
                self._spectra[key] = response_spectra(signals, *key, self.program)
            except MotionError as error:
                rule.fail(f"grid {key[0]}, damping {key[1]:g}: {error}")
        frequency, values = self._spectra[key]
        inside = between(rule, frequency)
        labels = [(motion, direction) for motion in self.motions for direction in motion.components]
        for motion, direction, signal in self.components(rule):
            if signal.length < 1 / frequency[inside][0]:
                rule.fail(f"motion {signal.name} lasts {signal.length:.3g} s, less than a period of {frequency[inside][0]:g} Hz; take "
                          "a longer motion, or give from")
        return frequency[inside], [(*label, row[inside]) for label, row in zip(labels, values) if rule.looks_at(label[1])]


def between(rule: Rule, frequency: np.ndarray) -> np.ndarray:
    low, high = float(rule.cells.get("from", 0)), float(rule.cells.get("to", np.inf))
    inside = (frequency >= low * (1 - 1e-9)) & (frequency <= high * (1 + 1e-9))
    if not inside.any():
        rule.fail(f"no frequency of the grid is from {low:g} to {high:g} Hz")
    return inside


def curves(rule: Rule, rows: list) -> list:
    """(name of the motion, direction, values) of each component, or of the mean of a set per direction."""
    if rule.cells.get("of", "each") == "each":
        return [(motion.name, direction, values) for motion, direction, values in rows]
    if len({motion.name for motion, _, _ in rows}) < 2:
        rule.fail("of is `mean`, and there is one motion; give the set of them")
    found = {}
    for _, direction, values in rows:
        found.setdefault(direction, []).append(values)
    return [("mean of the set", direction, np.mean(values, 0)) for direction, values in found.items()]


def ratios(rule: Rule, bench: Bench) -> list:
    """(motion, direction, frequencies, spectrum over target) of all that a spectral rule looks at."""
    frequency, rows = bench.spectra(rule)
    target = own_target(rule).at(frequency, rule.peak(bench.anchor))
    for motion, direction, values in rows:
        if not 1 / FAR < values[-1] / target[-1] < FAR:
            rule.fail(f"motion {motion.name}, {direction}: {values[-1]:.3g} m/s2 at {frequency[-1]:g} Hz beside a target of {target[-1]:.3g}: is "
                      "the unit of the motion, or of pga, right?")
    return [(name, direction, frequency, values / target) for name, direction, values in curves(rule, rows)]


def own_target(rule: Rule, power: bool = False) -> Target:
    try:
        return read_target(rule.cells["target"], rule.folder, power)
    except MotionError as error:
        rule.fail(str(error))


def points_below(rule: Rule, bench: Bench) -> list:
    return [Finding(int((ratio < 1 - 1e-9).sum()), name, direction, float(f[ratio.argmin()]))
            for name, direction, f, ratio in ratios(rule, bench)]


def largest_below(rule: Rule, bench: Bench) -> list:
    return [Finding(float(max(100 * (1 - ratio.min()), 0)), name, direction, float(f[ratio.argmin()]))
            for name, direction, f, ratio in ratios(rule, bench)]


def largest_above(rule: Rule, bench: Bench) -> list:
    return [Finding(float(max(100 * (ratio.max() - 1), 0)), name, direction, float(f[ratio.argmax()]))
            for name, direction, f, ratio in ratios(rule, bench)]


def longest_run(below: np.ndarray) -> tuple:
    """Length of the longest run of what is true, and the place of its middle."""
    ends = np.flatnonzero(np.diff(np.concatenate([[0], below.astype(int), [0]])))
    if not len(ends):
        return 0, 0
    first, last = max(ends.reshape(-1, 2), key=lambda pair: pair[1] - pair[0])
    return int(last - first), int(first + last - 1) // 2


def neighbours_below(rule: Rule, bench: Bench) -> list:
    found = []
    for name, direction, f, ratio in ratios(rule, bench):
        length, middle = longest_run(ratio < 1 - 1e-9)
        found.append(Finding(length, name, direction, float(f[middle]) if length else None))
    return found


def points_per_decade(rule: Rule, bench: Bench) -> list:
    """The fewest, where two neighbours of the grid are furthest apart."""
    frequency = bench.spectra(rule)[0]
    steps = np.diff(np.log10(frequency))
    if not len(steps):
        rule.fail("its grid has one frequency")
    return [Finding(float(round(1 / steps.max(), 6)), "", "", float(frequency[steps.argmax()]))]


def densities(rule: Rule, bench: Bench, low: float, high: float) -> tuple:
    """Frequencies, and (motion, direction, density) of all components, each the mean from low to high times a frequency."""
    frequency, _ = bench.spectra(rule)
    window = rule.numbers("window", STRONG)
    rows = [(motion, direction, mean_around(*signal.power(window), frequency, low, high))
            for motion, direction, signal in bench.components(rule)]
    return frequency, rows


def psd_ratio(rule: Rule, bench: Bench) -> list:
    width = rule.numbers("smoothing", (20.0,))[0] / 100
    frequency, rows = densities(rule, bench, 1 - width, 1 + width)
    target = own_target(rule, power=True).at(frequency, rule.peak(bench.anchor))
    return [Finding(float((values / target).min()), name, direction, float(frequency[(values / target).argmin()]))
            for name, direction, values in curves(rule, rows)]


def psd_gap(rule: Rule, bench: Bench) -> list:
    width = rule.numbers("smoothing", (20.0,))[0] / 100
    frequency, near = densities(rule, bench, 1 - width, 1 + width)
    below, above = (densities(rule, bench, *ends)[1] for ends in ((1 / OCTAVE, 1), (1, OCTAVE)))
    found = []
    for (name, direction, values), *flanks in zip(*(curves(rule, rows) for rows in (near, below, above))):
        depth = values / np.sqrt(flanks[0][2] * flanks[1][2])
        found.append(Finding(float(depth.min()), name, direction, float(frequency[depth.argmin()])))
    return found


def of_each(number: Callable) -> Callable:
    """A rule on a number, and the time at which it is found, of each component alone."""
    def look(rule: Rule, bench: Bench) -> list:
        found = [(*number(rule, signal), motion.name, direction) for motion, direction, signal in bench.components(rule)]
        return [Finding(value, name, direction, None, time) for value, time, name, direction in found]

    return look


def _strong(rule: Rule, signal: Signal) -> tuple:
    first, last = signal.strong_part(rule.numbers("window", STRONG))
    return last - first, first


def _largest(values: np.ndarray) -> float:
    return float(abs(values).max())


def _when(signal: Signal, values: np.ndarray) -> float:
    return float(abs(values).argmax() * signal.step)


def _moving(signal: Signal) -> Signal:
    signal.strong_part()
    return signal


def correlated(rule: Rule, bench: Bench) -> list:
    """Of the components of a motion, or of the motions of a set along each direction."""
    shift, found = rule.numbers("shift", (0.0,))[0], []
    if rule.cells.get("of", "components") == "components":
        for motion in bench.motions:
            ways = [way for way in motion.components if rule.looks_at(way)]
            for i, j in [(i, j) for j in range(len(ways)) for i in range(j)]:
                value, time = correlation(motion.components[ways[i]], motion.components[ways[j]], shift)
                found.append(Finding(abs(value), motion.name, f"{ways[i]} {ways[j]}", None, time if shift else None))
        return found
    for j, other in enumerate(bench.motions):
        for one in bench.motions[:j]:
            for way in filter(rule.looks_at, one.components):
                value, time = correlation(one.components[way], other.components[way], shift)
                found.append(Finding(abs(value), f"{one.name}, {other.name}", way, None, time if shift else None))
    return found


def count(_rule: Rule, bench: Bench) -> list:
    return [Finding(len(bench.motions))]


@dataclass(frozen=True)
class Kind:
    """How a kind of rule finds its numbers, their unit, and the columns that it has beside those of every rule."""

    look: Callable
    unit: str
    columns: tuple


KINDS = {
    "points_below": Kind(points_below, "", SPECTRAL),
    "largest_below": Kind(largest_below, "%", SPECTRAL),
    "largest_above": Kind(largest_above, "%", SPECTRAL),
    "neighbours_below": Kind(neighbours_below, "", SPECTRAL),
    "points_per_decade": Kind(points_per_decade, "", ("grid", "from", "to")),
    "psd_ratio": Kind(psd_ratio, "", ("grid", "target", "pga", "from", "to", "directions", "of", "window", "smoothing")),
    "psd_gap": Kind(psd_gap, "", ("grid", "from", "to", "directions", "of", "window", "smoothing")),
    "time_step": Kind(of_each(lambda _, one: (one.step, None)), "s", OWN),
    "length": Kind(of_each(lambda _, one: (one.length, None)), "s", OWN),
    "strong_duration": Kind(of_each(_strong), "s", (*OWN, "window")),
    "peak_acceleration": Kind(of_each(lambda _, one: (one.peak, _when(one, one.values))), "m/s2", OWN),
    "peak_displacement": Kind(of_each(lambda _, one: (_largest(one.displacement), _when(one, one.displacement))), "m", OWN),
    "final_velocity": Kind(of_each(lambda _, one: (abs(float(one.velocity[-1])), one.length)), "m/s", OWN),
    "final_displacement": Kind(of_each(lambda _, one: (abs(float(one.displacement[-1])), one.length)), "m", OWN),
    "v_over_a": Kind(of_each(lambda _, one: (_largest(one.velocity) / _moving(one).peak, _when(one, one.velocity))), "s", OWN),
    "ad_over_v2": Kind(of_each(lambda _, one: (_moving(one).peak * _largest(one.displacement) / _largest(one.velocity) ** 2,
                                               _when(one, one.displacement))), "", OWN),
    "correlation": Kind(correlated, "", (*OWN, "of", "shift")),
    "motions": Kind(count, "", ()),
}
