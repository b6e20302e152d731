"""Runs cases side by side, skips those that are finished, tells how long the rest will take."""

import os
import subprocess
import sys
import time
from pathlib import Path

from pounding import UserError
from pounding.study import Run, announcement, run_side_by_side
from pounding.runs import Job, complaint, ending_with_us, environment, program

from . import harvest
from .cases import Case

SOURCE = Path(__file__).resolve().parents[3]
# Steps of Model B cost more than those of Model A; the first finished runs correct this guess.
FIRST_GUESS = {"A": 1.0, "B": 1.5}


def run_of(case: Case, root: Path) -> Run:
    return Run(case.words, root / case.name, SOURCE, kept=(harvest.SERIES, harvest.TREATED, harvest.PEAKS))


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
        seconds += sum(max(0.0, self._mean(case.model) - job.wall_time) for case, job in running)
        seconds /= self.jobs
        return f"about {seconds / 60:.0f} min left" if seconds > 90 else f"about {seconds:.0f} s left"


CLEAR_LINE = "\r\033[K"


def say(text: str) -> None:
    print((CLEAR_LINE if sys.stdout.isatty() else "") + text, flush=True)


def show_running(running: list, left: str) -> None:
    """What runs now, on a line that is written over; for terminals only."""
    if sys.stdout.isatty():
        now = ", ".join(f"{case.name} {job.wall_time:.0f} s" for case, job in running)
        print(f"{CLEAR_LINE}  running {now}; {left}", end="", flush=True)


def prepare_bases(cases: list, variables: dict) -> None:
    """Has the modal bases made that several runs will read, before any two could write them at once."""
    for case in cases:
        if all(path.exists() for path in case.bases):
            continue
        started = time.monotonic()
        case.bases[0].parent.mkdir(parents=True, exist_ok=True)
        ranks = min(len(case.bases), len(os.sched_getaffinity(0)))
        command = ["mpirun", "-n", str(ranks), str(program()), *case.words, "-dry_run"]
        done = subprocess.run(command, cwd=SOURCE, env=variables, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, check=False, preexec_fn=ending_with_us())
        if done.returncode != 0:
            raise UserError(complaint(done.stderr) or f"modal bases of {case.name}: exit status {done.returncode}")
        say(f"  modal bases of {case.variant}: {time.monotonic() - started:.0f} s")


def run_all(cases: list, root: Path, jobs: int, ranks: int, keep_histories: bool) -> dict:
    """Case -> '' or why it failed. Finished ones are not run again; ends what it started if it is interrupted."""
    failures = {case: "" for case in cases}
    waiting = [case for case in cases
               if not (run_of(case, root).is_finished() and harvest.is_complete(case, root / case.name))]
    say(f"campaign: {announcement(len(cases), len(waiting), jobs, ranks)}; results in {root}")
    variables, clock, total = environment(), Clock(jobs), len(waiting)
    finished = []
    prepare_bases(waiting, variables)

    def ended(case: Case, job: Job, left: list, running: list) -> None:
        failures[case] = job.outcome() or close(case, root, keep_histories)
        finished.append(case)
        clock.add(case.model, job.wall_time)
        result = failures[case] or harvest.one_line(root / case.name)
        say(f"  {len(finished)}/{total}  {case.name}: {result}; {job.wall_time:.0f} s; {clock.left(left, running)}")

    run_side_by_side(waiting, jobs, lambda case: run_of(case, root).start(ranks, variables), ended,
                     lambda left, running: show_running(running, clock.left(left, running)))
    return failures


def close(case: Case, root: Path, keep_history: bool) -> str:
    """Takes the harvest of a run that ended well, and signs it as finished."""
    run = run_of(case, root)
    try:
        harvest.take(case, run.place, keep_history)
    except harvest.HarvestError as error:
        return str(error)
    except OSError as error:
        return f"{run.place}: {error}"
    return run.sign()
