"""Runs of one scene at the rungs of its ladder, over a window of its motion."""

import math
from dataclasses import dataclass
from pathlib import Path

from pounding.results import load

from . import ladder
from .metrics import BANDS, compare
from .runs import Outcome, SceneCase, run
from .settings import Setting
from .study import overall

ALL = "1-400"
BAND_NAMES = [ALL, *(f"{low}-{high}" for low, high in BANDS)]
FIRST_LOOK = 0.02  # seconds of full order that tell its step and what it costs
AFTER_IMPACT = 1.0  # seconds of a window that follow the strongest impact
WHOLE = 0.6  # a window longer than this part of the scene is the whole scene


class CertificateError(Exception):
    """One line for the user."""


@dataclass
class Facts:
    """Of the scene at full order; `cost`: wall time per second of motion [s/s]."""

    structures: tuple
    dofs: int  # of the largest structure
    time_step: float  # [s]
    cost: float
    options: dict  # in force
    key: str  # of the structures


@dataclass
class Climbed:
    """A rung that was run."""

    rung: ladder.Rung
    outcome: Outcome


class Climb:
    """Runs into `folder`, kept there; distances are those of the spectra of all probes that move."""

    def __init__(self, scene: Path, ranks: int, folder: Path, log):
        self.scene, self.ranks, self.folder, self.log = scene, ranks, folder, log
        self.probes, self.outcomes = None, {}

    def place(self, setting: Setting, window: float | None) -> Path:
        return self.folder / self._case(window).name / setting.name

    def _case(self, window: float | None) -> SceneCase:
        case = SceneCase(self.scene, window)
        case.name = "whole" if window is None else f"window-{window:g}"
        return case

    def run(self, setting: Setting, window: float | None, must: bool = False) -> Outcome | None:
        """Its outcome; None if the program refuses it, or CertificateError if it `must` run."""
        place = self.place(setting, window)
        if place not in self.outcomes:
            self.outcomes[place] = self._run_new(setting, window, must)
        return self.outcomes[place]

    def _run_new(self, setting: Setting, window: float | None, must: bool) -> Outcome | None:
        failures = []
        found = run(self._case(window), setting, self.ranks, self.folder, failures.append)
        if found is None:
            words = failures[-1].strip().partition(": ")[2]
            if must:
                raise CertificateError(words)
            self.log(f"  {setting.name}: {words}")
            return None
        self.log(f"  {setting.name:24} {found.per_second():8.3g} s/s  {found.summary['impacts']['episodes']} impacts")
        return found

    def facts(self) -> Facts:
        """Of a short run at full order. Throws CertificateError."""
        summary = self.run(ladder.FULL.setting, FIRST_LOOK, must=True).summary
        structures, options = summary["structures"], summary["options"]
        reduced = [name for name in structures if options.get(f"{name}_model") == "modal"]
        if reduced:
            raise CertificateError(f"{self.scene}: {reduced[0]} is reduced already ({reduced[0]}_model: modal); leave "
                                   "that out, the ladder reduces it")
        return Facts(tuple(structures), max(one["dofs"] for one in structures.values()), summary["time_step"],
                     summary["microseconds_per_step"] * 1e-6 / summary["time_step"], summary["options"],
                     summary["structures_key"])

    def compare_moving(self, outcome: Outcome) -> None:
        """Keeps which spectra of a whole run are more than round-off."""
        self.probes = outcome.moving()
        if not self.probes:
            raise CertificateError(f"{self.scene}: no spectrum of a probe to compare; has it probes, and does the "
                                   "ground move?")

    def distance(self, one: Outcome, other: Outcome) -> dict:
        """rms of the logarithm of the spectra's ratio, per band."""
        ratios = compare(one.spectra, {probe: other.spectra[probe] for probe in self.probes})
        return {band: overall(ratios, self.probes, band)[0] for band in BAND_NAMES}

    def distances(self, climbed: list) -> dict:
        """Per band the distances of all rungs from each other, as estimate.estimates takes them."""
        pairs = [[self.distance(one.outcome, other.outcome) for other in climbed] for one in climbed]
        return {band: [[pair[band] for pair in row] for row in pairs] for band in BAND_NAMES}

    def noise_floor(self, setting: Setting, window: float | None, reference: Outcome, options: dict) -> dict:
        """Disturbance -> rms per band beside the setting undisturbed."""
        found = {}
        for name, what, changes in ladder.disturbances(options):
            outcome = self.run(ladder.changed(setting, name, what, changes), window)
            if outcome is not None:
                found[what] = self.distance(outcome, reference)
        return found


def window_of(outcome: Outcome, place: Path) -> float | None:
    """Until a second after the strongest impact [s]; None where that is most of the scene, or nothing is hit."""
    impacts = load(place).impacts
    if not len(impacts.get("impulse", ())):
        return None
    strongest = impacts["start"][impacts["impulse"].argmax()]
    window = math.ceil(10 * (strongest + AFTER_IMPACT)) / 10
    return window if window < WHOLE * outcome.summary["end_time"] else None
