"""Studies: runs of the program side by side, of which those that are finished are not repeated; one command at a time in a
folder of results, and results that are there but are not what a run writes."""

import errno
import fcntl
import os
import subprocess
import sys
import time
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

from pounding import finished
from pounding.results import UNREADABLE, ResultError
from pounding.runs import Job, ending_with_us, folder_of_programs, interrupts_held

LOCK = ".command.lock"


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
    running)` for each that ended, and `look(waiting, running)` ten times a second; `running` holds items with their jobs.
    Stops what it started if it is interrupted."""
    waiting, running = list(waiting), []
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                item = waiting.pop(0)
                with interrupts_held():
                    running.append((item, start(item)))
            if look:
                look(waiting, running)
            time.sleep(0.1)
            for item, job in [one for one in running if not one[1].running]:
                running = [one for one in running if one[1] is not job]
                ended(item, job, waiting, running)
    finally:
        for _, job in running:
            job.stop()


class FolderTaken(OSError):
    """Another command works in the folder: one line for the user."""


@contextmanager
def alone_in(folder: Path, name: str, shared: bool = False, wait: bool = False) -> Iterator[None]:
    """Makes the folder and keeps other commands out of it until the block ends; the lock ends with the process, however
    that dies. `name`: what this command is called; `shared`: beside others that share it; `wait`: for those that do
    not. Where the file system has no locks nobody is kept out. Throws FolderTaken."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / LOCK
    lock = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666)
    try:
        try:
            fcntl.flock(lock, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | (0 if wait else fcntl.LOCK_NB))
        except OSError as error:
            if error.errno in (errno.EWOULDBLOCK, errno.EAGAIN, errno.EACCES):
                other = os.read(lock, 200).decode(errors="replace").strip() or "another command"
                raise FolderTaken(f"{folder}: {other} works there; wait until it has ended, or give another "
                                  "folder") from None
        if not shared:
            os.ftruncate(lock, 0)
            os.pwrite(lock, f"{name}, process {os.getpid()} on {os.uname().nodename},".encode(), 0)
        yield
    finally:
        os.close(lock)


@contextmanager
def understood(what: Path | str) -> Iterator[None]:
    """Around what is made of results whose files could be read: values that no run writes are one line, ResultError,
    with the place in the command that they did not suit."""
    try:
        yield
    except OSError:
        raise
    except UNREADABLE as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        raise ResultError(f"{what}: holds something that no run of this version writes ({type(error).__name__}: "
                          f"{' '.join(str(error).split())}, at {Path(place.filename).name} line {place.lineno})") from error
