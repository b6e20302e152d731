"""Runs of the members of a study: many at once by the program's ensembles, or each on its own."""

import csv
import hashlib
import itertools
import json
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np

from pounding import UserError, finished, joint
from pounding.commands import called
from pounding.study import alone_in, announcement, run_side_by_side, understood
from pounding.tables import write_rows
from pounding.files import write_text
from pounding.results import ResultError, load
from pounding.runs import LOG, Job, clear, environment, finish, words_of
from pounding.scenes import write_scene
from pounding.stability import facts_of

from . import equipment, outcomes
from .both_orders import FULL, REDUCED
from .design import Design
from .study import Study, check_names

SCOUTED = "scouted.json"


def scene_options(study: Study, order: str, folder: Path) -> dict:
    """Options of all members of an order in a file of their own, which includes the scene; bases are kept in the folder."""
    found = {"include": str(study.scene), **study.options, **(study.moved.options if study.moved else {})}
    for axis, one in study.axes.items():
        kind = {"target": one.target, "pga": study.levels[0] * one.ratio} if one.target else {"record": one.records[0]}
        found |= {f"motion_{axis}_{key}": value for key, value in {**kind, **one.understood}.items()}
    for name, one in study.joints.items():
        if one.survey:
            found[f"{name}_survey"] = one.survey
            found[f"{name}_gap"] = "geometry"  # in place of that of the scene
        if one.field:
            found |= {f"{name}_gap_deviation": str(one.field[0]), f"{name}_gap_length": str(one.field[1])}
    if study.stability:
        found |= study.stability.options
    if study.struck:
        found |= study.struck.options
    found |= study.orders[order]
    suffix = "" if order == REDUCED else f"-{order}"
    for structure in [name.removesuffix("_model") for name, value in found.items()
                      if name.endswith("_model") and value == "modal" and order != FULL]:
        found.setdefault(f"{structure}_modal_basis", str((folder / f"{structure}{suffix}.basis").absolute()))
    found |= {"spectra_frequencies": ",".join(f"{f:.9g}" for f in study.frequencies),
              "spectra_damping": ",".join(f"{ratio:g}" for ratio in study.dampings)}
    return found


def key_of(study: Study, options: dict, design: Design) -> str:
    """Hash of what the results depend on but the members' values and the files of the scene: options, names of columns,
    motions."""
    told = {name: value for name, value in options.items() if not name.endswith(finished.BASIS)}
    files = sorted({file for one in study.axes.values() for file in (*one.records, one.target) if file})
    return hashlib.sha256(json.dumps([told, [[file, finished.digest(Path(file))] for file in files],
                                      design.columns]).encode()).hexdigest()[:12]


def told(order: str) -> str:
    """The order of runs in a sentence about them; nothing of reduced ones."""
    return {REDUCED: "", FULL: " at full order"}.get(order, f" at order {order}")


def _digest(values) -> str:
    return hashlib.sha256(str(values).encode()).hexdigest()


@dataclass(frozen=True)
class Scouted:
    """What the first member, run for two steps, tells of all of them."""

    inputs: dict  # path -> hash
    probes: list
    contacts: list
    equipment: list = field(default_factory=list)  # see equipment.of_run
    doubts: list = field(default_factory=list)  # that spectra go beyond modes or mesh
    heights: list = field(default_factory=list)  # elevations of the pairs of contacts [m]
    mats: dict = field(default_factory=dict)  # see pounding.stability.facts_of, of a study that asks for their stability


class Runner:
    """Runs what is missing of the members, in a folder; `ranks` of each job, `jobs` at a time where each member is a
    run of its own. `kind`: ensemble, single, or auto: ensembles where the program takes the scene. Results of scenes
    whose files have changed since stay where they are, and are not these. Throws UserError."""

    def __init__(self, study: Study, design: Design, folder: Path, ranks: int, jobs: int, kind: str,
                 only_look: bool = False):
        """`only_look`: what nothing has been run of yet is refused."""
        self.study, self.design, self.folder = study, design, folder
        self.ranks, self.jobs, self.kind = ranks, jobs, kind
        self.variables = environment()
        self.bases, self.scouted = {}, {}
        for order in study.orders if design.repeated or study.both else (REDUCED,):
            options = scene_options(study, order, folder / "runs")
            with alone_in(folder / "runs", called("run/fragility"), wait=True):  # parts of a study look once
                self._find_base(order, options, key_of(study, options, design), only_look)
        check_names(study, self.scouted[REDUCED].probes, self.scouted[REDUCED].contacts)
        self._check_elevations(self.scouted[REDUCED].heights)
        self.mats = study.stability.resolve(self.scouted[REDUCED].mats, self.scouted[REDUCED].contacts) if study.stability else []

    def _check_elevations(self, heights: list) -> None:
        if heights and self.study.elevations:
            try:
                joint.split(self.study.elevations, np.array([(0, 0, z) for z in heights]))
            except joint.JointError as error:
                raise UserError(f"{self.study.path}: {error}") from error

    def _find_base(self, order: str, options: dict, key: str, only_look: bool) -> None:
        """The folder of the members whose scene's files are those of today; a new one where there is none."""
        for number in itertools.count(1):
            base = self.folder / "runs" / (key if number == 1 else f"{key}-{number}")
            self.bases[order] = base
            if not (base / SCOUTED).exists() and not any(base.glob(f"*/{outcomes.FILE}")) \
                    and not (base / "single").exists():
                break
            if not (base / SCOUTED).exists():  # of whatever files these runs are
                continue
            try:
                found = Scouted(**json.loads((base / SCOUTED).read_text(encoding="utf-8")))
            except (OSError, ValueError, TypeError) as error:
                raise UserError(f"{base / SCOUTED} cannot be read ({error}); remove the folder, whose runs are then "
                                "repeated") from error
            if finished.are_current(found.inputs, Path.cwd()):
                self.scouted[order] = found
                return
        if only_look:
            raise UserError(f"{self.folder}: of this study and its files as they are now nothing is there yet; run what "
                            "is missing")
        base.mkdir(parents=True, exist_ok=True)
        write_scene(self.scene(order), options)
        self.scouted[order] = self._scout(order, base)
        write_text(base / SCOUTED, json.dumps(asdict(self.scouted[order]), indent=1))

    def _scout(self, order: str, base: Path) -> Scouted:
        """Two steps of the first member: what the program refuses, it refuses here."""
        place = base / "scout"
        words = [*self.words(self.design.members[0], order), "-end_time", "1e-4", "-modes", "0"]
        failure = finish(lambda: Job(words, place.absolute(), 1, Path.cwd(), self.variables))
        if failure:
            raise UserError(f"{self.study.path}: {failure}")
        found = load(place)
        summary, items = found.summary, equipment.of_run(found)
        heights = np.unique(found.table("joint_pairs")["z"]).tolist()
        mats = facts_of(found) if self.study.stability else {}
        clear(place)
        own = str(self.scene(order).absolute())
        inputs = {path: found for path, found in finished.inputs_of(summary).items() if path != own}
        doubts = [line for line in summary["warnings"] if "its modes end at" in line or "its mesh carries waves" in line
                  or "spreads the force evenly" in line]
        return Scouted(inputs, list(summary.get("probes", {})), list(summary.get("contacts", {})), items, doubts, heights, mats)

    def words(self, member, order: str) -> list:
        """Options of the run of a member."""
        return words_of(self.scene(order).absolute(), dict(zip(self.design.columns, member.values)))

    @property
    def equipment(self) -> list:
        return equipment.items(self.scouted[REDUCED].equipment)

    def scene(self, order: str) -> Path:
        return self.bases[order] / "scene.yaml"

    def files(self, order: str) -> list:
        return sorted(self.bases[order].glob(f"*/{outcomes.FILE}"))

    def found(self, members: list, order: str = REDUCED) -> tuple:
        """(Outcomes, indices of those that are missing)."""
        return outcomes.collect(self.files(order), members, self.design.columns)

    def complete(self, members: list, order: str = REDUCED, what: str = "members") -> outcomes.Outcomes:
        """Outcomes of all of these members. Throws UserError where one is missing."""
        found, missing = self.found(members, order)
        if missing:
            raise UserError(f"{len(missing)} of {len(members)} {what}{told(order)} are not there yet; run what is missing")
        return found

    def history(self, member) -> Path:
        """Folder of a run of a member of its own with all that it records, at the time step that the members had; kept where it
        is there already. Throws UserError."""
        base = self.bases[REDUCED]
        place = base / f"history-{_digest(member.values)[:16]}"
        if not (place / "summary.json").exists():
            steps = sorted({step for path in self.files(REDUCED) for step in outcomes.time_steps(path)})
            words = [*self.words(member, REDUCED), "-modes", "0", *(["-time_step", steps[0]] if len(steps) == 1 else [])]
            print(f"fragility: history of a member in {place}", flush=True)
            failure = finish(lambda: Job(words, place.absolute(), self.ranks, Path.cwd(), self.variables))
            if failure:
                raise UserError(failure)
        return place

    def run(self, part: tuple, members: dict) -> str:
        """Runs part i of n of members, of each order, by its name; returns how the first of them were run. Throws UserError."""
        name = f"{part[0]}-of-{part[1]}"
        return [self._some(some[part[0] - 1::part[1]], order, name) for order, some in members.items()][0]

    def _some(self, share: list, order: str, name: str) -> str:
        """Runs what is missing of members of one order; returns how. Throws UserError."""
        kind, missing = self.kind, self.found(share, order)[1] if share else []
        if missing and kind != "single":
            refusal = self._ensemble(share, order, name)
            if refusal and (kind == "auto" and "ensemble" in refusal or order != REDUCED):
                print(f"note: no ensemble, each member is a run of its own: {refusal}", flush=True)
            elif refusal:
                raise UserError(refusal)
            _, missing = self.found(share, order)
        if missing:
            self._singles([share[index] for index in missing], order, name)
            kind = "single"
        return kind

    def _ensemble(self, share: list, order: str, name: str) -> str:
        """Goes on with ensembles of this part that were stopped, then starts one of what is missing: '' if all members
        came to their end, else the program's line."""
        base = self.bases[order]
        for place in sorted(base.glob(f"ensemble-{name}-*")):
            _, missing = self.found(share, order)
            try:
                with open(place / "members.csv", newline="", encoding="utf-8") as file:
                    rows = {tuple(row) for row in csv.reader(file)}
            except (OSError, ValueError, csv.Error):  # stopped before its table was there, or damaged
                rows = set()
            failure = self._at_once(place, order) if any(share[index].values in rows for index in missing) else ""
            if failure:
                return failure
        _, missing = self.found(share, order)
        if not missing:
            return ""
        values = [share[index].values for index in missing]
        place = base / f"ensemble-{name}-{_digest(values)[:6]}"
        place.mkdir(parents=True, exist_ok=True)
        write_rows(place / "members.csv", self.design.columns, values, exact=True)
        return self._at_once(place, order)

    def _at_once(self, place: Path, order: str) -> str:
        ranks = f"{self.ranks} rank{'s' if self.ranks > 1 else ''}"
        print(f"fragility: ensemble {place.name}{told(order)} on {ranks}; progress in {place / LOG}", flush=True)
        words = ["-options_file", str(self.scene(order).absolute()), "-equipment", "none", *([] if self.study.stability else ["-forces", "none"]),
                 "-ensemble", str((place / "members.csv").absolute())]
        return finish(lambda: Job(words, place.absolute(), self.ranks, Path.cwd(), self.variables))

    def _singles(self, members: list, order: str, name: str) -> None:
        """Each member a run of its own; what is finished is kept and not repeated. Throws UserError at the first that
        fails, when those beside it have ended."""
        base = self.bases[order]
        columns, failures, ended_count = self.design.columns, [], 0
        places = {one: base / "single" / _digest(one.values)[:16] for one in members}
        todo = [one for one in members if outcomes.restore(places[one].with_suffix(".npz")) is None]
        what = told(order)
        print(f"fragility: {announcement(len(members), len(todo), self.jobs, self.ranks, what)}", flush=True)

        def start(member) -> Job:
            return Job(self.words(member, order), places[member].absolute(), self.ranks, Path.cwd(), self.variables)

        def ended(member, job: Job, waiting: list, _running: list) -> None:
            nonlocal ended_count
            failure = job.outcome()
            if not failure:
                try:
                    with understood(job.output):
                        outcomes.save(places[member].with_suffix(".npz"), outcomes.of_run(load(job.output)))
                except ResultError as error:
                    failure = str(error)
            if failure:
                failures.append(failure)
                waiting.clear()
                return
            clear(job.output)
            ended_count += 1
            if ended_count % max(1, len(todo) // 10) == 0:
                print(f"  {ended_count}/{len(todo)} runs{what}; the last took {job.wall_time:.1f} s", flush=True)

        # The first one makes the bases that the others find.
        for some in (todo[:1], todo[1:]):
            if not failures:
                run_side_by_side(some, self.jobs, start, ended)
        if failures:
            raise UserError(failures[0])
        place = base / f"single-{name}"
        place.mkdir(exist_ok=True)
        previous = outcomes.read_rows(place / outcomes.FILE)[1] if (place / outcomes.FILE).is_file() else {}
        kept = {row: outcomes.restore(base / "single" / f"{_digest(row)[:16]}.npz")
                for row in dict.fromkeys([*previous, *(one.values for one in members)])}
        kept = {row: one for row, one in kept.items() if one is not None}
        outcomes.write(place / outcomes.FILE, columns, list(kept), list(kept.values()))
