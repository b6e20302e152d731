"""Runs of the members of a study: many at once by the program's ensembles, or each on its own."""

import csv
import hashlib
import json
import re
from pathlib import Path

from parts.side_by_side import run_side_by_side
from parts.sweep.members import scene_files
from pounding.results import ResultError, load
from pounding.runs import LOG, Job, environment, finish
from pounding.scenes import write_scene

from . import outcomes
from .design import Design
from .study import Study, StudyError


def scene_options(study: Study, reduced: bool, folder: Path) -> dict:
    """Options of all members in a file of their own, which includes the scene; bases are kept in the folder."""
    found = {"include": str(study.scene), **study.options}
    for axis, one in study.axes.items():
        kind = {"target": one.target} if one.target else {"record": one.records[0]}
        found |= {f"motion_{axis}_{key}": value for key, value in {**kind, **one.understood}.items()}
    if reduced:
        found |= study.reduction
        for structure in [name.removesuffix("_model") for name, value in found.items()
                          if name.endswith("_model") and value == "modal"]:
            found.setdefault(f"{structure}_modal_basis", str((folder / f"{structure}.basis").absolute()))
    else:
        found |= study.full_options
    found |= {"spectra_frequencies": ",".join(f"{f:.9g}" for f in study.frequencies),
              "spectra_damping": ",".join(f"{ratio:g}" for ratio in study.dampings)}
    return found


def named_files(texts: list, beside: list) -> list:
    """Files that words in the texts name, from here or beside the files of a scene."""
    words = {word for text in texts for word in re.findall(r"[^\s\"',:{}#;=]+\.\w+", text)}
    return sorted({str((folder / word).resolve()) for word in words for folder in beside if (folder / word).is_file()})


def key_of(study: Study, options: dict, design: Design) -> str:
    """Hash of all that the results depend on but the members' values: options, names of columns, files."""
    scenes = scene_files(study.scene)
    told = {name: value for name, value in options.items() if not name.endswith("_modal_basis")}
    texts = [path.read_text(errors="replace") for path in scenes] + [" ".join(told.values())]
    texts += sorted({value for one in design.members for value in one.values if "." in value and "/" in value})
    files = [*map(str, scenes), *named_files(texts, [Path.cwd(), *{path.parent for path in scenes}])]
    hashes = {path: hashlib.sha256(Path(path).read_bytes()).hexdigest() for path in files}
    return hashlib.sha256(json.dumps([told, sorted(hashes.items()), design.columns]).encode()).hexdigest()[:12]


def _digest(values) -> str:
    return hashlib.sha256(str(values).encode()).hexdigest()


class Runner:
    """Runs what is missing of the members, in a folder; `ranks` of each job, `jobs` at a time where each member is a
    run of its own. `kind`: ensemble, single, or auto: ensembles where the program takes the scene."""

    def __init__(self, study: Study, design: Design, folder: Path, ranks: int, jobs: int, kind: str):
        self.study, self.design, self.folder = study, design, folder
        self.ranks, self.jobs, self.kind = ranks, jobs, kind
        self.variables = environment()
        self.keys = {}
        for reduced in (True, False):
            options = scene_options(study, reduced, folder / "runs")
            self.keys[reduced] = key_of(study, options, design)
            (folder / "runs" / self.keys[reduced]).mkdir(parents=True, exist_ok=True)
            write_scene(self.scene(reduced), options)

    def scene(self, reduced: bool) -> Path:
        return self.folder / "runs" / self.keys[reduced] / "scene.yaml"

    def files(self, reduced: bool) -> list:
        return sorted((self.folder / "runs" / self.keys[reduced]).glob(f"*/{outcomes.FILE}"))

    def found(self, members: list, reduced: bool = True) -> tuple:
        """(Outcomes, indices of those that are missing)."""
        return outcomes.collect(self.files(reduced), members, self.design.columns)

    def run(self, part: tuple) -> str:
        """Runs part i of n of the members, and of the repeats at full order; returns how members were run. Throws
        StudyError."""
        share = self.design.members[part[0] - 1::part[1]]
        repeats = [self.design.members[index] for index in self.design.repeated][part[0] - 1::part[1]]
        name = f"{part[0]}-of-{part[1]}"
        kind = self.kind
        _, missing = self.found(share)
        if missing and kind != "single":
            refusal = self._ensemble(share, name)
            if refusal and kind == "auto" and "ensemble" in refusal:
                print(f"note: no ensemble, each member is a run of its own: {refusal}", flush=True)
            elif refusal:
                raise StudyError(refusal)
            _, missing = self.found(share)
        if missing:
            self._singles([share[index] for index in missing], True, name)
            kind = "single"
        _, missing = self.found(repeats, False)
        if missing:
            self._singles([repeats[index] for index in missing], False, name)
        return kind

    def _ensemble(self, share: list, name: str) -> str:
        """Goes on with ensembles of this part that were stopped, then starts one of what is missing: '' if all members
        came to their end, else the program's line."""
        base = self.folder / "runs" / self.keys[True]
        for place in sorted(base.glob(f"ensemble-{name}-*")):
            _, missing = self.found(share)
            with open(place / "members.csv", newline="") as file:
                rows = {tuple(row) for row in csv.reader(file)}
            failure = self._at_once(place) if any(share[index].values in rows for index in missing) else ""
            if failure:
                return failure
        _, missing = self.found(share)
        if not missing:
            return ""
        values = [share[index].values for index in missing]
        place = base / f"ensemble-{name}-{_digest(values)[:6]}"
        place.mkdir(parents=True, exist_ok=True)
        with open(place / "members.csv", "w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerows([self.design.columns, *values])
        return self._at_once(place)

    def _at_once(self, place: Path) -> str:
        ranks = f"{self.ranks} rank{'s' if self.ranks > 1 else ''}"
        print(f"fragility: ensemble {place.name} on {ranks}; progress in {place / LOG}", flush=True)
        words = ["-options_file", str(self.scene(True).absolute()), "-ensemble",
                 str((place / "members.csv").absolute())]
        return finish(lambda: Job(words, place.absolute(), self.ranks, Path.cwd(), self.variables))

    def _singles(self, members: list, reduced: bool, name: str) -> None:
        """Each member a run of its own; what is finished is kept and not repeated. Throws StudyError at the first that
        fails, when those beside it have ended."""
        base = self.folder / "runs" / self.keys[reduced]
        columns, failures, ended_count = self.design.columns, [], 0
        places = {one: base / "single" / _digest(one.values)[:16] for one in members}
        todo = [one for one in members if not places[one].with_suffix(".npz").is_file()]
        what = "" if reduced else " at full order"
        print(f"fragility: {len(members)} runs{what}, {len(members) - len(todo)} finished before, {self.jobs} at a "
              f"time on {self.ranks} rank{'s' if self.ranks > 1 else ''} each", flush=True)

        def start(member) -> Job:
            words = ["-options_file", str(self.scene(reduced).absolute())]
            for column, value in zip(columns, member.values):
                words += [f"-{column}", value]
            return Job(words, places[member].absolute(), self.ranks, Path.cwd(), self.variables)

        def ended(member, job: Job, waiting: list, _running: list) -> None:
            nonlocal ended_count
            failure = job.outcome()
            if not failure:
                try:
                    outcomes.save(places[member].with_suffix(".npz"), outcomes.of_run(load(job.output)))
                except (ResultError, KeyError, TypeError) as error:
                    failure = f"{job.output} cannot be read: {error}"
            if failure:
                failures.append(failure)
                waiting.clear()
                return
            for path in job.output.iterdir():
                path.unlink()
            job.output.rmdir()
            ended_count += 1
            if ended_count % max(1, len(todo) // 10) == 0:
                print(f"  {ended_count}/{len(todo)} runs{what}; the last took {job.wall_time:.1f} s", flush=True)

        # The first one makes the bases that the others find.
        for some in (todo[:1], todo[1:]):
            if not failures:
                run_side_by_side(some, self.jobs, start, ended)
        if failures:
            raise StudyError(failures[0])
        place = base / f"single-{name}"
        place.mkdir(exist_ok=True)
        previous = outcomes.read_rows(place / outcomes.FILE)[1] if (place / outcomes.FILE).is_file() else {}
        texts = list(dict.fromkeys([*previous, *(one.values for one in members)]))
        parts = [outcomes.restore(base / "single" / f"{_digest(row)[:16]}.npz") for row in texts]
        outcomes.write(place / outcomes.FILE, columns, texts, parts)
