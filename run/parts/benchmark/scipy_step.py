#!/usr/bin/python3
"""The step with SciPy's CSR product, on the matrix of a folder: answers as step_benchmark does."""

import json
import sys
import time
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
from petsc_binary import read_matrix, read_vector  # noqa: E402


class Step:
    """From rest; one product K (u + beta v) per step."""

    def __init__(self, folder: Path):
        self.model = json.loads((folder / "model.json").read_text())
        self.stiffness = read_matrix(folder / "stiffness.petsc")
        self.inverse_mass = 1 / read_vector(folder / "mass.petsc")
        self.motion = np.loadtxt(self.model["motion"])
        self.displacement = np.zeros(len(self.inverse_mass))
        self.velocity = np.zeros_like(self.displacement)
        self.argument = np.zeros_like(self.displacement)
        self.step = 0

    def ground_acceleration(self) -> float:
        x = self.step * self.model["time_step"] / self.model["motion_step"]
        i = int(x)
        if i + 1 >= len(self.motion):
            return 0.0
        return self.motion[i] + (x - i) * (self.motion[i + 1] - self.motion[i])

    def run(self, steps: int) -> None:
        duration, alpha, beta = (self.model[key] for key in ("time_step", "alpha", "beta"))
        u, v, w = self.displacement, self.velocity, self.argument
        for _ in range(steps):
            acting = duration if self.step > 0 else duration / 2
            if self.step > 0:
                np.multiply(v, duration, out=w)
                u += w
            np.multiply(v, beta, out=w)
            w += u
            q = self.stiffness @ w
            q *= self.inverse_mass
            q *= acting
            v *= 1 - acting * alpha
            v -= q
            v -= acting * self.ground_acceleration()
            self.step += 1


def say(report: dict) -> None:
    print(json.dumps(report), flush=True)


def main() -> None:
    step = Step(Path(sys.argv[1]))
    first = step.model["first_steps"]
    start = time.perf_counter()
    step.run(first)
    once = (time.perf_counter() - start) / first
    say({"name": "scipy", "dofs": len(step.velocity), "ranks": 1,
         "displacement_square": float(step.displacement @ step.displacement)})
    say({"ready": True})
    for line in sys.stdin:
        steps = max(1, int(float(line.split()[1]) / once))
        start = time.perf_counter()
        step.run(steps)
        once = (time.perf_counter() - start) / steps
        say({"name": "scipy", "steps": steps, "seconds_per_step": once})


if __name__ == "__main__":
    main()
