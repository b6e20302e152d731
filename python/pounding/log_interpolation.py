"""Curves over frequencies that are straight between logarithms."""

import numpy as np


def log_interpolated(at, frequency, values) -> np.ndarray:
    """Values at some frequencies, linear in logarithms, constant beyond the ends."""
    with np.errstate(divide="ignore"):
        logs = np.log(np.maximum(values, 1e-300))
    return np.exp(np.interp(np.log(at), np.log(frequency), logs))
