"""A copy of the sources in which one fault at a time is put, built and tested."""

import contextlib
import hashlib
import os
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

from pounding import UserError, runs

from .patches import PROGRAMS, Mutant

MARK = ".copy-of-mutants"  # a folder that holds it may be cleared
TIMEOUT = 1500  # s of a test, as in tests/CMakeLists.txt
FOUND, PASSED = "found", "passed"


class TrialError(UserError):
    """Fault of a patch, of a build or of a test, not of the code tested."""


def last_lines(text: str, count: int = 15) -> str:
    return "\n".join(text.rstrip().splitlines()[-count:])


class Copy:
    """The sources as they are in the working tree, in a folder of their own whose build folder is `build`. What has not
    changed keeps its time, so that it is not compiled again."""

    def __init__(self, source: Path, folder: Path, jobs: int):
        self.source, self.folder, self.jobs = source, folder, jobs
        self.build_folder = folder / "build"
        self.changed: dict = {}  # bytes of the files that the present mutant changes
        if folder.exists() and any(folder.iterdir()) and not (folder / MARK).exists():
            raise TrialError(f"{folder} holds other files; remove it, or name another build by POUNDING_BUILD")
        folder.mkdir(parents=True, exist_ok=True)
        (folder / MARK).touch()
        self._take_sources()

    def _take_sources(self) -> None:
        words = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        listed = subprocess.run(words, cwd=self.source, capture_output=True, text=True)
        if listed.returncode != 0:
            raise TrialError(f"{self.source} is no clone of the repository: {last_lines(listed.stderr, 1)}")
        names = {name for name in listed.stdout.split("\0") if name and (self.source / name).is_file()}
        for name in sorted(names):
            ours, theirs = self.source / name, self.folder / name
            same = theirs.is_file() and theirs.read_bytes() == ours.read_bytes()
            if not same:
                theirs.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(ours, theirs)
            shutil.copymode(ours, theirs)
        for folder, folders, files in os.walk(self.folder):
            if Path(folder) == self.folder:
                folders[:] = [name for name in folders if name != "build"]
            for name in files:
                path = Path(folder, name)
                if path.relative_to(self.folder).as_posix() not in names and name != MARK:
                    path.unlink()

    def configure(self, options: list, alone: list) -> None:
        """`alone`: files that are compiled alone, since they change."""
        words = ["cmake", "-S", self.folder, "-B", self.build_folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
                 "-DCMAKE_CXX_FLAGS=-O1", f"-DPOUNDING_ALONE={';'.join(alone)}", *options]
        stamp, now = self.build_folder / "configured", hashlib.sha256(str(words).encode()).hexdigest()
        if stamp.exists() and stamp.read_text() == now:
            return
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode != 0:
            raise TrialError(f"cmake: {last_lines(done.stderr)}")
        stamp.write_text(now)

    def build(self, targets: list) -> None:
        """Throws TrialError where it does not compile."""
        words = ["cmake", "--build", self.build_folder, "--parallel", str(self.jobs), "--target", *targets]
        status, said, _ = self._run(words, None)
        if status != 0:
            fault = re.search(r"^.*\berror: .*$", said, re.MULTILINE)
            raise TrialError(f"does not compile: {fault.group() if fault else last_lines(said, 3)}")

    def apply(self, mutant: Mutant) -> None:
        before = {name: (self.folder / name).read_bytes() for name in mutant.files if (self.folder / name).is_file()}
        # Git would take the paths for those of the clone around the copy, and leave them all out.
        alone = {**os.environ, "GIT_CEILING_DIRECTORIES": str(self.folder.parent)}
        done = subprocess.run(["git", "apply", mutant.path], cwd=self.folder, env=alone, capture_output=True, text=True)
        if done.returncode != 0:
            raise TrialError(f"no longer applies: {last_lines(done.stderr, 1)}")
        self.changed = before

    def restore(self) -> None:
        for name, content in self.changed.items():
            (self.folder / name).write_bytes(content)
        self.changed = {}

    def environment(self) -> dict:
        text = subprocess.run(["bash", "-c", "source run/environment && env -0"], cwd=self.folder, capture_output=True,
                              text=True, check=True).stdout
        found = dict(item.split("=", 1) for item in text.split("\0") if "=" in item)
        shared = os.environ.get("POUNDING_SHARED", str(self.source.parent / "shared"))
        return {**found, "POUNDING_BUILD": str(self.build_folder), "PYTHONPATH": str(self.folder / "tests"),
                "POUNDING_SHARED": shared}

    def _run(self, words: list, environment: dict | None) -> tuple:
        """Exit status, None where the time was over; what it printed; seconds."""
        start = time.monotonic()
        with runs.interrupts_held():
            process = subprocess.Popen(list(map(str, words)), cwd=self.folder, env=environment, text=True,
                                       stdout=subprocess.PIPE, stderr=subprocess.STDOUT, errors="replace",
                                       start_new_session=True, preexec_fn=runs.ending_with_us())
        try:
            said = process.communicate(timeout=TIMEOUT if environment else None)[0]
            status = process.returncode
        except BaseException as error:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGTERM)
            said, status = process.communicate()[0], None
            if not isinstance(error, subprocess.TimeoutExpired):
                raise
        return status, said, time.monotonic() - start

    def file_of(self, test: str) -> Path:
        found = sorted((self.folder / "tests").glob(f"*/{test}.py"))
        if len(found) != 1:
            raise TrialError(f"{test}: {'no such test' if not found else 'more than one test'}")
        return found[0]

    def targets_of(self, test: str) -> list:
        program = PROGRAMS.get(test.partition(":")[0])
        return [program] if program else ["pounding", "pounding-spectra", "job_server"]

    def run(self, test: str, whole: bool = False) -> str:
        """FOUND where a test fails, PASSED where all pass; throws TrialError where none runs. `whole`: not only up to
        the first failure."""
        kind, _, choice = test.partition(":")
        environment = self.environment()
        if kind not in PROGRAMS:
            words = [self.file_of(kind), *filter(None, [choice]), *([] if whole else ["--failfast"])]
            status, said, _ = self._run(["/usr/bin/python3", "-W", "ignore", *words], environment)
            return outcome(test, status, said, r"^Ran (\d+) tests?", r"skipped=(\d+)", "FAILED (")
        words = [self.build_folder / "tests" / PROGRAMS[kind], f"--gtest_filter={choice}", "--gtest_color=no"]
        if kind == "unit" and not whole:  # of several ranks one alone would stop
            words.append("--gtest_fail_fast")
        for ranks in (2, 3) if kind == "parallel" else (1,):
            start = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
            status, said, _ = self._run([*start, *words], environment)
            found = outcome(test, status, said, r"^\[=+\] (\d+) tests? from .* ran", r"SKIPPED  \] (\d+) test",
                            "[ RUN ")
            if found == FOUND:
                return FOUND
        return PASSED


def outcome(test: str, status: int | None, said: str, count: str, skips: str, sign: str) -> str:
    """`sign`: what is printed where a test of it failed, or was at work when it ended."""
    if status is None:
        return FOUND  # it does not end
    if status != 0:
        if sign not in said:
            raise TrialError(f"{test} cannot run: {last_lines(said, 1)}")
        return FOUND
    ran, skipped = re.search(count, said, re.MULTILINE), re.search(skips, said)
    if ran is None or int(ran.group(1)) <= int(skipped.group(1) if skipped else 0):
        raise TrialError(f"{test} cannot run here: none of its tests did")
    return PASSED
