"""Runs cases side by side, skips those that are finished, tells how long the rest will take."""

import os
import subprocess
import sys
import time
from pathlib import Path

from parts import finished
from parts.side_by_side import run_side_by_side
from pounding.runs import Job, complaint, ending_with_us, environment

from . import harvest
from .cases import Case

SOURCE = Path(__file__).resolve().parents[3]
# Steps of Model B cost more than those of Model A; the first finished runs correct this guess.
FIRST_GUESS = {"A": 1.0, "B": 1.5}


class SetUpError(Exception):
    """One line for the user."""


def is_finished(case: Case, place: Path) -> bool:
    """Whether the place holds the complete results of this very case, and every file that it read is still what it
    was."""
    return finished.is_finished(case.words, place, SOURCE) and harvest.is_complete(case, place)


def build_folder() -> Path:
    return SOURCE / os.environ.get("POUNDING_BUILD", "build")


class CaseJob(Job):
    """A case that runs now."""

    def __init__(self, case: Case, folder: Path, ranks: int, variables: dict):
        self.case, self.folder = case, folder
        finished.begin_anew(folder)
        super().__init__(case.words, folder, ranks, SOURCE, variables)


class Clock:
    """How long what is left will take, from what the finished runs took."""

    def __init__(self, jobs: int):
        self.jobs = jobs
        self.seconds = {"A": [], "B": []}

    def add(self, model: str, seconds: float) -> None:
        self.seconds[model].append(seconds)

    def _mean(self, model: str) -> float:
        own = self.seconds[model]
        other = "B" if model == "A" else "A"
        if own:
            return sum(own) / len(own)
        mean = sum(self.seconds[other]) / len(self.seconds[other])
        return mean * FIRST_GUESS[model] / FIRST_GUESS[other]

    def left(self, waiting: list, running: list) -> str:
        if not waiting and not running:
            return "the last one"
        if not any(self.seconds.values()):
            return "time left not known yet"
        seconds = sum(self._mean(case.model) for case in waiting)
        seconds += sum(max(0.0, self._mean(job.case.model) - job.wall_time) for job in running)
        seconds /= self.jobs
        return f"about {seconds / 60:.0f} min left" if seconds > 90 else f"about {seconds:.0f} s left"


CLEAR_LINE = "\r\033[K"


def say(text: str) -> None:
    print((CLEAR_LINE if sys.stdout.isatty() else "") + text, flush=True)


def show_running(running: list, left: str) -> None:
    """What runs now, on a line that is written over; for terminals only."""
    if sys.stdout.isatty():
        now = ", ".join(f"{job.case.name} {job.wall_time:.0f} s" for job in running)
        print(f"{CLEAR_LINE}  running {now}; {left}", end="", flush=True)


def prepare_bases(cases: list, variables: dict) -> None:
    """Has the modal bases made that several runs will read, before any two could write them at once."""
    for case in cases:
        if all(path.exists() for path in case.bases):
            continue
        started = time.monotonic()
        case.bases[0].parent.mkdir(parents=True, exist_ok=True)
        ranks = min(len(case.bases), len(os.sched_getaffinity(0)))
        command = ["mpirun", "-n", str(ranks), str(build_folder() / "pounding"), *case.words, "-dry_run"]
        done = subprocess.run(command, cwd=SOURCE, env=variables, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, check=False, preexec_fn=ending_with_us())
        if done.returncode != 0:
            raise SetUpError(complaint(done.stderr) or f"modal bases of {case.name}: exit status {done.returncode}")
        say(f"  modal bases of {case.variant}: {time.monotonic() - started:.0f} s")


def run_all(cases: list, root: Path, jobs: int, ranks: int, keep_histories: bool) -> dict:
    """Case -> '' or why it failed. Finished ones are not run again; ends what it started if it is
    interrupted."""
    failures = {case: "" for case in cases}
    waiting = [case for case in cases if not is_finished(case, root / case.name)]
    say(f"campaign: {len(cases)} runs, {len(cases) - len(waiting)} finished before, {jobs} at a time on "
        f"{ranks} rank{'s' if ranks > 1 else ''} each; results in {root}")
    variables, clock, total = environment(), Clock(jobs), len(waiting)
    finished = []
    prepare_bases(waiting, variables)

    def start(case: Case) -> CaseJob:
        return CaseJob(case, root / case.name, ranks, variables)

    def ended(case: Case, job: CaseJob, left: list, running: list) -> None:
        failures[case] = job.outcome() or close(job, keep_histories)
        finished.append(case)
        clock.add(case.model, job.wall_time)
        result = failures[case] or harvest.one_line(job.folder)
        say(f"  {len(finished)}/{total}  {case.name}: {result}; {job.wall_time:.0f} s; {clock.left(left, running)}")

    run_side_by_side(waiting, jobs, start, ended, lambda left, running: show_running(running, clock.left(left, running)))
    return failures


def close(job: CaseJob, keep_history: bool) -> str:
    """Takes the harvest of a run that ended well, and signs it as finished."""
    try:
        harvest.take(job.case, job.folder, keep_history)
    except harvest.HarvestError as error:
        return str(error)
    except OSError as error:
        return f"{job.folder}: {error}"
    return finished.sign(job.case.words, job.folder, SOURCE, (harvest.SERIES, harvest.TREATED, harvest.PEAKS))
