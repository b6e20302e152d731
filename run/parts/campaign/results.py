"""What a finished case left, read back."""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pounding.tables import read_csv

from . import harvest
from .cases import Case

TREATMENTS = ("complete", "all_peaks", "highest_peak", "without_peaks", "dirac")
IMPACT_HEAD = ["case", "floor", "impacts", "contact [ms]: median", "longest", "impulse [N s]: sum", "largest",
               "left [%]", "bottom [%]", "at both ends"]
AT_AN_END = 0.9  # share of the impulse in one half of the face that counts as a hit of that end


@dataclass
class CaseResult:
    """`spectra`: channel -> pseudo-acceleration [m/s2] at `frequency` [Hz]; `treated`: the same by
    treatment, for S2's second floor along x; empty where nothing pounded. `run`: the case that was run,
    whose numbers are in `summary`; another one's are multiplied by the ratio of the peaks of motion."""

    case: Case
    run: Case
    summary: dict
    impacts: list
    frequency: np.ndarray
    spectra: dict
    treated: dict
    peaks: list
    series: dict

    def count(self, floor: str) -> int:
        return sum(hit["contact"] == floor for hit in self.impacts)

    def band(self, low: float, high: float) -> np.ndarray:
        return (self.frequency >= low) & (self.frequency <= high)

    @property
    def roof(self) -> np.ndarray:
        """Spectrum of the second floor of Structure 2 along x."""
        return self.spectra["s2_floor2.x"]


def load(case: Case, run: Case, root: Path) -> CaseResult:
    """`run`: the case that answers `case` (cases.run_for); `root`: folder of all cases."""
    folder, factor = root / run.name, case.pga / run.pga
    rows = [row for row in read_csv(folder / "spectra.csv") if float(row["damping"]) == 0.05]
    spectra = {}
    for row in rows:
        spectra.setdefault(f"{row['probe']}.{row['direction']}", []).append(row)
    frequency = np.array([float(row["frequency"]) for row in next(iter(spectra.values()))])
    values = {name: factor * np.array([float(row["pseudo_acceleration"]) for row in part])
              for name, part in spectra.items()}
    treated, peaks = {}, []
    if harvest.needs_treatment(case, folder):
        for row in read_csv(folder / harvest.TREATED):
            treated.setdefault(row["treatment"], []).append(float(row["pseudo_acceleration"]))
        treated = {name: np.array(part) for name, part in treated.items()}
        peaks = [{name: float(value) for name, value in row.items() if name not in ("probe", "direction", "channel")}
                 for row in read_csv(folder / harvest.PEAKS)]
    series = {name: values if name.endswith("time") else factor * values
              for name, values in np.load(folder / harvest.SERIES).items()}
    summary = json.loads((folder / "summary.json").read_text())
    impacts = harvest.impacts(folder) if case.pounds else []
    return CaseResult(case, run, summary, impacts, frequency, values, treated, peaks, series)


class Campaign:
    """The results by gap, motion and variant; absent ones are None."""

    def __init__(self, results: list):
        self._results = {(one.case.gap, one.case.motion, one.case.variant): one for one in results}

    def get(self, gap: int, motion: str, variant: str):
        return self._results.get((gap, motion, variant))

    def of(self, variant: str) -> list:
        return [one for one in self._results.values() if one.case.variant == variant]

    def pairs(self, first: str, second: str) -> list:
        """The results of two variants of the same gap and motion, where both are there."""
        both = [(one, self.get(one.case.gap, one.case.motion, second)) for one in self.of(first)]
        return [pair for pair in both if pair[1]]

    def all(self) -> list:
        return list(self._results.values())


def floor_row(result: CaseResult, floor: str) -> list:
    """left, bottom: share of the impulse below the middle of the face, along y and along z; at both
    ends: impacts shared by both halves along y."""
    hits = [hit for hit in result.impacts if hit["contact"] == floor]
    label = [f"gap {result.case.gap} cm, {result.case.motion}, {result.case.variant}", floor, len(hits)]
    if not hits:
        return label + [None] * 7
    column = {name: np.array([hit[name] for hit in hits]) for name in ("contact_time", "impulse", "left", "bottom")}
    impulse = column["impulse"]
    share = {name: 100 * float((column[name] * impulse).sum() / impulse.sum()) for name in ("left", "bottom")}
    both = int(((column["left"] > 1 - AT_AN_END) & (column["left"] < AT_AN_END)).sum())
    time = 1e3 * column["contact_time"]
    return label + [float(np.median(time)), float(time.max()), float(impulse.sum()), float(impulse.max()),
                    round(share["left"], 1), round(share["bottom"], 1), both]


def impact_rows(results: list) -> list:
    return [floor_row(result, floor) for result in results if result.case.pounds for floor in ("floor1", "floor2")]
