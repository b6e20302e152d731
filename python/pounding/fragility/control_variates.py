"""Means, probabilities and quantiles of a dear model from few of its runs, with many runs of cheaper ones as control variates.

Model i has the values x_i of the first m_i draws, x_0 = y being the dear one and m_0 <= m_1 <= ...:

    mean_0(y) - sum_i a_i (mean_{i-1}(x_i) - mean of the others(x_i)),  a_i = (1 - m_{i-1} / m_i) cov(x_i, y) / var(x_i)

with mean_i over the first m_i draws has no bias where the slopes come from other draws than they are used for: from a pilot's,
or for each half of the draws from the other half of those of y (S. S. Lavenberg and P. D. Welch, Management Science 27, 1981; B.
Peherstorfer, K. Willcox and M. Gunzburger, SIAM Journal on Scientific Computing 38, 2016). All values are arrays (draws, ...)."""

import itertools
from dataclasses import dataclass

import numpy as np
from scipy import stats

from . import binomial_interval


@dataclass(frozen=True)
class Estimate:
    """`value` and the ends of its interval, beyond which no draw lies where they are not numbers; `correlation` of the dear and the
    cheapest model; `gain`: variance of the dear runs alone that cost as much as all of these, over that of the value."""

    value: np.ndarray
    low: np.ndarray
    high: np.ndarray
    correlation: np.ndarray
    gain: np.ndarray


@dataclass(frozen=True)
class Draws:
    """`values` of each model, the dearest first: each begins with the draws of the one before and has others beyond; `pilot`: values of
    each of draws that are in none of these, or None where the halves of the draws are each other's; `costs` of a run of each."""

    values: list
    pilot: list | None
    costs: list

    @property
    def full(self) -> np.ndarray:
        return self.values[0]

    @property
    def before(self) -> list:
        """Numbers of draws that each control shares with the model before it."""
        return [len(values) for values in self.values[:-1]]

    @property
    def parts(self) -> list:
        """1 - m_{i-1} / m_i of each control."""
        return [1 - before / len(values) for before, values in zip(self.before, self.values[1:])]

    @property
    def correlation(self) -> np.ndarray:
        return correlation(self.full, self.values[-1][:len(self.full)])

    def slopes(self, function) -> list:
        """Draws that share slopes a_i, and these, where they are a function of the dear and cheap values of others times `parts`."""
        def of(values: list) -> list:
            return [function(values[0], cheap) * part for cheap, part in zip(values[1:], self.parts)]

        if self.pilot:
            return [(slice(None), of(self.pilot))]
        halves = slice(0, None, 2), slice(1, None, 2)
        return [(one, of([values[:len(self.full)][other] for values in self.values])) for one, other in (halves, halves[::-1])]

    @property
    def equal(self) -> float:
        """How many dear runs cost as much as all but the pilot's."""
        return sum(cost * len(values) for cost, values in zip(self.costs, self.values)) / self.costs[0]


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


def _taken(slopes: list, controls: list, before: list) -> np.ndarray:
    """The controls: share by share the slope times how far the mean of the draws shared with the model before is off that of the others."""
    return sum(len(x[:m][rows]) / m * a[i] * (x[:m][rows].mean(0) - x[m:].mean(0))
               for rows, a in slopes for i, (x, m) in enumerate(zip(controls, before)))


def _mean_slopes(slopes: list, count: int) -> list:
    """Slopes of the controls over all shares of so many draws."""
    return [sum(len(range(count)[rows]) / count * a[i] for rows, a in slopes) for i in range(len(slopes[0][1]))]


def _rest(draws: Draws, slopes: list) -> np.ndarray:
    """Variance of the dear values less the controls, of draws with the same slopes about their mean."""
    m = len(draws.full)
    parts = (draws.full[rows] - sum(a[i] * m / shared * x[:m][rows] for i, (x, shared) in enumerate(zip(draws.values[1:], draws.before)))
             for rows, a in slopes)
    return sum(((one - one.mean(0)) ** 2).sum(0) for one in parts) / (m - len(slopes))


def _others(draws: Draws, slopes: list) -> np.ndarray:
    """Variance that the draws beyond those of the dear model leave in the mean: of those that model i adds its own values, and those of the
    cheaper ones that share them."""
    a, x, before = _mean_slopes(slopes, len(draws.full)), draws.values[1:], draws.before
    found = 0.0
    for i, values in enumerate(x):
        count, added = len(values), len(values) - before[i]
        one = a[i] * values / added - sum(a[k] * x[k][:count] / before[k] for k in range(i + 1, len(x)))
        found = found + added * one.var(0, ddof=1)
    return found


def _spread(draws: Draws, slopes: list, variance: np.ndarray, alone, confidence: float) -> tuple:
    """Half of Student's interval of a controlled mean, and its gain; variance of a dear value `alone`."""
    with np.errstate(divide="ignore", invalid="ignore"):
        gain = np.where(variance > 0, alone / draws.equal / variance, 1.0)
    return stats.t.ppf(0.5 + confidence / 2, len(draws.full) - len(slopes)) * np.sqrt(variance), gain


def mean(draws: Draws, confidence: float = 0.95) -> Estimate:
    """Mean of the dear model's values."""
    return _mean(draws, confidence, 0.0)


def probability(draws: Draws, confidence: float = 0.95) -> Estimate:
    """Mean of the indicators of an event, 0 and 1; models that never differ in the draws of the dear one may do so as often as Clopper and
    Pearson's interval allows."""
    m, differ = len(draws.full), binomial_interval(0, len(draws.full), confidence)[1]
    found = _mean(draws, confidence, m * (differ / stats.t.ppf(0.5 + confidence / 2, m - len(draws.slopes(_slope)))) ** 2)
    low, value, high = (np.clip(one, 0, 1) for one in (found.low, found.value, found.high))
    return Estimate(value, low, high, found.correlation, found.gain)


def _mean(draws: Draws, confidence: float, unseen: float) -> Estimate:
    """`unseen`: variance of a draw's rest where none is seen."""
    slopes = draws.slopes(_slope)
    rest = _rest(draws, slopes)
    variance = np.where(rest > 0, rest, unseen) / len(draws.full) + _others(draws, slopes)
    half, gain = _spread(draws, slopes, variance, draws.full.var(0, ddof=1), confidence)
    value = draws.full.mean(0) - _taken(slopes, draws.values[1:], draws.before)
    return Estimate(value, value - half, value + half, draws.correlation, gain)


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
    the quantile of the draws that its model adds: it moves the order at which the dear values are taken, and more is never less
    likely than much more. Slopes are those of normal values. The interval is that of the probability, as quantiles."""
    slopes = draws.slopes(lambda full, cheap: exceeding_together(p, correlation(full, cheap)))
    above = [(x > np.quantile(x[m:], p, axis=0)).astype(float) for x, m in zip(draws.values[1:], draws.before)]
    at = np.asarray(p - _taken(slopes, above, draws.before))
    m = len(draws.full)
    value = _order(draws.full, np.clip(at, 0.5 / m, 1 - 0.5 / m))
    variance = 1 / m  # of indicators whose variance is 1; counted, it would be too small: the quantile is one of the draws
    for a, x, shared, part in zip(_mean_slopes(slopes, m), draws.values[1:], draws.before, draws.parts):
        slope, together = a / part, exceeding_together(p, correlation(draws.full, x[:m]))
        variance = variance + part / shared * (slope**2 - 2 * slope * together)
    half, gain = _spread(draws, slopes, p * (1 - p) * variance, p * (1 - p), confidence)
    return Estimate(value, _order(draws.full, at - half), _order(draws.full, at + half), correlation((draws.full > value).astype(float), above[-1][:m]), gain)


@dataclass(frozen=True)
class Plan:
    """Whole numbers of draws of each model, 0 of those that do not pay; `reached`: half of the interval of the mean over it, of the
    quantity that is known least."""

    counts: list
    reached: float


def plan(cov: np.ndarray, rho: np.ndarray, costs: list, accuracy: float, most: int, confidence: float = 0.95) -> Plan:
    """The cheapest numbers m_i at which half of the interval of every mean is at most `accuracy` of it, from coefficients of variation
    and correlations (models but the dearest, quantities): the variance is that of a draw times
    1 / m_0 - sum (1 / m_{i-1} - 1 / m_i) rho_i^2. `costs` of a run of each model, the dearest first; the first and the last are always
    among those that run, others where they pay. Where `most` draws do not suffice, all of them and the m_i of the least product of
    variance and cost."""
    cov, square = np.ravel(cov), np.clip(np.reshape(rho, (len(costs) - 1, -1)) ** 2, 0, 1 - 1e-9)
    between, best = range(1, len(costs) - 1), None
    for used in ([0, *some, len(costs) - 1] for count in range(len(costs) - 1) for some in itertools.combinations(between, count)):
        parts, prices = square[[k - 1 for k in used[1:]]], np.array(costs)[used]
        for counts in _starts(len(used) - 2, most):
            half = stats.t.ppf(0.5 + confidence / 2, max(counts[0] - 2, 1)) * cov
            known = 1 / counts[0] - parts[-1] / counts[-1] - sum((1 / a - 1 / b) * part for a, b, part in zip(counts, counts[1:], parts))
            wanted = (accuracy / np.maximum(half, 1e-300)) ** 2 - known
            total = max(float((parts[-1] / wanted).max()), counts[-1] + 2) if (wanted > 0).all() else np.inf
            whole = [*counts, int(np.ceil(min(total, most)))]
            reached, cost = float((half * np.sqrt(known + parts[-1] / whole[-1])).max()), prices @ whole
            found = (total > most, cost if total <= most else reached**2 * cost), used, whole, reached
            best = min(best or found, found, key=lambda one: one[0])
    return Plan([dict(zip(best[1], best[2])).get(k, 0) for k in range(len(costs))], best[3])


def _starts(between: int, most: int):
    """Numbers of draws of all models but the cheapest: all of the dearest, those between by steps of a twentieth."""
    grid = [6]
    while grid[-1] < most - 2:
        grid.append(max(grid[-1] + 1, int(1.05 * grid[-1])))
    for m in range(4, most - 1):
        for some in itertools.combinations([one for one in grid if m + 2 <= one <= most - 2], between):
            yield [m, *some]
