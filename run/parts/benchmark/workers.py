"""Programs that stay up and measure one thing at a time when they are asked."""

import json
import math
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path

from pounding import UserError
from pounding.runs import ending_with_us

SOURCE = Path(__file__).resolve().parents[3]
PROGRAMS = "pounding step_benchmark machine_limits partition_study"
COUNTING = "count_instructions" if platform.machine() == "x86_64" else ""
MOTION_STEP = 2e-3  # [s]
ELEMENT_MEMORY = 1500  # of a Stepper without a matrix while it is built [B per dof]


class MeasuringError(UserError):
    """Something cannot be measured: one line for the user."""


def build() -> Path:
    """Builds what is measured; returns the build folder."""
    if subprocess.run(["run/setup"], cwd=SOURCE, stdout=sys.stderr,
                      env={**os.environ, "POUNDING_TARGETS": f"{PROGRAMS} {COUNTING}"}).returncode != 0:
        raise MeasuringError("run/setup failed, see above")
    return SOURCE / os.environ.get("POUNDING_BUILD", "build")


def with_environment(command: list) -> list:
    """The command in the environment of the other scripts."""
    return ["bash", "-c", 'source run/environment; exec "$@"', "run"] + [str(word) for word in command]


def run_program(build: Path, ranks: int, words: list) -> str:
    """Runs the program to its end; returns what it said. Throws MeasuringError where it refuses."""
    done = subprocess.run(with_environment(["mpirun", "-n", ranks, build / "pounding", *words]), cwd=SOURCE,
                          text=True, capture_output=True, preexec_fn=ending_with_us())
    if done.returncode != 0:
        lines = (done.stdout + done.stderr).strip().splitlines()
        raise MeasuringError(next((line for line in lines if line.startswith("pounding:")), lines[-1]))
    return done.stdout


class Worker:
    """A program that answers a line of standard input with a line of JSON. What it says on standard
    error is shown only if it fails."""

    def __init__(self, command: list):
        self.name = " ".join(str(word) for word in command)
        self.said = tempfile.TemporaryFile("w+")
        self.process = subprocess.Popen(with_environment(command), cwd=SOURCE, text=True, stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=self.said, preexec_fn=ending_with_us())

    def __enter__(self):
        return self

    def __exit__(self, kind, value, trace):
        try:
            self.process.stdin.close()
        except BrokenPipeError:
            pass
        try:
            self.process.wait(timeout=60)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.process.stdout.close()
        self.said.close()

    def read(self) -> dict:
        for line in self.process.stdout:
            if line.startswith("{"):
                return json.loads(line)
        raise self.failure()

    def failure(self) -> MeasuringError:
        self.process.wait()
        self.said.seek(0)
        said = self.said.read().strip().splitlines()
        reason = said[0] if said else f"status {self.process.returncode}"
        return MeasuringError(f"{reason}; ended without an answer: {self.name}")

    def ask(self, command: str) -> dict:
        try:
            self.process.stdin.write(command + "\n")
            self.process.stdin.flush()
        except BrokenPipeError as error:
            raise self.failure() from error
        return self.read()


class Stepper(Worker):
    """Steps one model in one or more ways; `ways`: what each reported after its first steps."""

    def __init__(self, command: list):
        super().__init__(command)
        self.ways = {}
        for report in iter(self.read, {"ready": True}):
            self.ways[report["name"]] = report

    def seconds_per_step(self, way: str, lasting: float) -> float:
        return self.ask(f"{way} {lasting}")["seconds_per_step"]


def mpirun(ranks: int, program: Path, *words) -> list:
    return ["mpirun", "-n", ranks, program, *words]


def step_benchmark(folder: Path, ranks: int, motion: Path, model: list, ways: list, *words) -> list:
    """Command of a Stepper; `model`: ["-cells", "48,48,1"] or ["-storeys", 3]."""
    return mpirun(ranks, folder / "tests" / "step_benchmark", *model, "-motion", motion,
                  "-motion_step", MOTION_STEP, "-steps", ",".join(ways), *words)


def write_motion(path: Path) -> Path:
    """A harmonic ground acceleration of 1 m/s2 at 5 Hz for a minute."""
    samples = (math.cos(2 * math.pi * 5 * MOTION_STEP * n) for n in range(int(60 / MOTION_STEP) + 1))
    path.write_text("".join(f"{value!r}\n" for value in samples))
    return path


def slab_cells(dofs: int) -> tuple:
    """A square slab one element thick, clamped at x = 0, of about so many free dofs."""
    n = max(1, round((-1 + math.sqrt(1 + 4 * dofs / 6)) / 2))
    return n, n, 1


def block_cells(dofs: int) -> tuple:
    """A cube of bricks, clamped at x = 0, of about so many free dofs."""
    n = min(range(1, 400), key=lambda n: abs(3 * n * (n + 1) ** 2 - dofs))
    return n, n, n


def storey_cells(dofs: int) -> int:
    """Cells per metre of the pair of buildings with about so many free dofs."""
    return min(range(1, 100), key=lambda n: abs(storey_dofs(n) - dofs))


def storey_dofs(n: int) -> int:
    """Free dofs of the pair of tests/benchmark/storey_pair.h: slabs, and layers of columns."""
    return 18 * ((6 * n + 1) * (4 * n + 1) * (n + 1) + 4 * (2 * n - 1) * (n + 1) ** 2)


def available_memory() -> float:
    """[B]"""
    for line in Path("/proc/meminfo").read_text().splitlines():
        if line.startswith("MemAvailable:"):
            return 1024.0 * int(line.split()[1])
    raise MeasuringError("/proc/meminfo does not tell the available memory")


def usable_memory() -> float:
    """What may be taken of the available memory [B]."""
    return 0.75 * available_memory()
