"""Runs the program for the study and keeps of each run what the tables need."""

from pathlib import Path

from pounding.study import Run, understood
from pounding.results import DIRECTIONS, ResultError, load
from pounding.runs import SOURCE, environment, finish, words_of

from .metrics import GRID
from .settings import Setting

NEEDED = ("structures", "options", "impacts", "energy", "time_step", "steps", "peak_memory")


class Case:
    """A gap configuration and a ground motion of the two-storey pair over a window of time."""

    directions = ("x",)
    folder = SOURCE  # where it runs

    def __init__(self, name: str, gaps: dict, motion: dict, window: float):
        self.name, self.gaps, self.motion, self.window = name, gaps, motion, window

    def words(self, setting: Setting, folder: Path) -> list:
        """The command line after the program's name, without the output folder; `folder` keeps what runs share."""
        model = "pair-b" if setting.shells else "pair"
        options = {"end_time": self.window, "spectra_frequencies": GRID, **self.motion, **dict(setting.changes)}
        options["motion_x_pga"] = self.motion["motion_x_pga"] * setting.pga
        for contact, values in self.gaps.items():
            options[f"{contact}_gap"] = ",".join(f"{value + setting.gap:.6g}" for value in values)
        return [word.replace("{folder}", str(folder)) for word in words_of(f"petsc-options/azalee/{model}.yaml", options)]


class SceneCase:
    """A scene of the user's, over the first seconds of it where a window is given."""

    directions = ("x", "y", "z")
    name = "scene"

    def __init__(self, scene: Path, window: float | None):
        self.scene, self.window, self.folder = scene.resolve(), window, Path.cwd()

    def words(self, setting: Setting, folder: Path) -> list:
        """As those of Case."""
        options = {"spectra_frequencies": GRID, "modes": 0, **({"end_time": self.window} if self.window else {}),
                   **dict(setting.changes)}
        return [word.replace("{folder}", str(folder)) for word in words_of(self.scene, options)]


class Outcome:
    """What one run left: its summary and the floor spectra, {probe: (frequency, values)} along x, or
    {probe.direction: ...} of a scene along all directions. Throws ResultError where it left no such thing."""

    def __init__(self, folder: Path, directions: tuple = ("x",)):
        result = load(folder)
        self.summary = result.summary
        self.axes = [DIRECTIONS.index(way) for way in directions]
        if not result.summary:
            raise ResultError(f"{folder}: no summary.json, the run did not reach its end")
        self.spectra = {}
        with understood(folder):
            for probe in result.spectrum_probes:
                for way in directions:
                    name = f"{probe}.{way}" if len(directions) > 1 else str(probe)
                    self.spectra[name] = result.spectrum(probe, way, result.spectra["damping"][0])
            told = [self.per_second(), self.set_up(), self.peak_drift(), *(self.summary[key] for key in NEEDED)]
            if None in told or self.summary["time_step"] <= 0:
                raise ValueError("no step or no cost of a step")

    @property
    def wall_time(self) -> float:
        return self.summary["wall_time"]

    def per_second(self) -> float:
        """Wall time of the steps per second of motion."""
        return self.summary["microseconds_per_step"] * 1e-6 * self.summary["steps"] / self.summary["end_time"]

    def set_up(self) -> float:
        """Wall time beside those of the steps and of the certificate."""
        told = self.summary["fidelity"]["wall_time"] if "fidelity" in self.summary else 0
        return self.wall_time - self.per_second() * self.summary["end_time"] - told

    def peak_drift(self) -> float:
        """Largest displacement of any probe, of the pair along x [m]."""
        return max((probe["peak_displacement"][axis] or 0.0 for probe in self.summary.get("probes", {}).values()
                    for axis in self.axes), default=0.0)

    def moving(self) -> list:
        """Names of the spectra whose largest value is above a thousandth of the largest of their probe, and none of
        whose values is round-off beside it."""
        largest = {}
        for name, (_, values) in self.spectra.items():
            probe = name.rpartition(".")[0]
            largest[probe] = max(largest.get(probe, 0.0), *values)
        return [name for name, (_, values) in self.spectra.items()
                if max(values) > 1e-3 * largest[name.rpartition(".")[0]]
                and min(values) > 1e-9 * largest[name.rpartition(".")[0]]]


def run(case: Case | SceneCase, setting: Setting, ranks: int, folder: Path, log) -> Outcome | None:
    """One run, or what an earlier one with the same command and files left; None if the program refuses it."""
    place = folder / case.name / setting.name
    wanted = Run(tuple(case.words(setting, folder)), place, case.folder, told=(str(ranks),))
    if wanted.is_finished():
        try:
            return Outcome(place, case.directions)
        except ResultError as error:
            log(f"  {setting.name}: once more: {error}")
    failure = finish(lambda: wanted.start(ranks, environment()))
    if not failure:
        (place / "history.h5").unlink(missing_ok=True)  # large, and not read here
        failure = wanted.sign()
    if failure:
        log(f"  {setting.name}: {failure}")
        return None
    return Outcome(place, case.directions)
