"""Runs of the program from Python."""

import ctypes
import os
import shlex
import shutil
import signal
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from pounding import UserError
from .files import open_new
from .results import Result, load, result_files
from .scenes import value_text

SOURCE = Path(__file__).resolve().parents[2]
LOG = "log.txt"
CROWD = 4  # ranks per core; more are a slip
# Where a batch system or a list of machines says what there is, the cores of this machine say nothing.
ALLOCATIONS = ("SLURM_JOB_ID", "PBS_NODEFILE", "LSB_HOSTS", "LSB_MCPU_HOSTS", "PE_HOSTFILE",
               "OMPI_MCA_orte_default_hostfile", "PRTE_MCA_prte_default_hostfile")
PATIENCE = 30  # seconds that a run has to end after SIGTERM
PR_SET_PDEATHSIG = 1
LIBC = ctypes.CDLL(None)


class RunError(UserError):
    """A run that did not come to its end: one line for the user."""


def folder_of_programs() -> Path:
    """That of the build, which POUNDING_BUILD names where it is not `build`; of an installed package its bin."""
    if "POUNDING_BUILD" in os.environ or (SOURCE / "CMakeLists.txt").exists():
        return (SOURCE / os.environ.get("POUNDING_BUILD", "build")).absolute()
    found = shutil.which("pounding")  # of a package that pip has installed
    return Path(found).parent if found and not (SOURCE.parents[1] / "bin" / "pounding").exists() else SOURCE.parents[1] / "bin"


def program(name: str = "pounding") -> Path:
    """Path of a program. Throws RunError if it is not there."""
    path = folder_of_programs() / name
    if not os.access(path, os.X_OK):
        raise RunError(f"{path}: no such program; build it with run/setup, or name its folder in POUNDING_BUILD")
    return path


def shipped(name: str) -> Path | None:
    """A file of the sources that is installed too, run/environment or a scene: that of these sources, or the one that was
    installed, or built, with the program that a package of pip finds."""
    beside = folder_of_programs().resolve().parent
    return next((file for top in (SOURCE, beside / "share" / "pounding", beside) if (file := top / name).is_file()), None)


def environment() -> dict:
    """The variables that run/environment sets."""
    file = shipped("run/environment")
    if file is None:
        return {**os.environ, "OMP_NUM_THREADS": "1"}
    text = subprocess.run(["bash", "-c", 'source "$0" && env -0', file], capture_output=True, text=True, check=True).stdout
    return dict(item.split("=", 1) for item in text.split("\0") if "=" in item)


def next_steps(scene: Path) -> str:
    """The commands that look at a new scene, to paste."""
    file = shipped("run/environment")
    line = shlex.join(["mpirun", "-n", "2", str(folder_of_programs() / "pounding"), "-options_file", str(scene), "-dry_run"])
    return "next: " + (f"source {shlex.quote(str(file))}\n      " if file else "") + line


def words_of(scene: Path | str | None, options: dict) -> list:
    """The command line after the program's name: the scene's file, then one word and one value per option."""
    words = [] if scene is None else ["-options_file", str(scene)]
    for name, value in options.items():
        words += [f"-{name}", value_text(value)]
    return words


def require_room(ranks: int, jobs: int = 1) -> None:
    """Throws RunError where `jobs` runs of so many ranks are a slip on the cores that there are."""
    cores = len(os.sched_getaffinity(0))
    if ranks * jobs > CROWD * cores and not any(name in os.environ for name in ALLOCATIONS):
        what = f"{ranks} ranks" if jobs == 1 else f"{jobs} runs of {ranks} rank{'s' if ranks > 1 else ''} at a time"
        raise RunError(f"{what} on {cores} core{'s' if cores > 1 else ''}: more than {CROWD} ranks for each core only "
                       "wait for each other; take fewer")


def command(words: list, ranks: int) -> list:
    """The command line; throws RunError where it asks for too many ranks."""
    require_room(ranks)
    return ["mpirun", "-n", str(ranks), str(program()), *map(str, words)]


def complaint(text: str) -> str:
    """The first line in which the program itself said why it gave up, or ''."""
    said = [line for line in text.replace("\r", "\n").split("\n") if line.startswith("pounding: ")]
    return said[0] if said else ""


def alone(*words) -> tuple:
    """What the program prints that is run by itself, and '' or the line why it gave up. Throws RunError where it is not built."""
    done = subprocess.run([str(program()), *map(str, words)], env=environment(), capture_output=True, text=True, check=False,
                          preexec_fn=ending_with_us())
    failed = complaint(done.stderr) or f"the program ended with exit status {done.returncode}" if done.returncode else ""
    return done.stdout, failed


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Holds SIGINT, SIGTERM and SIGHUP back until the block ends, where the last of them acts: a run that starts in the
    block is known when Ctrl-C comes, and can be stopped. Outside the main thread, which alone receives signals,
    nothing is held."""
    held: list = []
    before = {}
    if threading.current_thread() is threading.main_thread():
        before = {number: handler for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
                  if (handler := signal.getsignal(number)) not in (None, signal.SIG_IGN)}
    try:
        for number in before:
            signal.signal(number, lambda got, _frame: held.append(got))
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        if held:
            signal.raise_signal(held[-1])


def ending_with_us() -> Callable[[], None]:
    """For the new process of a child: it gets SIGTERM when the thread that starts it ends, however that dies."""
    parent = os.getpid()

    def tie() -> None:
        if hasattr(LIBC, "prctl"):
            LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
        if os.getppid() != parent:
            os._exit(1)

    return tie


class Job:
    """A run that goes on now, in a session of its own: what it prints goes to `log.txt` in `output`. It ends with the
    command that started it, also where that is killed."""

    def __init__(self, words: list, output: Path, ranks: int, folder: Path, variables: dict):
        """`words`: the command line without the output folder; `folder`: where the program runs."""
        self.output, self.started = output, time.monotonic()
        output.mkdir(parents=True, exist_ok=True)
        line = command([*words, "-output", output], ranks)
        self.log = open_new(output / LOG)
        try:
            self.process = subprocess.Popen(line, cwd=folder, env=variables, stdin=subprocess.DEVNULL, stdout=self.log,
                                            stderr=subprocess.STDOUT, start_new_session=True,
                                            preexec_fn=ending_with_us())
        except OSError as error:
            self.log.close()
            raise RunError(f"{line[0]} cannot be started: {error.strerror or error}") from error

    @property
    def wall_time(self) -> float:
        return time.monotonic() - self.started

    @property
    def running(self) -> bool:
        return self.process.poll() is None

    def stop(self) -> None:
        """Ends this run and waits for it."""
        if self.running:
            os.killpg(self.process.pid, signal.SIGTERM)
            try:
                self.process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self.log.close()

    def outcome(self) -> str:
        """Waits for the end: '' if all went well, else one line."""
        self.process.wait()
        self.log.close()
        if self.process.returncode == 0:
            return ""
        said = complaint((self.output / LOG).read_text(errors="replace"))
        return said or f"exit status {self.process.returncode}, see {self.output / LOG}"


def clear(folder: Path) -> None:
    """Removes what a run left in its folder, by name, and the folder if nothing else is in it."""
    for name in (*result_files(folder), LOG, "running.lock"):
        (folder / name).unlink(missing_ok=True)
    try:
        folder.rmdir()
    except OSError:  # what a user put there stays
        pass


def finish(start: Callable[[], Job]) -> str:
    """Waits for the end of the run that `start` starts: '' if all went well, else one line. Stops the run if the wait
    is interrupted."""
    job = None
    try:
        with interrupts_held():
            job = start()
        return job.outcome()
    finally:
        if job:
            job.stop()


def run(scene: Path | str | None, output: Path | str, ranks: int = 1, folder: Path | str | None = None,
        **options) -> Result:
    """Runs a scene into the folder `output`, with more options as names and values, and reads what it left; what
    it printed is in `log.txt` there. `folder`: where the program runs and the paths of its command line begin
    (default: here). Throws RunError, or ResultError."""
    require_room(ranks)
    base = Path(folder or ".").absolute()
    place, variables = (base / output).absolute(), environment()
    failure = finish(lambda: Job(words_of(scene, options), place, ranks, base, variables))
    if failure:
        raise RunError(failure)
    return load(place)
