"""Records matched to a target spectrum in time, by wavelets that are added where oscillators have their peaks, so that
displacements stay: after L. Al Atik and N. Abrahamson, Earthquake Spectra 26 (2010), 601. `run/match` does so.

A wavelet is the second difference of a displacement, a tapered cosine, that begins and ends at rest: velocity and
displacement of the record's end stay. Amplitudes are those of damped least squares over the peaks of all oscillators,
those that stay too low weighing more from turn to turn, beside rows that hold the largest displacements.
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from scipy.linalg import expm
from scipy.signal import lfilter

from .arguments import positive
from .files import write_text
from .motion_kinds import KINDS, SPECTRAL, Bench, Motion, acceleration, own_target
from .motion_rules import REFUSED, directions_of, is_accepted, judge, lines_of, motions_of, read_rules, source_of, table_of
from .motion_signals import STRONG, MotionError, Signal, correlation, mean_around, read_signals, response_spectra

POINTS_A_CYCLE = 10  # of the highest frequency, at which motions are sampled
OSCILLATORS = 130  # at most about twice as many are followed at first, of finer grids each second or so
PATIENCE = 10  # turns without a better motion
WAVELETS = 80  # at most about twice as many
OTHER_PEAKS = 2  # of an oscillator that are held down beside its largest
RIDGE = 0.5  # part of a peak for whose gain no amplitude of its own size is taken
STEP, HALVING = 0.7, 12  # part of the amplitudes that is added, and after how many turns half of it
HEAVIEST = 8.0  # weight of an oscillator that stays too low
EARLIER = (1.0, 0.0)  # periods by which a wavelet comes before its oscillator's peak; the next where one does not do
HELD = 20.0  # weight of a row that holds a displacement, beside one of an oscillator
LOWEST = 4.0  # over the lowest frequency: until there spectra decide by how much a record is scaled
ABOVE = 1.3  # part of the least density to which it is raised
ROUNDS = 12  # in which it is raised again, at most
ENOUGH = 0.8  # part of a limit on displacement within which it counts as kept while it is looked for


@dataclass(frozen=True)
class Limits:
    """How far a matched motion may be from its record, and its components from independence."""

    peak_displacement: float = 0.05  # over that of the record
    final_displacement: float = 0.001  # [m]
    correlation: float = 0.16


@dataclass(frozen=True)
class Power:
    """A power spectral density [m2/s3] over frequencies [Hz] of which the motion's, its mean over a part `width` to both
    sides, is at least a part."""

    frequency: np.ndarray
    target: np.ndarray
    least: float
    width: float = 0.2
    window: tuple = STRONG

    def ratio(self, signal: Signal) -> np.ndarray:
        """Density over the target, over the least."""
        found = mean_around(*signal.power(self.window), self.frequency, 1 - self.width, 1 + self.width)
        return found / self.target / self.least


@dataclass(frozen=True)
class Goal:
    """What a component is matched to: pseudo-accelerations [m/s2] over frequencies [Hz] at a damping ratio, `aim` times
    which are sought; done where no oscillator is below the target or above `ceiling` times it."""

    frequency: np.ndarray
    target: np.ndarray
    damping: float = 0.05
    aim: float = 1.06
    ceiling: float = 1.25
    power: Power | None = None

    @property
    def thinned(self) -> "Goal":
        """The same at fewer frequencies, where there are many."""
        every = np.arange(len(self.frequency)) % max(len(self.frequency) // OSCILLATORS, 1) == 0
        every[-1] = True
        return replace(self, frequency=self.frequency[every], target=self.target[every])


@dataclass(frozen=True)
class Matched:
    """A motion matched to a target, and the record that it was: scaled, at the same samples."""

    record: Signal
    signal: Signal
    scale: float
    turns: int

    @property
    def peak_change(self) -> float:
        """Largest displacement over that of the record, less 1."""
        return float(abs(self.signal.displacement).max() / abs(self.record.displacement).max() - 1)

    @property
    def final_change(self) -> float:
        """Displacement at the end, less that of the record [m]."""
        return float(self.signal.displacement[-1] - self.record.displacement[-1])

    def misses(self, limits: Limits) -> list:
        """Limits that it does not keep, in words."""
        found = []
        if not abs(self.peak_change) <= limits.peak_displacement:
            found.append(f"peak displacement {100 * self.peak_change:+.2g} % off the record's, {100 * limits.peak_displacement:g} allowed")
        if not abs(self.final_change) <= limits.final_displacement:
            found.append(f"final displacement {1e3 * self.final_change:+.3g} mm off the record's, {1e3 * limits.final_displacement:g} allowed")
        return found


class Oscillators:
    """Pseudo-accelerations of oscillators under motions of one time step and length, straight between samples, exact at the
    samples, and until half a period of the lowest one behind the motion."""

    def __init__(self, frequency: np.ndarray, damping: float, step: float, samples: int):
        self.frequency, self.samples, self.step = frequency, samples, step
        self.padded = samples + int(0.5 / frequency[0] / step) + 1
        self.filters = [self._filter(2 * np.pi * f, damping, step) for f in frequency]
        impulse = np.zeros(self.padded)
        impulse[0] = 1.0
        self.impulse_responses = np.array([lfilter(*one, impulse) for one in self.filters])

    @staticmethod
    def _filter(omega: float, damping: float, step: float) -> tuple:
        """Coefficients of the recursion of omega^2 u, of the load and of itself."""
        motion = np.zeros((4, 4))
        motion[:2, :2] = [[0, 1], [-omega**2, -2 * damping * omega]]
        motion[1, 2], motion[2, 3] = -1, 1
        whole = expm(motion * step)
        advance, later = whole[:2, :2], whole[:2, 3] / step
        now = whole[:2, 2] - later
        rest = advance - np.trace(advance) * np.eye(2)
        load = np.array([later[0], now[0] + (rest @ later)[0], (rest @ now)[0]]) * omega**2
        return load, np.array([1.0, -np.trace(advance), np.linalg.det(advance)])

    def peaks(self, values: np.ndarray, target: np.ndarray) -> tuple:
        """Peak of each oscillator, its oscillator, sample and value; then further ones above the target."""
        load = np.pad(values, (0, self.padded - len(values)))
        found, more = [], []
        for i, one in enumerate(self.filters):
            size = abs(response := lfilter(*one, load))
            place = int(size.argmax())
            found.append((i, place, response[place]))
            half = max(int(0.45 / self.frequency[i] / self.step), 1)
            for _ in range(OTHER_PEAKS):
                size[max(place - half, 0):place + half] = 0
                place = int(size.argmax())
                if size[place] < 0.98 * target[i]:
                    break
                more.append((i, place, response[place]))
        return tuple(map(np.array, zip(*found, *more)))

    def rows(self, which: np.ndarray, places: np.ndarray) -> np.ndarray:
        """What a unit sample of the motion adds to each oscillator at its place, (oscillators, samples)."""
        found = np.zeros((len(places), self.samples), np.float32)  # for a step of the search
        for i, (one, place) in enumerate(zip(which, places)):
            first = max(place - self.samples + 1, 0)
            part = self.impulse_responses[one, first:place + 1][::-1]
            found[i, :len(part)] = part
        return found


def _rise(t: np.ndarray) -> np.ndarray:
    t = np.clip(t, 0, 1)
    return t**3 * (10 - 15 * t + 6 * t**2)


def wavelets(frequency: np.ndarray, places: np.ndarray, damping: float, step: float, samples: int, earlier: float) -> np.ndarray:
    """Accelerations of unit height (wavelets, samples) whose response turns at the sample `places` of each frequency, their
    middle so many periods `earlier`; their velocity and displacement are zero at both ends."""
    time = step * np.arange(-1, samples + 1)
    end = time[-2]
    found = np.empty((len(frequency), samples))
    for i, (f, place) in enumerate(zip(frequency, places)):
        omega = 2 * np.pi * f * np.sqrt(1 - damping**2)
        width = 1.178 * f**-0.93
        since = time - min(step * place, end) + earlier / f + np.arctan2(np.sqrt(1 - damping**2), damping) / omega
        taper = min(1 / f, end / 4)
        start = 2 * step / taper  # the first and last samples are still
        shape = np.cos(omega * since) * np.exp(-((since / width) ** 2)) * _rise(time / taper - start) * _rise((end - time) / taper - start)
        bent = np.diff(shape, 2) / step**2
        found[i] = bent / abs(bent).max()
    return found


def _held(record: np.ndarray, displacement: np.ndarray) -> list:
    """(sample, displacement wanted) at the largest displacement of the record, and where the motion turns beyond it."""
    peak = int(abs(record).argmax())
    most = abs(record[peak])
    turns = 1 + np.flatnonzero(np.diff(np.sign(np.diff(displacement))))
    beyond = [int(place) for place in turns if abs(displacement[place]) > 1.01 * most and place != peak]
    return [(peak, record[peak]), *((place, np.sign(displacement[place]) * 0.985 * most) for place in beyond)]


def resampled(signal: Signal, most: float) -> Signal:
    """The same motion, straight between samples, in steps of at most `most` [s]."""
    parts = max(int(np.ceil(signal.step / most - 1e-9)), 1)
    places = np.arange((len(signal.values) - 1) * parts + 1) / parts
    return Signal(signal.name, signal.step / parts, np.interp(places, np.arange(len(signal.values)), signal.values))


class _Search:
    """A motion on its way to a goal."""

    def __init__(self, record: Signal, goal: Goal, limits: Limits, start: Signal):
        self.record, self.goal, self.limits = record, goal, limits
        self.count, self.aim = len(goal.frequency), goal.aim * goal.target
        self.oscillators = Oscillators(goal.frequency, goal.damping, record.step, len(record.values))
        self.chosen = slice(None, None, max(self.count // WAVELETS, 1))
        self.most = abs(record.displacement).max()
        self.weight = np.ones(self.count)
        self.move(start.values)

    def move(self, values: np.ndarray) -> None:
        self.signal = Signal(self.record.name, self.record.step, values)
        self.which, self.places, self.peaks = self.oscillators.peaks(values, self.aim)
        self.ratio = abs(self.peaks[:self.count]) / self.goal.target
        self.change = abs(abs(self.signal.displacement).max() / self.most - 1)
        low = self.ratio / self.goal.aim < 0.96
        self.weight = np.clip(self.weight * np.where(low, 1.3, 0.95), 1, HEAVIEST)

    @property
    def excess(self) -> float:
        """How far beyond its limits the motion is displaced."""
        return max(self.change - ENOUGH * self.limits.peak_displacement, 0.0)

    @property
    def done(self) -> bool:
        return self.ratio.min() >= 1 and self.ratio.max() <= self.goal.ceiling and not self.excess

    @property
    def score(self) -> float:
        """Smaller is better."""
        ratio = self.ratio / self.goal.aim
        outside = max(1 / ratio.min() - 1, self.ratio.max() / self.goal.ceiling - 1, 0)
        return float(outside + 0.3 * np.sqrt((np.log(ratio) ** 2).mean()) + 5 * self.excess)

    def advance(self, step: float, earlier: float) -> None:
        goal, record, samples = self.goal, self.record, len(self.record.values)
        shapes = wavelets(goal.frequency[self.chosen], self.places[:self.count][self.chosen], goal.damping, record.step, samples, earlier)
        shapes *= self.aim[self.chosen, None]
        part = self.weight[self.which] / self.aim[self.which]
        rows = [part[:, None] * (self.oscillators.rows(self.which, self.places) @ shapes.T.astype(np.float32))]
        wanted = [part * np.sign(self.peaks) * (self.aim[self.which] - abs(self.peaks))]
        for place, value in _held(record.displacement, self.signal.displacement):
            gain = np.maximum(place - np.arange(samples), 0) * record.step**2
            rows.append(HELD / self.most * (shapes @ gain)[None, :])
            wanted.append([HELD / self.most * (value - self.signal.displacement[place])])
        matrix, right = np.vstack(rows), np.concatenate(wanted)
        amounts = np.linalg.solve(matrix.T @ matrix + RIDGE**2 * np.eye(matrix.shape[1]), matrix.T @ right)
        self.move(self.signal.values + step * (amounts @ shapes))


def raised(signal: Signal, power: Power) -> Signal:
    """The motion with more of the frequencies whose density is too low, in its own phases; its end stays at rest."""
    lacking = np.sqrt(np.maximum(ABOVE / power.ratio(signal), 1))
    size, step = 2 * len(signal.values), signal.step
    frequency = np.fft.rfftfreq(size, step)
    low, high = power.frequency[0], power.frequency[-1]
    at = np.concatenate([[0, low / 1.5], power.frequency, [1.5 * high, frequency[-1] + 1.5 * high]])
    gain = np.interp(frequency, at, np.concatenate([[1, 1], lacking, [1, 1]])) - 1
    circular = np.maximum(2 * np.pi * frequency, 1e-9)
    moved = np.fft.irfft(-gain / circular**2 * np.fft.rfft(signal.values, size), size)[:len(signal.values)]
    time = step * np.arange(len(moved))
    start = 2 * step * low
    moved *= _rise(time * low - start) * _rise((time[-1] - time) * low - start)
    return Signal(signal.name, step, signal.values + np.diff(np.pad(moved, 1), 2) / step**2)


def _best(record: Signal, goal: Goal, limits: Limits, start: Signal, turns: int, gone: int) -> tuple:
    """The motion that `start` becomes within so many turns, and how many they were; where none does, the best of them. Steps
    are those behind `gone` turns."""
    best = None
    for earlier in EARLIER:
        search, since = _Search(record, goal, limits, start), 0
        for turn in range(turns + 1):
            since += 1
            if best is None or search.score < best[0]:
                best, since = (search.score, search.signal, turn), 0
            if search.done:
                return search.signal, turn
            if since > PATIENCE:
                break
            if turn < turns:
                search.advance(STEP * 0.5 ** ((gone + turn) / HALVING), earlier)
    return best[1:]


def match(record: Signal, goal: Goal, limits: Limits = Limits(), scale: float = 1.0, turns: int = 40) -> Matched:
    """The record times `scale`, matched to a goal; where none of so many turns does, the best of them. It need not keep the
    limits: `misses` says so. Throws MotionError for a record whose ground does not move."""
    if not record.peak:
        raise MotionError(f"motion {record.name}: the ground does not move")
    fine = resampled(Signal(record.name, record.step, scale * record.values), 1 / goal.frequency[-1] / POINTS_A_CYCLE)
    goals = [goal.thinned, goal] if len(goal.thinned.frequency) < len(goal.frequency) else [goal]
    goals += [goal] * (ROUNDS if goal.power else 0)
    signal, count = fine, 0
    for round_, one in enumerate(goals):
        if goal.power:
            if round_ and one is goals[round_ - 1] and goal.power.ratio(signal).min() >= 1:
                break
            signal = raised(signal, goal.power)
        signal, more = _best(fine, one, limits, signal, turns, HALVING if round_ else 0)
        count += more
    return Matched(fine, signal, scale, count)


def scale_of(record: Signal, goal: Goal, program: Path | None = None) -> float:
    """Factor that brings the spectrum of a record to the target at its lowest frequencies, in the mean of logarithms: where
    the target is nearest to displacement, which wavelets are to leave alone."""
    low = goal.frequency <= LOWEST * goal.frequency[0]
    grid = ",".join(map(repr, goal.frequency[low].tolist()))
    found = response_spectra([record], grid, goal.damping, program)[1][0]
    if not found.min() > 0:
        raise MotionError(f"motion {record.name}: the ground does not move")
    return float(np.exp(np.log(goal.target[low] / found).mean()))


def goal_of(rules: list, direction: str, anchor: float | None, aim: float, grids: Callable) -> Goal:
    """What the spectral rules ask of a direction. `grids`: rule -> frequencies. Throws MotionError where there are none, and
    where they have several targets."""
    spectral = [rule for rule in rules if KINDS[rule.kind].columns == SPECTRAL and rule.looks_at(direction)]
    if not spectral:
        raise MotionError(f"the rules have no target for {direction}; matching needs a rule such as largest_below")
    wanted = {(rule.cells["target"], rule.peak(anchor), rule.cells.get("damping", "0.05")) for rule in spectral}
    if len(wanted) > 1:
        raise MotionError(f"the rules have {len(wanted)} targets for {direction}; a motion is matched to one: give each a table")
    frequency = np.unique(np.concatenate([grids(rule) for rule in spectral]))
    ceiling = min([rule.most for rule in spectral if rule.kind == "largest_above"], default=30.0)
    rule = spectral[0]
    power = [Power(at, own_target(one, True).at(at, one.peak(anchor)), one.least, one.numbers("smoothing", (20.0,))[0] / 100,
                   one.numbers("window", STRONG))
             for one in rules if one.kind == "psd_ratio" and one.looks_at(direction) and one.least > 0 for at in [grids(one)]]
    return Goal(frequency, own_target(rule).at(frequency, rule.peak(anchor)), float(rule.cells.get("damping", "0.05")), aim,
                1 + 0.95 * ceiling / 100, power[0] if power else None)


def match_motion(motion: Motion, rules: list, anchor: float | None = None, limits: Limits = Limits(), scale: float | None = None,
                 aim: float = 1.06, turns: int = 40, program: Path | None = None) -> dict:
    """Direction -> Matched, of each component of a motion to the target that the rules have for it; one scale for each
    component where none is given. Throws MotionError."""
    bench, found = Bench([motion], anchor, program), {}
    for direction, record in motion.components.items():
        goal = goal_of(rules, direction, anchor, aim, lambda rule: bench.spectra(rule)[0])
        factor = scale or scale_of(record, goal, program)
        found[direction] = match(record, goal, limits, factor, turns)
    return found


def misses_of(found: dict, limits: Limits) -> list:
    """Limits that matched components do not keep, in words."""
    words = [f"{direction}: {miss}" for direction, one in found.items() for miss in one.misses(limits)]
    for first, second, value in correlations_of(found):
        if not abs(value) <= limits.correlation:
            words.append(f"{first} and {second}: correlation {value:.3f}, {limits.correlation:g} allowed")
    return words


def correlations_of(found: dict) -> list:
    """(direction, direction, coefficient) of pairs of matched components."""
    ways, step = list(found), min((one.signal.step for one in found.values()), default=0)
    signals = {way: resampled(one.signal, step) for way, one in found.items()}
    return [(ways[i], ways[j], correlation(signals[ways[i]], signals[ways[j]])[0]) for j in range(len(ways)) for i in range(j)]


def text_of(one: Matched, about: str) -> str:
    """A matched motion as a record that the program reads."""
    rows = zip(one.signal.step * np.arange(len(one.signal.values)), one.signal.values)
    return f"# {about}\ntime s,acceleration m/s2\n" + "".join(f"{time:.9g},{value:.12g}\n" for time, value in rows)


def arguments(parser: argparse.ArgumentParser) -> argparse.ArgumentParser:
    """Options of the command."""
    parser.add_argument("rules", metavar="RULES", type=Path, help="table of rules whose targets are matched")
    parser.add_argument("files", metavar="FILE", nargs="+", help="record of each component")
    parser.add_argument("--anchor", metavar="PGA", help="peak acceleration of targets whose pga is `anchor`, as 0.3g")
    parser.add_argument("--directions", metavar="NAMES", help="components in the order of the files (default: x,y,z)")
    parser.add_argument("--unit", metavar="UNIT", help="of the records (default: as their headers say)")
    parser.add_argument("--columns", metavar="N,...", help="columns of the records")
    parser.add_argument("--time-step", metavar="S", help="of the records (default: as they say)")
    parser.add_argument("--scale", metavar="F", type=positive(float),
                        help="factor on every record (default: of each, by its spectrum at the lowest frequencies)")
    parser.add_argument("--aim", metavar="F", type=positive(float), default=1.06, help="times the target that is sought (default: 1.06)")
    parser.add_argument("--turns", metavar="N", type=int, default=40, help="at most (default: 40)")
    parser.add_argument("--peak-displacement", metavar="PERCENT", type=positive(float), default=5.0,
                        help="off that of the scaled record (default: 5)")
    parser.add_argument("--final-displacement", metavar="MM", type=positive(float), default=1.0,
                        help="off that of the scaled record (default: 1)")
    parser.add_argument("--correlation", metavar="R", type=positive(float), default=0.16, help="of components (default: .16)")
    parser.add_argument("--out", metavar="DIR", type=Path, required=True, help="folder of the matched components and tables")
    return parser


def carry_out(options: argparse.Namespace) -> int:
    """Matches, writes and judges; 0 where all limits and rules are kept, else REFUSED. Throws MotionError or OSError."""
    limits = Limits(options.peak_displacement / 100, options.final_displacement / 1e3, options.correlation)
    rules = read_rules(options.rules)
    anchor = acceleration(options.anchor) if options.anchor else None
    reading = [word for name in ("unit", "columns", "time_step") if (value := getattr(options, name))
               for word in (f"--{name.replace('_', '-')}", value)]
    signals = read_signals([*options.files, *reading])
    directions = directions_of(options.directions, len(signals))
    if len(directions) != len(signals):
        raise MotionError(f"--directions {options.directions or directions}: not one of x, y and z for each of {len(signals)} components")
    motion = motions_of(signals, directions)[0]
    found = match_motion(motion, rules, anchor, limits, options.scale, options.aim, options.turns)
    verdicts = judge(rules, [Motion(motion.name, {way: one.signal for way, one in found.items()})], anchor)
    options.out.mkdir(parents=True, exist_ok=True)
    rows = ["component,record,scale,turns,peak_displacement_m,of_record_m,change_percent,final_change_mm,time_step_s"]
    for way, one in found.items():
        name = one.record.name.replace(",", "_")
        write_text(options.out / f"{way}.csv", text_of(one, f"{name} times {one.scale:.6g}, matched to {options.rules.name}"))
        peaks = [abs(signal.displacement).max() for signal in (one.signal, one.record)]
        rows.append(f"{way},{name},{one.scale:.6g},{one.turns},{peaks[0]:.6g},{peaks[1]:.6g},{100 * one.peak_change:.4g},"
                    f"{1e3 * one.final_change:.4g},{one.signal.step:.9g}")
        print(f"{way}: {name} times {one.scale:.4g}, {one.turns} turns: peak displacement {peaks[0]:.4g} m, {100 * one.peak_change:+.2g} % off "
              f"the record's; at the end {1e3 * one.final_change:+.2g} mm off")
    for first, second, value in correlations_of(found):
        before = correlation(*(resampled(motion.components[way], min(one.step for one in signals)) for way in (first, second)))[0]
        print(f"{first} and {second}: correlation {value:+.3f}, of the records {before:+.3f}")
    write_text(options.out / "match.csv", "\n".join(rows) + "\n")
    write_text(options.out / "verdicts.csv", table_of(verdicts))
    print("\n" + "\n".join(lines_of(verdicts, source_of(options.rules))))
    misses = misses_of(found, limits)
    print("".join(f"not kept: {miss}\n" for miss in misses), end="")
    print(f"see {options.out}")
    return 0 if not misses and is_accepted(verdicts) else REFUSED
