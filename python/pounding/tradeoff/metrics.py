"""How far two floor response spectra lie apart: natural logarithm of their ratio, band by band."""

import numpy as np

BANDS = ((1, 10), (10, 50), (50, 150), (150, 400))  # [Hz]
GRID = "1:400:261log"  # 100 per decade: every oscillator weighs alike on a logarithmic axis
# Largest rms and largest maximum of the ratio over 1-400 Hz.
CLASSES = (("A", 0.01, 0.05, "same result"), ("B", 0.05, 0.20, "equivalent for engineering"),
           ("C", 0.15, 0.50, "comparable"))


def _inside(frequency: np.ndarray, band: tuple) -> np.ndarray:
    low, high = band
    return (frequency >= low * (1 - 1e-9)) & (frequency <= high * (1 + 1e-9))


def _weights(frequency: np.ndarray) -> np.ndarray:
    """Of the trapezoidal rule over ln f, with a sum of 1."""
    step = np.diff(np.log(frequency))
    return np.append(step, 0) / step.sum() / 2 + np.append(0, step) / step.sum() / 2


def log_ratio(frequency, found, reference, band=(1, 400)) -> dict:
    """rms, mean and largest |ln(found / reference)| over a band, the means in d ln f; the frequency of the
    largest [Hz]. A band needs two frequencies."""
    frequency, found, reference = (np.asarray(values, dtype=float) for values in (frequency, found, reference))
    inside = _inside(frequency, band)
    ratio = np.log(found[inside] / reference[inside])
    weights = _weights(frequency[inside])
    worst = int(np.argmax(abs(ratio)))
    return {"rms": float(np.sqrt(weights @ ratio**2)), "max": float(abs(ratio[worst])),
            "at": float(frequency[inside][worst]), "bias": float(weights @ ratio)}


def class_of(rms: float, largest: float) -> str:
    """A to C as above, D beyond."""
    for name, most, peak, _ in CLASSES:
        if rms <= most and largest <= peak:
            return name
    return "D"


def compare(found: dict, reference: dict) -> dict:
    """Two runs as `runs.Outcome.spectra` gives them, {probe: (frequency, spectrum)}: per probe the figures
    of every band and of all together."""
    result = {}
    for probe, (frequency, spectrum) in reference.items():
        mine = found[probe][1]
        result[probe] = {"1-400": log_ratio(frequency, mine, spectrum)}
        for band in BANDS:
            result[probe][f"{band[0]}-{band[1]}"] = log_ratio(frequency, mine, spectrum, band)
    return result
