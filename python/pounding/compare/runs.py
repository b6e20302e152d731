"""The runs that are compared: read, labelled, and asked what they have in common."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pounding import UserError
from pounding.results import DIRECTIONS, Result, load


ROUND_OFF = 1e-6  # part of the largest value below which there is no motion


@dataclass
class Runs:
    """Runs under the labels of `labels`, the first of which is what the others are compared with; `probes` and
    `dampings` that all of them have, `frequency` of their spectra [Hz]."""

    labels: list
    results: list
    probes: list
    dampings: list
    frequency: np.ndarray
    notes: list

    def spectra(self, probe: str, way: str, damping: float) -> list:
        """Pseudo-accelerations of each run [m/s2]."""
        return [result.spectrum(probe, way, damping)[1] for result in self.results]

    def round_off(self, probe: str, damping: float) -> float:
        """What is nothing beside the largest spectrum of the probe [m/s2]."""
        return ROUND_OFF * max(one.max() for way in DIRECTIONS for one in self.spectra(probe, way, damping))

    def moving(self, probe: str, damping: float) -> list:
        """Directions in which a run has more than round-off."""
        floor = self.round_off(probe, damping)
        return [way for way in DIRECTIONS if max(one.max() for one in self.spectra(probe, way, damping)) > floor]


def labels_of(folders: list) -> list:
    """Last parts of the paths, as many as tell them apart."""
    parts = [folder.resolve().parts for folder in folders]
    for depth in range(1, max(map(len, parts)) + 1):
        labels = ["/".join(one[-depth:]) for one in parts]
        if len(set(labels)) == len(labels):
            return labels
    raise UserError(f"{folders[0]}: the same folder twice")


def _read(folder: Path) -> Result:
    result = load(folder)
    if not result.summary:
        raise UserError(f"{folder}: no summary.json, the run did not reach its end")
    if not result.spectrum_probes:
        raise UserError(f"{folder}: no spectra.csv with a line; a run without probes leaves nothing to compare")
    return result


def _common(found: list) -> list:
    return [one for one in found[0] if all(one in other for other in found[1:])]


def _common_probes(labels: list, results: list, notes: list) -> list:
    found = [result.spectrum_probes for result in results]
    common = _common(found)
    lists = "; ".join(f"{label} has {', '.join(names)}" for label, names in zip(labels, found))
    if not common:
        raise UserError(f"no probe that all runs have: {lists}")
    for label, names in zip(labels, found):
        own = [name for name in names if name not in common]
        if own:
            notes.append(f"probes of {label} that are not in every run, left out: {', '.join(own)}; common are "
                         + ", ".join(common))
    return common


def _range_text(values: np.ndarray) -> str:
    return f"{len(values)} from {values[0]:g} to {values[-1]:g} Hz"


def _common_frequency(labels: list, results: list, probe: str) -> np.ndarray:
    found = [result.spectrum(probe, "x")[0] for result in results]
    for label, values in zip(labels[1:], found[1:]):
        if len(values) != len(found[0]) or not np.allclose(values, found[0], rtol=1e-6, atol=0):
            raise UserError(f"the spectra have unlike frequencies: {labels[0]} {_range_text(found[0])}, {label} "
                            f"{_range_text(values)}; give both runs the same -spectra_frequencies (a finished run: "
                            "pounding-spectra makes spectra of its history.h5)")
    return found[0]


def read(folders: list) -> Runs:
    """Reads the folders, two or more. Throws UserError or ResultError."""
    labels = labels_of(folders)
    results = [_read(folder) for folder in folders]
    notes = []
    probes = _common_probes(labels, results, notes)
    ratios = [sorted(set(result.spectra["damping"])) for result in results]
    dampings = _common(ratios)
    if not dampings:
        raise UserError("no damping ratio that all spectra have: " + "; ".join(
            f"{label} has {', '.join(f'{100 * value:g} %' for value in own)}" for label, own in zip(labels, ratios)))
    ends = [result.summary.get("end_time") for result in results]
    if len(set(ends)) > 1:
        notes.append("the runs end at different times, so that the longer ones saw more: "
                     + ", ".join(f"{label} {end:g} s" for label, end in zip(labels, ends)))
    return Runs(labels, results, probes, dampings, _common_frequency(labels, results, probes[0]), notes)
