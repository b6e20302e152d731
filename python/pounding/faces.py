"""Absorbing faces on incoherent ground: the wave from below at their nodes as shapes times histories.

The motion of the nodes is that of the ground and what parts from it, u = 1 a + sum phi_k q_k. The shapes phi are a constant and
the eigenvectors of the coherency between the nodes, averaged over the frequency with the record's energy, that are left beside
the constant: one basis for all frequencies, orthonormal by the nodes' shares of the area W. Its coordinates q_k = phi_k W u
follow the ground as mats do, by C(f) = phi W gamma(f) W phi, and get their histories in the same way; what the basis leaves out
at a frequency is 1 - trace C(f).
"""

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
import scipy.linalg

from pounding import incoherent
from pounding.coherency import Coherency, CoherencyError
from pounding.fragility.study_file import Reader
from pounding.incoherent import Factors, Ground, Wave
from pounding.mats import read_ground

KEYS = ("faces", "part", "model", "wave", "seed")
PART = 0.999  # of the trace that shapes hold, where none is given
MOST_SHAPES = 400  # along an axis
MOST_NODES = 6000  # matrices are full


@dataclass(frozen=True)
class Faces:
    """Nodes of absorbing bases, shape (nodes, 3) [m], and their shares of the area, whose sum is 1. `part`: of the trace that
    shapes are to hold."""

    nodes: np.ndarray
    shares: np.ndarray
    part: float
    model: Coherency
    wave: Wave | None
    seed: int


@dataclass(frozen=True)
class Shapes:
    """Of an axis: shapes, shape (nodes, shapes), of which the first is 1 everywhere, factors of their histories, parts of the
    trace that they hold in the mean and that they leave out at the frequencies of the factors, and how much of it parts."""

    shapes: np.ndarray
    factors: Factors
    held: float
    left_out: np.ndarray
    parting: float


def read(reader: Reader) -> Faces:
    """What the keys KEYS of a file tell; `faces` is the model.h5 of a scene beside it. Throws UserError."""
    rows, part = _base_nodes(reader), reader.number("part", PART, 0.0)
    if not part < 1:
        reader.fail("part", "is not below 1: it is the part of the trace that shapes hold, as 0.999")
    return Faces(rows[:, :3], rows[:, 3] / rows[:, 3].sum(), part, *read_ground(reader))


def _base_nodes(reader: Reader) -> np.ndarray:
    """x, y, z and share of the area of all nodes of bases in a model.h5."""
    path = reader.path.parent / str(reader.values.get("faces"))
    try:
        with h5py.File(path) as file:
            found = [one["absorbing_base"][()] for one in file.values() if isinstance(one, h5py.Group) and "absorbing_base" in one]
    except OSError as error:
        reader.refuse("faces", f"{path}: is no model.h5 of a run ({error}); make it with -write_model true -dry_run true")
    if not found:
        reader.refuse("faces", f"{path}: no structure in it has faces of absorbing_base, through which a wave enters; name them in the scene")
    rows = np.concatenate(found)
    if len(rows) < 2 or len(rows) > MOST_NODES:
        reader.refuse("faces", f"{path}: {len(rows)} nodes; the coherency is one between 2 to {MOST_NODES} of them")
    return rows


def shapes_of(faces: Faces, records: dict, step: float) -> dict:
    """Shapes per axis of the records [m/s2], whose energy weighs the frequencies. Throws CoherencyError: nodes farther apart than
    the model reaches, more shapes than MOST_SHAPES, a model of which no ground can move so."""
    at = faces.nodes[:, :2]
    apart = np.sqrt(((at[:, None] - at[None]) ** 2).sum(2))
    if apart.max() > faces.model.farthest:
        raise CoherencyError(f"nodes of the faces are {apart.max():.4g} m apart, and {faces.model.name} is known up to "
                             f"{faces.model.farthest:g} m")
    if apart.max() == 0:
        raise CoherencyError("nodes of the faces lie on each other in plan, where all ground moves alike")
    ground = Ground(at, apart, faces.wave)
    return {axis: _shapes(faces, ground, axis, record, step) for axis, record in records.items()}


def _energies(record: np.ndarray, step: float, frequencies: np.ndarray) -> np.ndarray:
    """Parts of the record's energy at some frequencies, to which those between are shared."""
    size = 2 * len(record)
    place = np.interp(np.fft.rfftfreq(size, step), frequencies, np.arange(len(frequencies)))
    energy, low = abs(np.fft.rfft(record, size)) ** 2, np.minimum(place.astype(int), len(frequencies) - 2)
    found = (np.bincount(low, energy * (low + 1 - place), len(frequencies)) +
             np.bincount(low + 1, energy * (place - low), len(frequencies)))
    return found / found.sum()


def _shapes(faces: Faces, ground: Ground, axis: str, record: np.ndarray, step: float) -> Shapes:
    frequencies = incoherent.grid(0.5 / step)
    gammas = [faces.model.gamma(incoherent.way_of(axis), frequency, ground.distances) for frequency in frequencies]
    energies, root = _energies(record, step, frequencies), np.sqrt(faces.shares)
    if ground.delay is None:
        mean = ground.between(energies @ np.array(gammas))
    else:
        late = ground.delay[:, None] - ground.delay
        mean = sum(part * ground.between(gamma) * np.cos(2 * np.pi * frequency * late)
                   for part, gamma, frequency in zip(energies, gammas, frequencies))
    mean = root[:, None] * mean * root
    along = mean @ root
    alike = root @ along
    mean -= np.outer(root, along) + np.outer(along, root) - alike * np.outer(root, root)
    most = min(MOST_SHAPES, len(root))
    values, vectors = scipy.linalg.eigh(mean, subset_by_index=(len(root) - most, len(root) - 1))
    held = alike + np.append(0, np.cumsum(values[::-1]))
    count = int(np.argmax(held >= faces.part)) if held[-1] >= faces.part else most + 1
    if count > most:
        raise CoherencyError(f"part: along {axis} {most} shapes hold {held[-1]:.4g} of the trace, less than {faces.part:g}; give that")
    shapes = np.column_stack([np.ones(len(root)), vectors[:, ::-1][:, :count] / root[:, None]])
    traces = []

    def followed():
        for gamma, frequency in zip(gammas, frequencies):
            found = ground.follow(faces.shares * shapes.T, gamma, frequency)
            traces.append(np.trace(found[1]).real)
            yield found

    names = (("faces", axis), *(("faces", f"{axis} {k}") for k in range(1, count + 1)))
    factors = incoherent.factored(faces.model, frequencies, names, np.ones(count + 1), followed())
    return Shapes(shapes, factors, float(held[count]), 1 - np.array(traces), float(1 - alike))


def histories(record: np.ndarray, step: float, shapes: Shapes, noise: incoherent.Noise, random: np.random.Generator) -> np.ndarray:
    """Accelerations [m/s2] of the shapes, shape (shapes, samples), beside the record, which moves all nodes."""
    return np.array([own for _, _, own in incoherent.parts(record, step, shapes.factors, noise, random)])


def write(path: Path, faces: Faces, records: dict, step: float, shapes: dict, moved: dict) -> None:
    """The file that -motion_incoherent takes; `moved`: histories per axis."""
    with h5py.File(path, "w") as file:
        file.attrs.update(time_step=step, model=faces.model.name, seed=faces.seed, part=faces.part)
        file["nodes"] = faces.nodes
        for axis, record in records.items():
            file[f"{axis}/record"], file[f"{axis}/shapes"], file[f"{axis}/histories"] = record, shapes[axis].shapes, moved[axis]


def report(faces: Faces, records: dict, step: float, shapes: dict, moved: dict) -> list:
    """Lines for the user: shapes and what they leave out, and how far nodes part."""
    lines = [f"{faces.model.name}, seed {faces.seed}, {len(faces.nodes)} nodes"]
    for axis, record in records.items():
        of = shapes[axis]
        told = ", ".join(f"{max(0, np.interp(at, of.factors.frequencies, of.left_out)):.2g} at {at:g} Hz" for at in (2, 5, 10, 20)
                         if at <= of.factors.frequencies[-1])
        far = np.cumsum(np.cumsum(moved[axis], 1), 1) * step ** 2
        apart = max((np.ptp(of.shapes[:, 1:] @ now) for now in far[1:, ::max(1, int(0.01 / step))].T), default=0.0)
        lines += [f"{axis}: {of.shapes.shape[1]} shapes hold {of.held:.5f} of the trace, of which {of.parting:.3g} parts; left out {told}",
                  f"   peak {abs(record).max():.4g} m/s2; nodes part by {1e3 * apart:.3g} mm"]
    return lines
