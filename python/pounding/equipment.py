"""Verdicts on equipment: the capacity of every item, a test response spectrum, beside the widened spectrum of its floor.

summary.json says where the items of a run are, what they bear and by which rules they are judged; spectra.csv has the
spectra of their floors, and those inside their cabinets."""

import numpy as np

from .fragility import widened
from .log_interpolation import log_interpolated

CABINET = " cabinet"  # behind an item's name, for a probe in spectra.csv
RIGID = 33.0  # Hz: oscillators no softer feel the peak of their floor
SIXTH = 2 ** (1 / 6)  # of an octave


def counting(frequency: np.ndarray, band: list | None) -> np.ndarray:
    """Which frequencies lie in a band; all without one."""
    low, high = band or (0.0, np.inf)
    return (frequency >= low * (1 - 1e-8)) & (frequency <= high * (1 + 1e-8))  # tables have nine digits


def ratio_of(capacity: np.ndarray, required: np.ndarray) -> np.ndarray:
    return np.divide(capacity, required, out=np.full(np.shape(capacity), np.inf), where=required > 0)


def _number(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _demand(one: dict, frequency: np.ndarray, spectrum: np.ndarray) -> tuple:
    """Verdict of an item in one direction, and its table: frequencies, required, capacity, whether they count."""
    curve = [np.array(one["capacity"][key]) for key in ("frequency", "acceleration")]
    floor = widened(frequency, spectrum, one["broadening"])
    if not spectrum.any():
        floor = np.zeros_like(spectrum)
    both = counting(frequency, (curve[0][0], curve[0][-1]))
    at, required = frequency[both], floor[both]
    capacity = log_interpolated(at, *curve)
    ratio, counted = ratio_of(capacity, required), counting(at, one.get("band"))
    short = counted & (ratio < one["needed"])
    for i in np.flatnonzero(short & (ratio >= one["needed"] * (1 - one["dip"]))):
        beside = at[i] * np.array([1 / SIXTH, SIXTH])
        short[i] = (ratio_of(log_interpolated(beside, *curve), log_interpolated(beside, frequency, floor)) < one["needed"]).any()
    least = np.flatnonzero(counted)[ratio[counted].argmin()]
    high = ratio[counting(at, one["high_band"])].min(initial=np.inf)
    verdict = {"passes": not short.any(), "ratio": _number(ratio[least]),
               "frequency": float(at[least] if np.isfinite(ratio[least]) else frequency[0]), "high_band_ratio": _number(high),
               "capacity_at_zero_period": float(curve[1][-1]) if curve[0][-1] >= RIGID else None}
    return verdict, at, required, capacity, counted


def judge(summary: dict, spectrum) -> tuple:
    """Verdicts by item, and the table of required spectra and capacities by column: equipment, direction, counted,
    frequency, required, capacity. `spectrum`: frequencies and values of a probe along a direction at a damping ratio.

    An item passes in a direction where the ratio of capacity over required spectrum is what it needs at every frequency
    that counts; `dip` of that may lack where the frequencies a sixth of an octave below and above have all of it."""
    verdicts, rows = {}, []
    for name, one in summary.get("equipment", {}).items():
        ways = {}
        for way in one["directions"]:
            place = name + CABINET if "cabinet" in one else one["probe"]
            ways[way], at, *curves, counted = _demand(one, *spectrum(place, way, one["damping"]))
            # Of the floor itself: inside a cabinet no oscillator is stiff beside it.
            peaks = None if "cabinet" in one else summary.get("probes", {}).get(one["probe"], {}).get("peak_acceleration")
            ways[way]["required_at_zero_period"] = peaks["xyz".index(way)] if peaks else None
            rows += zip([name] * len(at), [way] * len(at), counted.astype(float), at, *curves)
        worst = min(ways, key=lambda way: np.inf if ways[way]["ratio"] is None else ways[way]["ratio"])
        highs = [way["high_band_ratio"] for way in ways.values() if way["high_band_ratio"] is not None]
        verdicts[name] = {**{key: value for key, value in one.items() if key != "capacity"},
                          "passes": all(way["passes"] for way in ways.values()), "ratio": ways[worst]["ratio"],
                          "frequency": ways[worst]["frequency"], "direction": worst, "directions": ways,
                          "high_band_ratio": min(highs, default=None)}
    keys = ("equipment", "direction", "counted", "frequency", "required", "capacity")
    return verdicts, {key: np.array(column) for key, column in zip(keys, zip(*rows))} if rows else {}
