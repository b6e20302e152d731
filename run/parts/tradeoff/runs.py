"""Runs the program for the study and keeps of each run what the tables need."""

import csv
import json
import shutil
import subprocess
from pathlib import Path

from .metrics import GRID
from .settings import Setting

SOURCE = Path(__file__).resolve().parents[3]


class Case:
    """A gap configuration and a ground motion of the two-storey pair over a window of time."""

    def __init__(self, name: str, gaps: dict, motion: dict, window: float):
        self.name, self.gaps, self.motion, self.window = name, gaps, motion, window

    def words(self, setting: Setting, folder: Path) -> list:
        """The command line after the program's name, without the output folder; `folder` keeps what runs
        share."""
        model = "pair-b" if setting.shells else "pair"
        options = {"end_time": self.window, "spectra_frequencies": GRID, **self.motion, **dict(setting.changes)}
        options["motion_x_pga"] = self.motion["motion_x_pga"] * setting.pga
        for contact, values in self.gaps.items():
            options[f"{contact}_gap"] = ",".join(f"{value + setting.gap:.6g}" for value in values)
        words = ["-options_file", f"petsc-options/azalee/{model}.yaml"]
        for name, value in options.items():
            words += [f"-{name}", str(value).replace("{folder}", str(folder))]
        return words


class Outcome:
    """What one run left: its summary and the floor spectra along x."""

    def __init__(self, folder: Path):
        self.summary = json.loads((folder / "summary.json").read_text())
        self.spectra = {}
        with open(folder / "spectra.csv") as file:
            rows = csv.DictReader(line for line in file if not line.startswith("#"))
            for row in rows:
                if row["direction"] == "x":
                    frequency, values = self.spectra.setdefault(row["probe"], ([], []))
                    frequency.append(float(row["frequency"]))
                    values.append(float(row["pseudo_acceleration"]))

    @property
    def wall_time(self) -> float:
        return self.summary["wall_time"]

    def per_second(self) -> float:
        """Wall time of the steps per second of motion."""
        return self.summary["microseconds_per_step"] * 1e-6 * self.summary["steps"] / self.summary["end_time"]

    def set_up(self) -> float:
        return self.wall_time - self.per_second() * self.summary["end_time"]

    def peak_drift(self) -> float:
        """Largest displacement of any floor along x [m]."""
        return max(probe["peak_displacement"][0] for probe in self.summary["probes"].values())


def run(case: Case, setting: Setting, ranks: int, folder: Path, log) -> Outcome | None:
    """One run, or what an earlier one with the same command left; None if the program refuses it."""
    place = folder / case.name / setting.name
    words = case.words(setting, folder)
    command = f"{ranks} {' '.join(words)}"
    mark = place / "command.txt"
    if not (mark.exists() and mark.read_text() == command):
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        script = 'source run/environment; exec mpirun -n "$0" "$build/pounding" "$@"'
        result = subprocess.run(["bash", "-c", script, str(ranks), *words, "-output", str(place)], cwd=SOURCE,
                                capture_output=True, text=True)
        (place / "run.txt").write_text(result.stdout + result.stderr)
        if result.returncode != 0:
            reason = [line for line in result.stderr.splitlines() if line.startswith("pounding: ")]
            log(f"  {setting.name}: {reason[0] if reason else 'failed, see ' + str(place / 'run.txt')}")
            return None
        (place / "history.h5").unlink(missing_ok=True)  # large, and not read here
        mark.write_text(command)
    return Outcome(place)
