"""Motions of rigid mats on ground that does not move alike: six components of all mats out of the records of the ground.

The records along x, y and z are independent. A mat follows the ground by least squares over its area, so that x moves u_x and
theta_z, y moves u_y and theta_z, z moves u_z, theta_x and theta_y, of all mats at once, with the matrix of spectra over that
of the record G = sum w w' gamma. It is factored as G = g g^H + S S: g, with the record's phases, is what the motion that all
mats would have if the ground moved alike tells about each; S, the root of the rest, meets noise that has the record's spectrum
and its envelope in time.
"""

from dataclasses import dataclass

import numpy as np
from scipy.fft import next_fast_len
from scipy.ndimage import gaussian_filter1d

from pounding.coherency import Coherency, CoherencyError

POINTS = 12  # of Gauss along a side of a mat
STEPS = 2000  # of distance, between which a coherency is straight
SEGMENT = 4.0  # of the noise [s]
EASE = 0.25  # in which mats begin to move apart once the record has set in, and end behind it [s]
TAIL = 2.0  # behind the record [s]
NOTHING = 1e-13  # part of the largest eigenvalue that is round-off
BANDS = 3  # of an octave, whose energies the noise has at every time
LOWEST = 1.0  # middle of the lowest of them [Hz]
ONSET = 5e-4  # part of the peak at which a record sets in
NEGATIVE = 0.01  # part of the spectra that a model may take from the others
COMPONENTS = ("x", "y", "z", "rx", "ry", "rz")
# What a record moves: component, and by which coordinates of a point of the mat (None: the mean).
MOVED = {"x": (("x", None, 1.0), ("rz", 1, -1.0)), "y": (("y", None, 1.0), ("rz", 0, 1.0)),
         "z": (("z", None, 1.0), ("rx", 1, 1.0), ("ry", 0, -1.0))}


@dataclass(frozen=True)
class Mat:
    """A rigid rectangle: its middle, about which it turns [m], and its sides along x and y [m]."""

    name: str
    centre: tuple
    sides: tuple


@dataclass(frozen=True)
class Wave:
    """A wave that passes with an apparent speed [m/s] towards (x, y)."""

    speed: float
    towards: tuple


@dataclass(frozen=True)
class Factors:
    """Of the motions that the record of an axis gives: names (mat, component), and at frequencies [Hz] g, shape (frequencies,
    components), and S, shape (frequencies, components, components)."""

    names: tuple
    frequencies: np.ndarray
    told: np.ndarray
    rest: np.ndarray

    def spectra(self) -> np.ndarray:
        """G, shape (frequencies, components, components)."""
        return self.told[:, :, None] * self.told[:, None, :].conj() + self.rest @ self.rest.conj().transpose(0, 2, 1)


def _points(mat: Mat) -> tuple:
    """Points of a mat beside its middle, shape (points, 2) [m], and weights whose sum is 1."""
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    at = np.array([[a * mat.sides[0] / 2, b * mat.sides[1] / 2] for a in nodes for b in nodes])
    return at, np.outer(weights, weights).ravel() / 4


def _rows(mats: list, axis: str) -> tuple:
    """Names of the components that an axis moves; over all points the weights by which they follow the ground, those of
    rotations times a length of the mat, and these lengths."""
    names, rows, lengths = [], [], []
    count = POINTS ** 2
    for number, mat in enumerate(mats):
        at, weight = _points(mat)
        for component, by, sign in MOVED[axis]:
            length, row = 1.0, weight
            if by is not None:
                turned = at if component == "rz" else at[:, [by]]
                inertia = (weight[:, None] * turned ** 2).sum()
                length = np.sqrt(inertia)
                row = sign * weight * at[:, by] / inertia * length
            names.append((mat.name, component))
            lengths.append(length)
            rows.append(np.concatenate([np.zeros(number * count), row, np.zeros((len(mats) - number - 1) * count)]))
    return tuple(names), np.array(rows), np.array(lengths)


def grid(highest: float) -> np.ndarray:
    """Frequencies at which factors are found [Hz]: denser where motions are slow, up to `highest`."""
    found = np.unique(np.concatenate([[0.0], np.geomspace(0.02, 1.0, 60), np.arange(1.0, 10.0, 0.1), np.arange(10.0, highest, 0.25),
                                      [highest]]))
    return found[found <= highest]


def factors_of(mats: list, model: Coherency, frequencies: np.ndarray, axes=("x", "y", "z"), wave: Wave | None = None) -> dict:
    """Factors per axis. Throws CoherencyError: two mats with one name, one mat alone, mats farther apart than the model reaches,
    a model of which no ground can move so."""
    if len(mats) < 2:
        raise CoherencyError(f"coherence tells how two mats move apart, and there is {'one' if mats else 'none'}; give another")
    if len({mat.name for mat in mats}) < len(mats):
        raise CoherencyError("two mats have one name")
    at = np.concatenate([_points(mat)[0] + mat.centre[:2] for mat in mats])
    apart = np.sqrt(((at[:, None] - at[None]) ** 2).sum(2))
    if apart.max() > model.farthest:
        raise CoherencyError(f"points of the mats are {apart.max():.4g} m apart, and {model.name} is known up to "
                             f"{model.farthest:g} m")
    ground = Ground(at, apart, wave)
    found = {}
    for axis in axes:
        names, weights, lengths = _rows(mats, axis)
        gammas = [model.gamma(way_of(axis), frequency, ground.distances) for frequency in np.asarray(frequencies)]
        found[axis] = factored(model, np.asarray(frequencies), names, lengths, zip(*ground.spectra(weights, gammas, frequencies)))
    return found


def way_of(axis: str) -> str:
    return "vertical" if axis == "z" else "horizontal"


class Ground:
    """Points of the ground, from each of which to each a coherency acts, straight between STEPS distances."""

    def __init__(self, at: np.ndarray, apart: np.ndarray, wave: Wave | None):
        self.distances = np.linspace(0, apart.max(), STEPS + 1)
        reduced = apart / self.distances[1]
        self.place = np.minimum(reduced.astype(int), STEPS - 1)
        self.part = reduced - self.place
        self.delay = None
        if wave:
            along = at @ (np.array(wave.towards, float) / np.hypot(*wave.towards))
            self.delay = (along - along.min()) / wave.speed  # of the points that it reaches after the first one

    def spectra(self, weights: np.ndarray, gammas: list, frequencies: np.ndarray) -> tuple:
        """Of motions that follow the ground by weights, where it moves alike and G, per frequency; `gammas`: at the distances."""
        if self.delay is None:
            shares = np.array([[self._shares(np.outer(a, b)) for b in weights] for a in weights])
            return [weights.sum(1)] * len(gammas), [shares @ gamma for gamma in gammas]
        pairs = [self.follow(weights, gamma, frequency) for gamma, frequency in zip(gammas, frequencies)]
        return [alike for alike, _ in pairs], [found for _, found in pairs]

    def follow(self, weights: np.ndarray, gamma: np.ndarray, frequency: float) -> tuple:
        """What `spectra` tells at one frequency."""
        late = weights if self.delay is None else weights * np.exp(-2j * np.pi * frequency * self.delay)
        return late.sum(1), late @ self.between(gamma) @ late.conj().T

    def between(self, gamma: np.ndarray) -> np.ndarray:
        """A coherency, given at the distances, of all pairs of points."""
        return gamma[self.place] + self.part * (gamma[self.place + 1] - gamma[self.place])

    def _shares(self, weights: np.ndarray) -> np.ndarray:
        """Of the distances in a sum over all pairs of points."""
        last = np.bincount(self.place.ravel(), (weights * self.part).ravel(), STEPS)
        first = np.bincount(self.place.ravel(), (weights * (1 - self.part)).ravel(), STEPS)
        return np.append(first, 0) + np.append(0, last)


def factored(model: Coherency, frequencies: np.ndarray, names: tuple, lengths: np.ndarray, followed) -> Factors:
    """Factors of motions that follow the ground; `followed`: per frequency the motions where it moves alike, and G; with those of
    rotations times their lengths. Throws CoherencyError."""
    told, rest = [], []
    for frequency, (alike, spectra) in zip(frequencies, followed):
        along = spectra @ alike
        first = along / np.sqrt((alike.conj() @ along).real)
        values, vectors = np.linalg.eigh(spectra - np.outer(first, first.conj()))
        size = np.trace(spectra).real
        if values[0] < -NEGATIVE * size:
            raise CoherencyError(f"{model.name}: at {frequency:.4g} Hz no ground can move so (its matrix has an eigenvalue of "
                                 f"{values[0]:.3g})")
        roots = np.sqrt(np.where(values > NOTHING * size, values, 0))
        told.append(first / lengths)
        rest.append((vectors * roots) @ vectors.conj().T / lengths[:, None])
    return Factors(names, frequencies, np.array(told), np.array(rest))


def onset(record: np.ndarray) -> int:
    """The first sample that is more than a two-thousandth of the peak."""
    return int(np.argmax(abs(record) > ONSET * abs(record).max()))


class Noise:
    """Noise that has the spectrum of a record in every segment of about 4 s, and its energy in every octave at every time.

    A segment is tapered before its phases are changed and again afterwards. The noise of each octave, drawn for itself, is
    multiplied by a slow function of time: the root of the record's mean square there over that expected of the segments."""

    def __init__(self, record: np.ndarray, step: float):
        self.first, self.count = onset(record), len(record)
        self.half = max(2, min(int(round(SEGMENT / 2 / step)), len(record)))
        size = 2 * self.half
        self.taper = np.sin(np.pi * (np.arange(size) + 0.5) / size)
        padded = np.concatenate([np.zeros(self.half), record, np.zeros(size)])
        self.starts = range(0, len(record) + self.half, self.half)
        segments = np.array([padded[start:start + size] for start in self.starts])
        amplitudes = abs(np.fft.rfft(segments * self.taper)) * np.sqrt(2)
        octaves = list(zip(*_octaves(np.fft.rfftfreq(size, step))))
        self.amplitudes = np.array([amplitudes * mask for _, mask in octaves])
        whole, (_, masks) = np.fft.rfft(padded), _octaves(np.fft.rfftfreq(len(padded), step), len(octaves))
        self.slow = []
        for (centre, _), mask, amplitude in zip(octaves, masks, self.amplitudes):
            width = np.clip(0.5 / centre, 0.05, 1.0) / step
            here = gaussian_filter1d(np.fft.irfft(whole * mask, len(padded)) ** 2, width, mode="constant")
            expected = self._together(2 * (amplitude ** 2).sum(1)[:, None] / size ** 2 * self.taper ** 2)
            self.slow.append(np.sqrt(here[:len(expected)] / np.maximum(expected, 1e-12 * expected.max() + np.finfo(float).tiny)))

    def _together(self, segments: np.ndarray) -> np.ndarray:
        """The sum of segments, each in its place."""
        found = np.zeros(self.half * (len(segments) + 1))
        for start, segment in zip(self.starts, segments):
            found[start:start + 2 * self.half] += segment
        return found

    def draw(self, random: np.random.Generator) -> np.ndarray:
        """As long as the record; nothing before it sets in."""
        phases = np.exp(2j * np.pi * random.random(self.amplitudes.shape))
        segments = np.fft.irfft(self.amplitudes * phases, 2 * self.half) * self.taper
        total = sum(slow * self._together(one) for slow, one in zip(self.slow, segments))[self.half:self.half + self.count]
        total[:self.first] = 0
        return total


def _octaves(frequency: np.ndarray, count: int = 0) -> tuple:
    """Middles of bands of a third of an octave [Hz] and factors on spectra, the sum of whose squares is 1; the lowest band holds all
    below LOWEST."""
    count = count or max(1, int(np.ceil(BANDS * np.log2(max(frequency[-1], 1.0) / LOWEST))))
    number = np.clip(BANDS * np.log2(np.maximum(frequency, 1e-9) / LOWEST), 0, count - 1)
    return LOWEST * 2.0 ** (np.arange(count) / BANDS), [np.cos(np.pi / 2 * np.minimum(abs(number - k), 1)) for k in range(count)]


def _end(motion: np.ndarray, step: float) -> tuple:
    """Velocity and displacement at the end, of straight lines between the samples."""
    left = (len(motion) - 1 - np.arange(len(motion))) * step
    weights = np.full(len(motion), step)
    weights[[0, -1]] = step / 2
    return weights @ motion, (weights * left) @ motion


def _to_rest(motion: np.ndarray, first: int, step: float) -> np.ndarray:
    """The motion less a pulse and its change of sign, slow and from its onset to its end, so that velocity and displacement end
    at zero."""
    place = np.clip((np.arange(len(motion)) - first) / max(1, len(motion) - 1 - first), 0, 1)
    shapes = [np.sin(np.pi * place) ** 2, np.sin(np.pi * place) ** 2 * np.cos(np.pi * place)]
    ends = np.array([_end(shape, step) for shape in shapes]).T
    return motion - np.array(shapes).T @ np.linalg.solve(ends, _end(motion, step))


def _ended(record: np.ndarray, count: int) -> np.ndarray:
    """The record and zeros behind it, but for two samples that take back the straight line from its last one: velocity and
    displacement end as they do where the ground stops with that."""
    found = np.pad(record, (0, count - len(record)))
    found[len(record):len(record) + 2] = record[-1] * np.array([-5 / 6, 1 / 3])
    return found


def motions(record: np.ndarray, step: float, factors: Factors, noise: Noise, random: np.random.Generator) -> dict:
    """Accelerations [m/s2, rad/s2] of the components that a record moves, by (mat, component): as long as the record and a tail
    behind it, in which they end. `noise`: of the record."""
    return {name: shared + own for name, shared, own in parts(record, step, factors, noise, random)}


def parts(record: np.ndarray, step: float, factors: Factors, noise: Noise, random: np.random.Generator):
    """For every component its name, what all of the ground shares of its acceleration, and the rest, which comes to rest: see
    `motions`."""
    count = len(record) + max(2, int(round(TAIL / step)))
    size = next_fast_len(count + int(round(SEGMENT / step)), real=True)
    frequency = np.fft.rfftfreq(size, step)

    def at(values: np.ndarray) -> np.ndarray:
        real = np.interp(frequency, factors.frequencies, values.real)
        return real + 1j * np.interp(frequency, factors.frequencies, values.imag) if np.iscomplexobj(values) else real

    drawn = [np.fft.rfft(noise.draw(random), size) for _ in factors.names]
    whole = np.fft.rfft(record, size)
    instant = np.arange(count)
    ease = np.clip(np.minimum(instant - noise.first, count - 1 - instant) * step / EASE, 0, 1)
    for number, name in enumerate(factors.names):
        shared = _ended(record, count) if name[1] in "xyz" else np.zeros(count)
        told = factors.told[:, number]
        spectrum = (at(told) - (name[1] in "xyz")) * whole
        for other, one in enumerate(drawn):
            spectrum = spectrum + at(factors.rest[:, number, other]) * one
        own = np.fft.irfft(spectrum, size)[:count] * np.sin(np.pi / 2 * ease) ** 2
        yield name, shared, _to_rest(own, noise.first, step)


def random_of(seed: int | tuple, axis: str) -> np.random.Generator:
    return np.random.default_rng([*np.atleast_1d(seed), "xyz".index(axis)])


def base_motions(records: dict, step: float, factors: dict, seed: int | tuple) -> dict:
    """Accelerations of every mat by component, {mat: {component: samples}}, out of the records per axis; rotations about z are the
    sum of those by x and y. One seed, of a number or several, gives the same motions always."""
    found = {}
    for axis, record in records.items():
        for (mat, component), values in motions(record, step, factors[axis], Noise(record, step), random_of(seed, axis)).items():
            own = found.setdefault(mat, {})
            own[component] = own[component] + values if component in own else values
    return found
