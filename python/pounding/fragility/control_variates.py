"""Means, probabilities and quantiles of a dear model from few of its runs, with many runs of a cheap one as control variates.

The dear values y of m draws stand beside the cheap ones x of the same draws, and `more` are the cheap values of r others:

    mean(y) - a (mean(x) - mean(more)),  a = r / (r + m) cov(x, y) / var(x)

has no bias where the slope comes from other draws than it is used for: from a pilot's, or for each half of the m from the
other half (S. S. Lavenberg and P. D. Welch, Management Science 27, 1981; B. Peherstorfer, K. Willcox and M. Gunzburger, SIAM
Journal on Scientific Computing 38, 2016). All values are arrays (draws, ...)."""

from dataclasses import dataclass

import numpy as np
from scipy import stats


@dataclass(frozen=True)
class Estimate:
    """`value` and the ends of its interval, beyond which no draw lies where they are not numbers; `correlation` of both models;
    `gain`: variance of the dear runs alone that cost as much as all of these, over that of the value."""

    value: np.ndarray
    low: np.ndarray
    high: np.ndarray
    correlation: np.ndarray
    gain: np.ndarray


@dataclass(frozen=True)
class Draws:
    """Values of the dear model and of the cheap one: `full` and `cheap` of the same draws, `more` of others, `pilot` (full, cheap) of
    others again, or None where the halves of the draws are each other's. `ratio`: cost of a dear run over that of a cheap one."""

    full: np.ndarray
    cheap: np.ndarray
    more: np.ndarray
    pilot: tuple | None
    ratio: float

    def slopes(self, function) -> list:
        """Draws that share a slope, and that slope times r / (r + m): a function of the full and cheap values of others."""
        if self.pilot:
            found = [(slice(None), function(*self.pilot))]
        else:
            halves = slice(0, None, 2), slice(1, None, 2)
            found = [(one, function(self.full[other], self.cheap[other])) for one, other in (halves, halves[::-1])]
        return [(rows, slope * len(self.more) / (len(self.more) + len(self.full))) for rows, slope in found]

    @property
    def equal(self) -> float:
        """How many dear runs cost as much as all but the pilot's."""
        return len(self.full) + (len(self.cheap) + len(self.more)) / self.ratio


def correlation(full: np.ndarray, cheap: np.ndarray) -> np.ndarray:
    """Of both models over the first axis; 0 where one does not vary."""
    y, x = full - full.mean(0), cheap - cheap.mean(0)
    with np.errstate(divide="ignore", invalid="ignore"):
        found = (y * x).sum(0) / np.sqrt((y * y).sum(0) * (x * x).sum(0))
    return np.where(np.isfinite(found), found, 0.0)


def _slope(full: np.ndarray, cheap: np.ndarray) -> np.ndarray:
    """Covariance over the variance of the cheap values."""
    spread = cheap.std(0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(spread > 0, correlation(full, cheap) * full.std(0) / spread, 0.0)


def _taken(slopes: list, cheap: np.ndarray, more: np.ndarray) -> np.ndarray:
    """The control: share by share the slope times how far the mean of the cheap values of its draws is off that of the others."""
    return sum(len(cheap[rows]) / len(cheap) * a * (cheap[rows].mean(0) - more.mean(0)) for rows, a in slopes)


def _rest(slopes: list, full: np.ndarray, cheap: np.ndarray) -> np.ndarray:
    """Variance of the dear values less the controls, of draws with one slope about their mean."""
    parts = (full[rows] - a * cheap[rows] for rows, a in slopes)
    return sum(((one - one.mean(0)) ** 2).sum(0) for one in parts) / (len(full) - len(slopes))


def _spread(draws: Draws, slopes: list, cheap: np.ndarray, alone, rest: np.ndarray, confidence: float) -> tuple:
    """Half of Student's interval of a controlled mean of dear values, and its gain; `cheap`: all cheap values; variance of a dear one
    `alone`, and of the `rest` without its control."""
    m = len(draws.full)
    a = sum(len(draws.full[rows]) / m * slope for rows, slope in slopes)
    variance = rest / m + a**2 * cheap.var(0, ddof=1) / len(draws.more)
    with np.errstate(divide="ignore", invalid="ignore"):
        gain = np.where(variance > 0, alone / draws.equal / variance, 1.0)
    return stats.t.ppf(0.5 + confidence / 2, m - len(slopes)) * np.sqrt(variance), gain


def mean(draws: Draws, confidence: float = 0.95) -> Estimate:
    """Mean of the dear model's values."""
    return _mean(draws, confidence, 0.0)


def probability(draws: Draws, confidence: float = 0.95) -> Estimate:
    """Mean of the indicators of an event, 0 and 1; the interval of models that never differ is as if one draw of two more did."""
    m = len(draws.full)
    found = _mean(draws, confidence, (m + 1) / (m + 2) ** 2)
    low, value, high = (np.clip(one, 0, 1) for one in (found.low, found.value, found.high))
    return Estimate(value, low, high, found.correlation, found.gain)


def _mean(draws: Draws, confidence: float, unseen: float) -> Estimate:
    """`unseen`: variance of a draw's rest where none is seen."""
    slopes = draws.slopes(_slope)
    rest = _rest(slopes, draws.full, draws.cheap)
    half, gain = _spread(draws, slopes, np.concatenate([draws.cheap, draws.more]), draws.full.var(0, ddof=1), np.where(rest > 0, rest, unseen),
                         confidence)
    value = draws.full.mean(0) - _taken(slopes, draws.cheap, draws.more)
    return Estimate(value, value - half, value + half, correlation(draws.full, draws.cheap), gain)


def exceeding_together(p: float, rho: np.ndarray) -> np.ndarray:
    """Correlation of the indicators that two standard normals, correlated by rho, are above their quantile p: the density
    there, integrated over rho (W. F. Sheppard), over p (1 - p)."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    z, top = stats.norm.ppf(p), np.arcsin(np.clip(rho, 0, 1))
    angle = np.asarray(top)[..., None] * (nodes + 1) / 2
    return (np.exp(-z * z / (1 + np.sin(angle))) * weights).sum(-1) * top / (4 * np.pi * p * (1 - p))


def _order(values: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Quantiles p (...) of values (draws, ...), each of its own; not a number where p is not between 0 and 1."""
    ordered = np.sort(values, axis=0)
    place = np.clip(p * len(values) - 0.5, 0, len(values) - 1)
    low = np.minimum(place.astype(int), len(values) - 2)
    first, second = (np.take_along_axis(ordered, one[None], 0)[0] for one in (low, low + 1))
    return np.where((p > 0) & (p < 1), first + (place - low) * (second - first), np.nan)


def quantile(draws: Draws, p: float, confidence: float = 0.95) -> Estimate:
    """Quantile p of the dear model: where the controlled probability of more is 1 - p. The control is whether a cheap value is above
    the quantile of `more`: it moves the order at which the dear values are taken, and more is never less likely than much
    more. Slopes are those of normal values. The interval is that of the probability, as quantiles."""
    threshold = np.quantile(draws.more, p, axis=0)
    slopes = draws.slopes(lambda full, cheap: exceeding_together(p, correlation(full, cheap)))
    cheap, more = ((values > threshold).astype(float) for values in (draws.cheap, draws.more))
    at = np.asarray(p - _taken(slopes, cheap, more))
    value = _order(draws.full, np.clip(at, 0.5 / len(draws.full), 1 - 0.5 / len(draws.full)))
    together = exceeding_together(p, correlation(draws.full, draws.cheap))
    a = sum(len(cheap[rows]) / len(cheap) * slope for rows, slope in slopes)
    rest = p * (1 - p) * (1 - 2 * a * together + a * a)  # counted, it would be too small: the quantile is one of the draws
    half, gain = _spread(draws, slopes, np.concatenate([cheap, more]), p * (1 - p), rest, confidence)
    return Estimate(value, _order(draws.full, at - half), _order(draws.full, at + half), correlation((draws.full > value).astype(float), cheap), gain)


@dataclass(frozen=True)
class Plan:
    """Whole numbers of draws: `both` by both models, `cheap` in all by the cheap one; `reached`: half of the interval of the mean over
    it, of the quantity that is known least."""

    both: int
    cheap: int
    reached: float


def plan(cov: np.ndarray, rho: np.ndarray, ratio: float, accuracy: float, most: int, confidence: float = 0.95) -> Plan:
    """The cheapest numbers m and M at which half of the interval of every mean is at most `accuracy` of it, from coefficients of
    variation and correlations: the variance is that of a draw times (1 - rho^2) / m + rho^2 / M. Where `most`
    draws do not suffice, all of them and the m of the least product of variance and cost."""
    cov, square = np.ravel(cov), np.clip(np.ravel(rho) ** 2, 0, 1 - 1e-9)

    def reached(m: int, total: int) -> float:
        return float((stats.t.ppf(0.5 + confidence / 2, max(m - 2, 1)) * cov * np.sqrt((1 - square) / m + square / total)).max())

    best = None
    for m in range(4, most + 1):
        wanted = (accuracy / stats.t.ppf(0.5 + confidence / 2, m - 2) / np.maximum(cov, 1e-300)) ** 2 - (1 - square) / m
        total = max(float((square / wanted).max()), m + 2) if (wanted > 0).all() else np.inf
        if total <= most and (best is None or m + np.ceil(total) / ratio < best[0]):
            best = m + np.ceil(total) / ratio, m, int(np.ceil(total))
    if best:
        return Plan(best[1], best[2], reached(*best[1:]))
    m = min(range(4, most - 1), key=lambda m: reached(m, most) ** 2 * (m + most / ratio))
    return Plan(m, most, reached(m, most))
