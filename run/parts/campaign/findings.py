"""The findings of the paper as measures of our own results: found or not found, with the figure.

Comparisons of spectra are of logarithms on their logarithmic grid of frequencies.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .results import Campaign, CaseResult

BRANCH = (50.0, 400.0)  # where impacts make the spectrum [Hz]
SLOW = (1.0, 50.0)
SLAB_MODE = (170.0, 230.0)  # of the antisymmetric slab mode, and its neighbours [Hz]
BELOW_MODE, ABOVE_MODE = (100.0, 160.0), (240.0, 300.0)

VANISHES = 0.5  # the branch without pounding over that with it, at most
FOLLOWS = 0.20  # root mean square of the logarithm, at most
DEPARTS = 1.25  # Dirac over complete at 400 Hz, at least
STANDS_OUT = 1.15  # a peak over its neighbours, at least
AGREES = 0.20  # Models A and B below 50 Hz, root mean square of the logarithm, at most


CRITERIA = (
    "floor 1 in a few cases only: in fewer than half",
    f"no branch without pounding: at most {VANISHES:g} of it left, geometric mean over {BRANCH[0]:g}-{BRANCH[1]:g} "
    "Hz",
    f"peaks make the branch: within {100 * FOLLOWS:.0f} % rms of the complete signal there",
    f"the Dirac departs: {DEPARTS:g} times the complete signal or more at 400 Hz; stated is from where on it stays 10 % "
    "above the highest peak",
    f"a peak near 200 Hz: the largest value of {SLAB_MODE[0]:g}-{SLAB_MODE[1]:g} Hz over the mean of its neighbours is "
    f"{STANDS_OUT:g} or more",
    f"Models A and B agree: within {100 * AGREES:.0f} % rms from {SLOW[0]:g} to {SLOW[1]:g} Hz",
)


@dataclass(frozen=True)
class Check:
    """One finding in one case, or over several."""

    finding: str
    case: str
    figure: str
    found: bool


def where(result: CaseResult) -> str:
    return f"gap {result.case.gap} cm, {result.case.motion}"


def mean_ratio(first: np.ndarray, second: np.ndarray) -> float:
    """Geometric mean of first / second."""
    return float(np.exp(np.mean(np.log(first / second))))


def rms(first: np.ndarray, second: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.log(first / second) ** 2)))


def level(result: CaseResult, spectrum: np.ndarray, band: tuple) -> float:
    """Geometric mean of a spectrum over a band [m/s2]."""
    return float(np.exp(np.mean(np.log(spectrum[result.band(*band)]))))


def second_floor_is_hit(campaign: Campaign) -> list:
    return [Check(f"floor 2 is hit, Model {model}", where(one), f"{one.count('floor2')} impacts",
                  one.count("floor2") > 0) for model in ("A", "B") for one in campaign.of(model)]


def first_floor_is_hit_seldom(campaign: Campaign) -> list:
    cases = campaign.of("A")
    hit = [one for one in cases if one.count("floor1") > 0]
    return [Check("floor 1 is hit in a few cases only", f"{len(cases)} cases of Model A",
                  f"in {len(hit)} of {len(cases)}", 2 * len(hit) < len(cases))] if cases else []


def more_impacts_as_the_gap_shrinks(campaign: Campaign) -> Iterator:
    for motion in dict.fromkeys(one.case.motion for one in campaign.of("A")):
        counts = [(one.case.gap, one.count("floor2")) for one in campaign.of("A") if one.case.motion == motion]
        counts = [count for _, count in sorted(counts, reverse=True)]
        if len(counts) > 1:
            yield Check("more impacts as the gap shrinks", motion, " < ".join(map(str, counts)),
                        all(a < b for a, b in zip(counts, counts[1:])))


def branch_vanishes_without_pounding(campaign: Campaign) -> Iterator:
    for one, apart in campaign.pairs("A", "A-apart"):
        part = one.band(*BRANCH)
        ratio = mean_ratio(apart.roof[part], one.roof[part])
        yield Check("without pounding no branch of 50-400 Hz", where(one), f"{ratio:.3f} of it is left",
                    ratio <= VANISHES)


def symmetric_gaps_raise_the_branch(campaign: Campaign) -> Iterator:
    for one, symmetric in campaign.pairs("A", "A-symmetric"):
        part = one.band(*BRANCH)
        ratio = mean_ratio(symmetric.roof[part], one.roof[part])
        yield Check("symmetric gaps raise the branch", where(one), f"{ratio:.2f} times", ratio > 1)


def peaks_make_the_branch(campaign: Campaign) -> Iterator:
    for one in campaign.of("A"):
        if not one.treated:
            continue
        part = one.band(*BRANCH)
        complete = one.treated["complete"][part]
        for treatment, words in (("all_peaks", "the branch is that of all peaks"),
                                 ("highest_peak", "the branch is that of the highest peak")):
            distance = rms(one.treated[treatment][part], complete)
            yield Check(f"{words} alone", where(one), f"{100 * distance:.0f} % rms", distance <= FOLLOWS)


def departure(one: CaseResult) -> float:
    """Frequency above which the Dirac stays 10 % and more above the highest peak [Hz]; infinite if it never does."""
    ratio = one.treated["dirac"] / one.treated["highest_peak"]
    below = np.flatnonzero(ratio < 1.1)
    if len(below) == 0:
        return float(one.frequency[0])
    return float(one.frequency[below[-1] + 1]) if below[-1] + 1 < len(ratio) else float("inf")


def dirac_departs(campaign: Campaign) -> Iterator:
    for one in campaign.of("A"):
        if one.treated:
            ratio = one.treated["dirac"][-1] / one.treated["complete"][-1]
            start = departure(one)
            yield Check("the Dirac departs upwards", where(one), f"{ratio:.1f} times at 400 Hz, from {start:.0f} Hz on",
                        ratio >= DEPARTS and start > 20)


def prominence(one: CaseResult) -> float:
    """The largest value around 200 Hz over the mean of its neighbours, first floor of Structure 1. The
    mode is excited by impacts on the second floor."""
    spectrum = one.spectra["s1_floor1.x"]
    neighbours = np.sqrt(level(one, spectrum, BELOW_MODE) * level(one, spectrum, ABOVE_MODE))
    return float(spectrum[one.band(*SLAB_MODE)].max() / neighbours)


def slab_mode_near_200_hz(campaign: Campaign) -> Iterator:
    for model, words, expected in (("A", "a peak", True), ("B", "no peak", False)):
        for one in campaign.of(model):
            if one.count("floor1") == 0 < one.count("floor2"):
                height = prominence(one)
                yield Check(f"unhit floor 1, Model {model}: {words} near 200 Hz", where(one), f"{height:.2f} times",
                            (height >= STANDS_OUT) == expected)


def models_agree(campaign: Campaign) -> Iterator:
    for one, other in campaign.pairs("A", "B"):
        slow, fast = (rms(other.roof[one.band(*band)], one.roof[one.band(*band)]) for band in (SLOW, BRANCH))
        yield Check("Models A and B agree", where(one),
                    f"{100 * slow:.0f} % rms below 50 Hz, {100 * fast:.0f} % above", slow <= AGREES)


def cost_of_the_models(campaign: Campaign) -> list:
    seconds = {variant: [one.summary["wall_time"] / one.summary["end_time"] for one in campaign.of(variant)]
               for variant in ("A", "B")}
    if not all(seconds.values()):
        return []
    ratio = float(np.median(seconds["A"]) / np.median(seconds["B"]))
    return [Check("Model A costs more than Model B", "medians", f"{ratio:.2f} times (paper: 4)", ratio > 1)]


ALL = (second_floor_is_hit, first_floor_is_hit_seldom, more_impacts_as_the_gap_shrinks,
       branch_vanishes_without_pounding, symmetric_gaps_raise_the_branch, peaks_make_the_branch, dirac_departs,
       slab_mode_near_200_hz, models_agree, cost_of_the_models)


def check_all(campaign: Campaign) -> list:
    return [check for finding in ALL for check in finding(campaign)]


def totals(checks: list) -> list:
    """(finding, found, cases) in order."""
    names = dict.fromkeys(check.finding for check in checks)
    return [(name, sum(check.found for check in checks if check.finding == name),
             sum(check.finding == name for check in checks)) for name in names]
