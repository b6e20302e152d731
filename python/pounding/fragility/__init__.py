"""Statistics of sets of runs: moments of spectra, intervals of probabilities, lognormal fragility curves, samples of
what is not known exactly. Formulas and sources are in docs/manual/fragility.md."""

from dataclasses import dataclass

import numpy as np
from scipy import stats
from scipy.special import log_ndtr
from scipy.stats import qmc


class FitRefused(Exception):
    """Counts to which no lognormal curve can be fitted: one line for the user."""


# Moments over the first axis, the members of a set.

@dataclass
class Moments:
    """Of positive values: `mean`, `median`, `low`, `high` (16 and 84 %), `cov` (standard deviation over mean),
    `log_deviation` (of the logarithm), `half_width` of the interval of the mean, over the mean, `largest`."""

    count: int
    mean: np.ndarray
    median: np.ndarray
    low: np.ndarray
    high: np.ndarray
    cov: np.ndarray
    log_deviation: np.ndarray
    half_width: np.ndarray
    largest: np.ndarray


def moments(values: np.ndarray, confidence: float = 0.95) -> Moments:
    """Moments of `values` (members, ...), two members or more; `half_width` is Student's t s / (sqrt(n) mean)."""
    count = len(values)
    mean, deviation = values.mean(0), values.std(0, ddof=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        cov = np.where(mean > 0, deviation / mean, 0.0)
        log_deviation = np.log(np.where(values > 0, values, np.nan)).std(0, ddof=1)
    low, median, high = np.quantile(values, (0.16, 0.5, 0.84), axis=0)
    half_width = stats.t.ppf(0.5 + confidence / 2, count - 1) * cov / np.sqrt(count)
    return Moments(count, mean, median, low, high, cov, log_deviation, half_width, values.max(0))


def of_worst(each: dict) -> tuple:
    """Mean, 84 % and largest of values of samples by condition, each of the condition in which it is largest; the condition and the
    sample of the last."""
    at = max(each, key=lambda condition: each[condition].max())
    sample = int(each[at].argmax())
    return {"mean": float(max(values.mean() for values in each.values())),
            "84 %": float(max(np.quantile(values, 0.84) for values in each.values())), "largest": float(each[at][sample])}, at, sample


def members_needed(spread, tolerance: float, confidence: float) -> np.ndarray:
    """Smallest n at which the mean is known within `tolerance` of itself: (z spread / tolerance)^2, rounded up;
    `spread`: coefficients of variation. For the mean of logarithms give their deviation, and ln(1 + tolerance)."""
    z = stats.norm.ppf(0.5 + confidence / 2)
    return np.ceil((z * np.asarray(spread) / tolerance) ** 2 - 1e-9).astype(int)


def widened(frequency: np.ndarray, spectrum: np.ndarray, part: float = 0.15) -> np.ndarray:
    """The spectrum with its peaks widened by `part` on both sides: at f the largest of what stands between
    f / (1 + part) and f / (1 - part), linear in log-log between the frequencies. `spectrum` (..., frequencies)."""
    log_f = np.log(frequency)
    with np.errstate(divide="ignore"):
        logs = np.log(np.maximum(spectrum, 1e-300))
    flat = logs.reshape(-1, len(frequency))
    result = np.empty_like(flat)
    for i, at in enumerate(log_f):
        ends = at - np.log(1 + part), at - np.log(1 - part)
        inside = (log_f >= ends[0]) & (log_f <= ends[1])
        result[:, i] = flat[:, inside].max(1)
        for end in ends:
            k = np.clip(np.searchsorted(log_f, end), 1, len(log_f) - 1)
            share = np.clip((end - log_f[k - 1]) / (log_f[k] - log_f[k - 1]), 0, 1)
            result[:, i] = np.maximum(result[:, i], (1 - share) * flat[:, k - 1] + share * flat[:, k])
    return np.exp(result).reshape(spectrum.shape)


# Parts of a scatter.

@dataclass(frozen=True)
class Scatter:
    """Deviations of a quantity y(m, j) of a motion and a joint drawn independently, shape (...): `all`; `joint`, with
    the motion held; `motion`, with the joint held. The squares of the last two make up that of the first where y is the
    sum of a part of each, and more where it is not."""

    all: np.ndarray
    joint: np.ndarray
    motion: np.ndarray


def scatter(own: np.ndarray, exchanged: np.ndarray) -> Scatter:
    """Parts of the scatter, from `own` y(m_i, j_i) and `exchanged` y(m_i, j_i+1), each (samples, ...), the last motion
    with the first joint: half the mean square of the difference of two values that share one argument is the mean
    variance over the other one (M. J. W. Jansen, Computer Physics Communications 117, 1999)."""
    def held(difference):
        return np.sqrt((difference**2).mean(0) / 2)

    # Each motion and each joint is there twice: two degrees of freedom are lost.
    return Scatter(np.concatenate([own, exchanged]).std(0, ddof=2), held(own - exchanged),
                   held(np.roll(own, -1, 0) - exchanged))


def joint_share(own: np.ndarray, exchanged: np.ndarray, confidence: float = 0.95, repeats: int = 400,
                seed: int = 1) -> tuple:
    """Part of the variance that goes where the joint is known, of all values of the last dimension together, and its
    interval by drawing samples again: (part, low, high), each (...). Not a number where nothing varies."""
    def part(some):
        one, other = own[some], exchanged[some]
        with np.errstate(invalid="ignore"):
            return ((one - other) ** 2).mean(0).sum(-1) / 2 / np.concatenate([one, other]).var(0, ddof=2).sum(-1)

    generator = np.random.default_rng(seed)
    draws = [part(generator.integers(0, len(own), len(own))) for _ in range(repeats)]
    tail = (1 - confidence) / 2
    return part(np.arange(len(own))), *np.quantile(draws, (tail, 1 - tail), axis=0)


# Probabilities from counts.

def binomial_interval(count, of, confidence: float = 0.95) -> tuple:
    """Clopper and Pearson's interval of a probability from `count` hits `of` trials: holds at least as often as it
    says."""
    count, of = np.asarray(count, float), np.asarray(of, float)
    tail = (1 - confidence) / 2
    with np.errstate(invalid="ignore"):
        low = np.where(count > 0, stats.beta.ppf(tail, count, of - count + 1), 0.0)
        high = np.where(count < of, stats.beta.ppf(1 - tail, count + 1, of - count), 1.0)
    return low, high


# Lognormal fragility: P(hit | x) = Phi(ln(x / theta) / beta).

@dataclass
class Fragility:
    """`theta`: median capacity, in the unit of x; `beta`: deviation of its logarithm; intervals of both at
    `confidence`."""

    theta: float
    beta: float
    theta_interval: tuple
    beta_interval: tuple
    confidence: float = 0.95

    def probability(self, x):
        return stats.norm.cdf(np.log(np.asarray(x, float) / self.theta) / self.beta)


def _check(x: np.ndarray, hits: np.ndarray, trials: np.ndarray) -> None:
    """A finite largest likelihood needs hits and misses that overlap, and a curve that rises."""
    if hits.sum() == 0:
        raise FitRefused(f"no hit in {int(trials.sum())} trials: all levels are too low")
    if (trials - hits).sum() == 0:
        raise FitRefused(f"a hit in each of {int(trials.sum())} trials: all levels are too high")
    first_hit, last_miss = x[hits > 0].min(), x[hits < trials].max()
    if not first_hit < last_miss:
        raise FitRefused(f"separated: no hit below {first_hit:.4g}, no miss above {last_miss:.4g}; "
                         "levels between them would give the curve")


def _likelihood(point: tuple, log_x: np.ndarray, hits: np.ndarray, trials: np.ndarray) -> float:
    """Minus the logarithm of the likelihood at a, b of Phi(a + b ln x)."""
    z = point[0] + point[1] * log_x
    return -float(hits @ log_ndtr(z) + (trials - hits) @ log_ndtr(-z))


def _newton(log_x: np.ndarray, hits: np.ndarray, trials: np.ndarray) -> tuple:
    """Largest likelihood of Phi(a + b ln x), which is concave in a and b: (a, b) and its Hessian."""
    point = np.array([0.0, 1.0 / max(np.ptp(log_x), 1e-3)])
    point[0] = -point[1] * log_x.mean()
    value = _likelihood(point, log_x, hits, trials)
    basis = np.stack([np.ones_like(log_x), log_x])
    for _ in range(200):
        z = point @ basis
        up, down = np.exp(-z * z / 2 - log_ndtr(z)), np.exp(-z * z / 2 - log_ndtr(-z))
        up, down = up / np.sqrt(2 * np.pi), down / np.sqrt(2 * np.pi)
        slope = hits * up - (trials - hits) * down
        curve = hits * up * (z + up) + (trials - hits) * down * (down - z)
        hessian = (basis * curve) @ basis.T
        step = np.linalg.solve(hessian + 1e-12 * np.eye(2), basis @ slope)
        share = 1.0
        while _likelihood(point + share * step, log_x, hits, trials) > value + 1e-12 and share > 1e-8:
            share /= 2
        point = point + share * step
        value = _likelihood(point, log_x, hits, trials)
        if np.abs(share * step).max() < 1e-10 * (1 + np.abs(point).max()):
            break
    return point, hessian


def fit_fragility(x, hits, trials, confidence: float = 0.95) -> Fragility:
    """Lognormal curve of largest likelihood from counts at levels `x` > 0. Intervals from the observed information,
    of ln theta and ln beta, for trials that do not depend on each other. Throws FitRefused."""
    x, hits, trials = (np.asarray(values, float) for values in (x, hits, trials))
    if not (x.shape == hits.shape == trials.shape and (x > 0).all() and (0 <= hits).all() and (hits <= trials).all()):
        raise ValueError("levels above 0, and as many hits and trials, no more hits than trials")
    _check(x, hits, trials)
    (a, b), hessian = _newton(np.log(x), hits, trials)
    if not b > 1e-6:
        raise FitRefused("hits do not become more with the level")
    covariance = np.linalg.inv(hessian)  # of a, b; ln theta = -a / b, ln beta = -ln b
    gradient = np.array([[-1 / b, a / b**2], [0, -1 / b]])
    spread = stats.norm.ppf(0.5 + confidence / 2) * np.sqrt(np.diag(gradient @ covariance @ gradient.T))
    theta, beta = float(np.exp(-a / b)), float(1 / b)
    return Fragility(theta, beta, (theta * float(np.exp(-spread[0])), theta * float(np.exp(spread[0]))),
                     (beta * float(np.exp(-spread[1])), beta * float(np.exp(spread[1]))), confidence)


def fit_paired(x, hit: np.ndarray, confidence: float = 0.95, repeats: int = 400, seed: int = 1) -> Fragility:
    """As fit_fragility, of `hit` (samples, levels), where a sample is the same motion and building at every level: its
    trials depend on each other, and the intervals of ln theta and ln beta are Student's, about the fit less its bias, with
    the bias and deviation of fits to samples drawn anew (bootstrap; quantiles of these hold beta in 88 % for 95). Draws
    without a fit are left out; of more than one in ten the fit is refused. Throws FitRefused."""
    x, hit = np.asarray(x, float), np.asarray(hit, float)
    trials = np.full(len(x), float(len(hit)))
    best = fit_fragility(x, hit.sum(0), trials, confidence)
    generator, found = np.random.default_rng(seed), []
    for _ in range(repeats):
        drawn = hit[generator.integers(len(hit), size=len(hit))]
        try:
            one = fit_fragility(x, drawn.sum(0), trials)
            found.append((one.theta, one.beta))
        except FitRefused:
            pass
    if len(found) < 0.9 * repeats:
        raise FitRefused(f"hardly overlapping: {repeats - len(found)} of {repeats} draws of the samples are separated; "
                         "levels closer to each other, or more samples, would give the curve")
    drawn, centre = np.log(found), np.log([best.theta, best.beta])
    bias, count = drawn.mean(0) - centre, len(hit)
    half = stats.t.ppf(0.5 + confidence / 2, count - 1) * np.sqrt(count / (count - 1)) * drawn.std(0, ddof=1)
    low, high = np.exp(centre - bias - half), np.exp(centre - bias + half)
    return Fragility(best.theta, best.beta, *((float(a), float(b)) for a, b in zip(low, high)), confidence)


# Samples of what is not known exactly.

DISTRIBUTIONS = ("normal", "lognormal", "uniform")


@dataclass(frozen=True)
class Variable:
    """A quantity with a distribution: `centre` is the mean of normal and uniform, the median of lognormal ones;
    `spread` their standard deviation, of lognormal ones the coefficient of variation."""

    name: str
    distribution: str
    centre: float
    spread: float

    def quantile(self, p: np.ndarray) -> np.ndarray:
        if self.distribution == "lognormal":
            return self.centre * np.exp(np.sqrt(np.log1p(self.spread**2)) * stats.norm.ppf(p))
        if self.distribution == "normal":
            return self.centre + self.spread * stats.norm.ppf(p)
        return self.centre + self.spread * np.sqrt(3) * (2 * p - 1)


def latin_hypercube(variables: list, count: int, seed: int) -> np.ndarray:
    """`count` samples (count, variables): of each variable one in every stratum of equal probability, paired at
    random by the seed; the same seed gives the same samples."""
    if not variables:
        return np.empty((count, 0))
    places = qmc.LatinHypercube(d=len(variables), seed=seed).random(count)
    return np.stack([one.quantile(places[:, i]) for i, one in enumerate(variables)], axis=1)


# Accelerograms.

def correlations(signals: list) -> np.ndarray:
    """Correlation coefficients (n, n) of signals with the same time step; the ground stands still behind the end of
    shorter ones."""
    length = max(map(len, signals))
    return np.atleast_2d(np.corrcoef([np.pad(np.asarray(one, float), (0, length - len(one))) for one in signals]))


def hclpf(medians: list, betas: list, uncertainty: float | None = None) -> dict:
    """Capacity that has a low probability of failure (5 %) with a high confidence (95 %), from lognormal curves of one
    event in conditions that are equally likely: A_m exp(-1.645 (beta_R + beta_U)), beta_R of what is drawn within a
    condition, beta_U of the medians of the conditions and of what the user gives beside it. Of one condition without it the
    curve's deviation is that of both together: A_m exp(-2.326 beta) (EPRI TR-103959)."""
    logs, betas = np.log(medians), np.asarray(betas)
    median, random = float(np.exp(logs.mean())), float(np.sqrt((betas**2).mean()))
    if len(medians) == 1 and uncertainty is None:
        return {"A_m [m/s2]": median, "beta": random, "HCLPF [m/s2]": median * float(np.exp(-2.326 * random)),
                "HCLPF by": "1 % of the curve"}
    between = float(np.hypot(logs.std(), uncertainty or 0.0))
    origin = [f"{len(medians)} conditions"] if len(medians) > 1 else []
    origin += [f"{uncertainty:g} given"] if uncertainty is not None else []
    return {"A_m [m/s2]": median, "beta_R": random, "beta_U": between,
            "HCLPF [m/s2]": median * float(np.exp(-1.645 * (random + between))), "HCLPF by": f"beta_U of {' and '.join(origin)}"}
