"""Studies: runs of the program side by side, of which those that are finished are not repeated."""

import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

from parts import finished
from pounding.runs import Job, ending_with_us, folder_of_programs, interrupts_held


@dataclass(frozen=True)
class Run:
    """A run of a study. `words`: its command line without the output folder; `place`: the folder of its results;
    `folder`: where the program runs; `told`: what the results depend on beside the command line; `kept`: files that a
    study leaves beside those of the program."""

    words: tuple
    place: Path
    folder: Path
    told: tuple = ()
    kept: tuple = ()

    @property
    def request(self) -> list:
        return [*self.told, *self.words]

    def is_finished(self) -> bool:
        """Whether the place holds the results of this very run, whole, and no file that it read has changed since."""
        return finished.is_finished(self.request, self.place, self.folder)

    def start(self, ranks: int, variables: dict) -> Job:
        """A job that runs it anew; what was in its place is finished no longer."""
        finished.begin_anew(self.place)
        return Job(list(self.words), self.place.absolute(), ranks, self.folder, variables)

    def sign(self) -> str:
        """Marks what the run left as finished: '' or, where it did not leave what it should, one line."""
        return finished.sign(self.request, self.place, self.folder, self.kept)


def build(source: Path, *programs: str) -> None:
    """Builds programs of the sources that are not there, by run/setup; where that fails, what needs them says so."""
    if (source / "run" / "setup").exists() and not all((folder_of_programs() / name).exists() for name in programs):
        subprocess.run([source / "run" / "setup"], env={**os.environ, "POUNDING_TARGETS": " ".join(programs)}, check=False,
                       stdout=sys.stderr, preexec_fn=ending_with_us())


def announcement(runs: int, todo: int, jobs: int, ranks: int, what: str = "") -> str:
    """How much a study has to run, and how; `what`: of which kind the runs are."""
    return (f"{runs} runs{what}, {runs - todo} finished before, {jobs} at a time on {ranks} rank{'s' if ranks > 1 else ''} "
            "each")


def run_side_by_side(waiting: list, jobs: int, start: Callable, ended: Callable, look: Callable | None = None) -> None:
    """Starts what waits, `jobs` at a time: `start(item)` gives a pounding.runs.Job. Calls `ended(item, job, waiting,
    running)` for each that ended, and `look(waiting, running)` ten times a second; `running` holds jobs. Stops what
    it started if it is interrupted."""
    waiting, running, item_of = list(waiting), [], {}
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                item = waiting.pop(0)
                with interrupts_held():
                    job = start(item)
                    running.append(job)
                    item_of[job] = item
            if look:
                look(waiting, running)
            time.sleep(0.1)
            for job in [job for job in running if not job.running]:
                running.remove(job)
                ended(item_of[job], job, waiting, running)
    finally:
        for job in running:
            job.stop()
