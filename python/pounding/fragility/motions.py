"""The accelerograms of a study as the program understands them, and how far they depend on each other."""

import hashlib
from pathlib import Path

import numpy as np

from pounding import UserError
from pounding.commands import called
from pounding.study import alone_in, run_side_by_side
from pounding.tables import write_rows
from pounding.files import write_text, written_beside
from pounding.fragility import correlations
from pounding.motion_kinds import Motion
from pounding.motion_rules import is_accepted, judge, limits_text, place_text, read_rules, source_of, table_of
from pounding.motion_signals import MotionError, Signal
from pounding.results import load
from pounding.runs import Job, clear, environment
from pounding.scenes import write_scene

from . import coherence, matching
from .study import Axis, Study

STEP = 0.005  # of the accelerograms that are compared [s]
# A mass that the ground shakes: the cheapest scene that reads a motion and writes it down.
POINT = 'Point(1) = {0, 0, 0};\nPhysical Point("mass") = {1};\n'
SCENE = {"structures": "one", "contacts": "none", "time_step": STEP, "output_interval": STEP, "modes": 0,
         "spectra_frequencies": 1,
         "one": {"mesh": "point.geo", "allow_loose": True, "mass": {"element": "point_mass", "mass": 1}}}
SHOWN = 6  # motions made between two lines of progress
AT_ONCE = 12  # synthetic motions made before the next look


def options_of(axis: Axis, motion: int | str, seed: bool) -> dict:
    """Options of the motion along one axis, at a peak of 1 m/s2."""
    if seed:
        return {"target": axis.target, "seed": motion, "pga": 1, **axis.understood}
    return {"record": motion, "pga": 1, **axis.understood}


def _duration(axis: Axis) -> float:
    return float(axis.understood["duration"]) if axis.target else 0.0


class Motions:
    """Accelerograms (samples), made by the program when they are first asked for and kept in a folder. `study`: has the axes;
    `command`: tells of progress, none if empty."""

    def __init__(self, study, folder: Path, jobs: int, command: str = "fragility"):
        self.study, self.folder, self.jobs, self.command = study, folder, jobs, command
        self.variables = environment()

    def name(self, axis: str, motion) -> str:
        one = self.study.axes[axis]
        content = Path(motion if one.records else one.target).read_bytes()
        told = str(sorted(options_of(one, motion, not one.records).items())).encode()
        return f"{axis}-{hashlib.sha256(told + content).hexdigest()[:16]}"

    def make(self, wanted: list, of: str = "") -> None:
        """Runs what is not there; `wanted`: pairs of an axis and a motion. Throws UserError."""
        todo = [pair for pair in wanted if not (self.folder / f"{self.name(*pair)}.npy").is_file()]
        if not todo:
            return
        self.folder.mkdir(parents=True, exist_ok=True)
        write_text(self.folder / "point.geo", POINT)
        failures = []

        def start(pair: tuple) -> Job:
            axis, motion = pair
            one = self.study.axes[axis]
            place = self.folder / self.name(axis, motion)
            scene = {**SCENE, "end_time": _duration(one) or 400.0,
                     "motion": {"x": options_of(one, motion, not one.records)}}
            path = write_scene(self.folder / f"{place.name}.yaml", scene)
            return Job(["-options_file", str(path.absolute())], place.absolute(), 1, Path.cwd(), self.variables)

        def ended(pair: tuple, job: Job, waiting: list, _running: list) -> None:
            failure = job.outcome()
            if self.command and (len(todo) - len(waiting)) % SHOWN == 0:
                print(f"{self.command}: {len(todo) - len(waiting)} of {len(todo)} motions made{of}", flush=True)
            if failure:
                failures.append(f"motion {pair[1]} along {pair[0]}: {failure}")
                return
            values = load(job.output).history["ground_acceleration"][:, 0]
            with written_beside(self.folder / f"{job.output.name}.npy") as draft:
                np.save(draft, np.trim_zeros(values, "b"))
            clear(job.output)
            (self.folder / f"{job.output.name}.yaml").unlink()

        run_side_by_side(todo, self.jobs, start, ended)
        if failures:
            raise UserError(failures[0])

    def signal(self, axis: str, motion) -> np.ndarray:
        """Throws UserError where the kept one is damaged."""
        path = self.folder / f"{self.name(axis, motion)}.npy"
        try:
            found = np.load(path, allow_pickle=False)
        except (OSError, ValueError, EOFError) as error:
            raise UserError(f"{path} cannot be read ({' '.join(str(error).split())}); remove it") from error
        if found.ndim != 1 or found.dtype.kind != "f":
            raise UserError(f"{path} holds no motion; remove it")
        return found

    def record(self, axis: str, motion, factor: float) -> np.ndarray:
        """The accelerogram of a motion times a factor: the program's first step is half a one, so that its signal begins with
        half of the first sample. Throws UserError as signal."""
        found = factor * self.signal(axis, motion)
        found[0] *= 2
        return found


def choose_seeds(study: Study, made: Motions) -> None:
    """Gives the study's targets the first seeds whose motions along the axes are independent of each other and, where
    the study wants that, of all others; some more where they are to be matched. Throws UserError where hardly any are."""
    count = study.wanted + (int(matching.SPARE * study.wanted) + 1 if study.matching else 0)
    names = list(study.axes)
    kept, seeds, seed = [], {name: [] for name in names}, 1
    while len(seeds[names[0]]) < count:
        if seed > 100 * count:
            raise UserError(f"{study.path}: motions: of seeds up to {seed} only {len(seeds[names[0]])} are "
                            "independent; raise the correlation, take longer motions or fewer")
        batch = {name: [len(names) * k + place + seed for k in range(AT_ONCE)] for place, name in enumerate(names)}
        found = f", {len(seeds[names[0]])} of {count} that are independent found" if seed > 1 else ""
        made.make([(name, one) for name in names for one in batch[name]], found)
        for k in range(AT_ONCE):
            signals = [made.signal(name, batch[name][k]) for name in names]
            trial = correlations(kept + signals)
            np.fill_diagonal(trial, 0)
            if len(seeds[names[0]]) < count and abs(trial[len(kept):]).max() < study.correlation:
                kept += signals if study.between else []
                for name in names:
                    seeds[name].append(batch[name][k])
        seed += len(names) * AT_ONCE
    for name in names:
        one = study.axes[name]
        study.axes[name] = Axis((), one.target, tuple(seeds[name]), one.ratio, one.options)


def check(study: Study, folder: Path, jobs: int, write: bool = True, kept: Path | None = None) -> np.ndarray:
    """Chooses what is to be chosen, writes motions.csv and correlation.csv into the folder and returns the matrix of
    all axes one after the other. Throws UserError with the pair that is furthest beyond the limit: of the motions that
    act together, and where the study wants that of all. Motions of different samples never act together. `kept`: the folder
    of the motions, that of several studies with the same ones."""
    kept = kept or folder / "motions"
    made = Motions(study, kept, jobs)
    with alone_in(kept, called("run/fragility"), wait=True):  # parts of a study make them once
        if study.wanted and not any(axis.matched for axis in study.axes.values()):
            choose_seeds(study, made)
        pairs = [(name, motion) for name, axis in study.axes.items() for motion in axis.motions]
        made.make(pairs)
        if study.matching:
            matching.make(study, made, STEP, folder if write else None)
            pairs = [(name, motion) for name, axis in study.axes.items() for motion in axis.motions]
            made.make(pairs, " of the matched records read")
        if study.coherence:
            coherence.make(study, made, STEP)
    labels = [f"{name} {Path(str(motion)).name}" for name, motion in pairs]
    matrix = correlations([made.signal(*pair) for pair in pairs])
    off = abs(matrix - np.eye(len(matrix)))
    if write:
        write_rows(folder / "correlation.csv", ["motion", *labels],
                   ([label, *(f"{value:.4f}" for value in row)] for label, row in zip(labels, matrix)))
        write_rows(folder / "motions.csv", ["axis", "motion", "samples", "largest correlation", "with"],
                   ([name, motion, len(made.signal(name, motion)), f"{row.max():.4f}", labels[row.argmax()]]
                    for (name, motion), row in zip(pairs, off)))
    count = len(pairs) // len(study.axes)
    held = [(off[i, j], i, j) for i in range(len(off)) for j in range(i) if study.between or i % count == j % count]
    beyond = [one for one in held if one[0] >= study.correlation]
    if beyond:
        value, i, j = max(beyond)
        raise UserError(f"{study.path}: motions: {len(beyond)} of {len(held)} pairs are "
                        f"correlated by {study.correlation:g} or more, {labels[j]} and {labels[i]} by {value:.3f}; take "
                        "others, or raise `correlation` (all pairs in correlation.csv)")
    return matrix


def judged(study: Study, folder: Path, jobs: int, write: bool = True, kept: Path | None = None) -> list:
    """Doubts about the motions that the study's table of rules refuses, at the largest level, to which targets with `anchor`
    are anchored too; motion_rules.csv has the verdicts. None without a table. `kept`: see check. Throws UserError."""
    if study.rules is None:
        return []
    made, level = Motions(study, kept or folder / "motions", jobs), study.levels[-1]
    lists = {name: axis.motions for name, axis in study.axes.items()}
    motions = [Motion(", ".join(Path(str(lists[name][k])).name for name in lists),
                      {name: Signal(f"{name} {Path(str(lists[name][k])).name}", STEP, level * axis.ratio_of(k) * made.signal(name, lists[name][k]))
                       for name, axis in study.axes.items()}) for k in range(len(next(iter(lists.values()))))]
    try:
        verdicts = judge(read_rules(study.rules), motions, level)
    except MotionError as error:
        raise UserError(f"{study.path}: motion_rules: {error}") from error
    if write:
        write_text(folder / "motion_rules.csv", table_of(verdicts))
    source = source_of(study.rules)
    about = f"{study.rules.name}{f' ({source})' if source else ''}"
    if is_accepted(verdicts):
        return [*matching.notes(study), f"The motions are accepted by the rules of {about}, motion_rules.csv."]
    refused = [f"{one.rule.name}: {one.worst.number:.3g} for {limits_text(one.rule)}, {len(one.refused)} of {one.looked_at} refused"
               f"{', worst ' * bool(place_text(one.worst))}{place_text(one.worst)}" for one in verdicts if one.word == "refused"]
    return [*matching.notes(study), f"Doubt: motions are refused by the rules of {about}: {'; '.join(refused)} (motion_rules.csv)."]
