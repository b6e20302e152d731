"""Mats on incoherent ground in a study: each sample's records move its supports, as run/incoherent would."""

import hashlib
from dataclasses import dataclass

import numpy as np

from pounding import UserError, incoherent, mats
from pounding.coherency import CoherencyError
from pounding.files import file_name

from .study_file import Reader


@dataclass(frozen=True)
class Moved:
    """The supports of a study. `options`: of the scene, with the files of the first motion; `files`: of every motion, per
    mat, made at a level of 1 m/s2."""

    coherence: mats.Coherence
    names: tuple  # components
    files: tuple

    @property
    def options(self) -> dict:
        return mats.support_options(self.coherence, self.names, self.files[0])

    @property
    def columns(self) -> list:
        return [f"{mats.option_of(mat.name, name)}_{what}" for mat in self.coherence.mats for name in self.names
                for what in ("record", "scale")]

    def values(self, motion: int, level: str) -> tuple:
        return tuple(text for mat in self.coherence.mats for _ in self.names for text in (str(self.files[motion][mat.name]), level))


TOO = "coherent_too"


def read(reader: Reader) -> tuple:
    """The block `coherence` of a study, None where it has none, and whether its samples are run on coherent ground too.
    Throws UserError."""
    if reader.values.get("coherence") is None:
        return None, False
    one = reader.part("coherence", (*mats.KEYS, TOO))
    too = one.flag(TOO)
    one.values = {key: value for key, value in one.values.items() if key != TOO}
    return mats.read(one), too


def make(study, made, step: float) -> None:
    """Makes the supports' motions of all samples in the folder of the study's motions (`made`), where they are not there yet, and
    gives them to the study. Throws UserError."""
    found: mats.Coherence = study.coherence
    count = study.motion_count
    told = [found.told, found.model.name, [[axis, one.ratios or one.ratio] for axis, one in study.axes.items()]]  # names tell of peaks
    factors, names, files = None, None, []
    for number in range(count):
        motion = {axis: one.motions[number] for axis, one in study.axes.items()}
        key = hashlib.sha256(str([told, number, [made.name(*pair) for pair in motion.items()]]).encode()).hexdigest()[:12]
        own = {mat.name: (made.folder / f"{file_name(mat.name)}-{key}.csv").absolute() for mat in found.mats}
        files.append(own)
        if not all(path.is_file() for path in own.values()):
            signals = {axis: made.record(axis, one, study.axes[axis].ratio_of(number)) for axis, one in motion.items()}
            length = max(len(one) for one in signals.values())
            signals = {axis: np.pad(one, (0, length - len(one))) for axis, one in signals.items()}
            try:
                factors = factors or incoherent.factors_of(found.mats, found.model, incoherent.grid(0.5 / step), tuple(signals),
                                                           found.wave)
            except CoherencyError as error:
                raise UserError(f"{study.path}: coherence: {error}") from error
            motions = incoherent.base_motions(signals, step, factors, (found.seed, number))
            names = names or mats.components(motions)
            for mat, path in own.items():
                mats.write(path, motions[mat], step, names)
            print(f"fragility: mats move by motion {number + 1} of {count}", flush=True)
    if names is None:
        with open(next(iter(files[0].values())), encoding="utf-8") as file:
            names = file.readline().strip().split(",")[1:]
    study.moved = Moved(found, tuple(names), tuple(files))
