"""Motions of ground that does not move alike, of rigid mats or absorbing faces: run/incoherent FILE [--seed N] [--out DIR]

FILE (YAML) names the mats with centre, sides and what stands on them, or the faces, the records along x, y and z, and a
model of coherency. Writes the six components of every mat as DIR/MAT.csv, and DIR/supports.yaml, the block of options by
which a scene takes them; of faces DIR/wave.h5, shapes and histories, and DIR/wave.yaml. One seed gives the same motions
always. docs/manual/incoherence.md has the keys and the method.
"""

from pathlib import Path

import numpy as np

from pounding import faces, incoherent, mats
from pounding.coherency import CoherencyError
from pounding.files import file_name
from pounding.fragility.study_file import Reader, load
from pounding.motion_signals import WORDS, read_record
from pounding.results import DIRECTIONS
from pounding.scenes import write_scene

from .process import parser_of


def read(path: Path, seed: int | None) -> tuple:
    """Coherence or Faces, and options of the records per axis. `seed`: in place of that of the file. Throws UserError."""
    values = load(path)
    of = faces if isinstance(values, dict) and "faces" in values else mats
    reader = Reader(values, path, "", (*of.KEYS, "motion"))
    if seed is not None:
        reader.values["seed"] = seed
    motion = reader.part("motion", DIRECTIONS)
    if not motion.values:
        reader.refuse("motion", "needs records along some of x, y and z, as `motion: {x: {record: FILE}}`")
    records = {axis: motion.part(axis, ("record", "scale", *WORDS)) for axis in DIRECTIONS if axis in motion.values}
    for one in records.values():
        if not isinstance(one.values.get("record"), str):
            one.fail("record", "is no file; a record has it, and perhaps unit, column, time_step and scale")
    return of.read(reader), {axis: {**one.values, "scale": one.number("scale", 1)} for axis, one in records.items()}


def records_of(motion: dict, folder: Path) -> tuple:
    """Accelerations [m/s2] per axis, as long as the longest of them, and their step [s]. Throws CoherencyError or MotionError."""
    found = {axis: read_record(folder / one["record"], {key: one[key] for key in WORDS if key in one}) for axis, one in motion.items()}
    steps = [signal.step for signal in found.values()]
    if max(steps) > (1 + 1e-6) * min(steps):
        raise CoherencyError("motion: the records have different steps, " +
                             ", ".join(f"{axis} {signal.step:g} s" for axis, signal in found.items()) + "; give records of one step")
    count = max(len(signal.values) for signal in found.values())
    return {axis: motion[axis]["scale"] * np.pad(signal.values, (0, count - len(signal.values)))
            for axis, signal in found.items()}, steps[0]


def report(found: mats.Coherence, records: dict, step: float, motions: dict) -> list:
    lines = [f"{found.model.name}, seed {found.seed}"]
    for axis, record in records.items():
        peaks = ", ".join(f"{mat} {abs(own[axis]).max():.4g}" for mat, own in motions.items())
        apart = [np.cumsum(np.cumsum(motions[a.name][axis] - motions[b.name][axis])) * step ** 2
                 for place, a in enumerate(found.mats) for b in found.mats[:place]]
        lines.append(f"{axis}: peak {abs(record).max():.4g} m/s2, {peaks}; mats part by {1e3 * max(abs(one).max() for one in apart):.3g} mm")
    turned = {mat: max((abs(own[name]).max() for name in ("rx", "ry", "rz") if name in own), default=0) for mat, own in motions.items()}
    return [*lines, "rotations up to " + ", ".join(f"{mat} {value:.3g}" for mat, value in turned.items()) + " rad/s2"]


def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("file", metavar="FILE", type=Path, help="mats or faces, records and model")
    parser.add_argument("--seed", metavar="N", type=int, help="in place of that of the file (default there: 1)")
    parser.add_argument("--out", metavar="DIR", type=Path, default=Path("incoherent"), help="(default: %(default)s)")
    options = parser.parse_args()
    found, motion = read(options.file, options.seed)
    records, step = records_of(motion, options.file.parent)
    make = make_wave if isinstance(found, faces.Faces) else make_supports
    print("\n".join(make(found, records, step, options.out)))
    return 0


def make_wave(found: faces.Faces, records: dict, step: float, folder: Path) -> list:
    """Writes the wave of some faces, and the options by which a scene takes it; lines for the user."""
    shapes = faces.shapes_of(found, records, step)
    moved = {axis: faces.histories(record, step, shapes[axis], incoherent.Noise(record, step), incoherent.random_of(found.seed, axis))
             for axis, record in records.items()}
    folder.mkdir(parents=True, exist_ok=True)
    faces.write(folder / "wave.h5", found, records, step, shapes, moved)
    write_scene(folder / "wave.yaml", {"motion_input": "below", "motion_incoherent": str((folder / "wave.h5").absolute())},
                f"Wave from below on incoherent ground: {found.model.name}, seed {found.seed}; `include` it in a scene.")
    return [*faces.report(found, records, step, shapes, moved), f"see {folder / 'wave.yaml'}"]


def make_supports(found: mats.Coherence, records: dict, step: float, folder: Path) -> list:
    """Writes the motions of mats, and the options by which a scene takes them; lines for the user."""
    factors = incoherent.factors_of(found.mats, found.model, incoherent.grid(0.5 / step), tuple(records), found.wave)
    motions = incoherent.base_motions(records, step, factors, found.seed)
    folder.mkdir(parents=True, exist_ok=True)
    names = mats.components(motions)
    files = {mat: (folder / f"{file_name(mat)}.csv").absolute() for mat in motions}
    for mat, own in motions.items():
        mats.write(files[mat], own, step, names)
    write_scene(folder / "supports.yaml", mats.support_options(found, names, files),
                f"Supports on incoherent ground: {found.model.name}, seed {found.seed}; `include` it in a scene.")
    return [*report(found, records, step, motions), f"see {folder / 'supports.yaml'}"]
