"""What the outcomes of a study say: moments of spectra by cell, probabilities, curves, joints, enough motions."""

from dataclasses import dataclass, field

import numpy as np
from scipy import stats

from pounding import UserError
from pounding.fragility import (Fragility, FitRefused, binomial_interval, fit_paired, hclpf, joint_share, members_needed,
                                moments, scatter, widened)

from .design import OWN_FIELD, Design
from .equipment import Item
from .outcomes import Outcomes
from .study import Study

CONTACT = "contact"
ROUND_OFF = 1e-6  # of the largest spectrum: below it a channel stands still
MAIN = 0.05  # of the largest spectrum of its probe: what a channel needs to count in errors and numbers of motions
EXCEEDED = (0.5, 0.16, 0.05)
TOLERANCE = 0.1  # of the mean that is to be known


@dataclass
class Analysis:
    """A cell is a gap [m], or None of the runs apart, and a level [m/s2]."""

    study: Study
    design: Design
    outcomes: Outcomes
    equipment: list = field(default_factory=list)
    notes: list = field(default_factory=list)  # doubts and remarks, a line each
    inputs: dict = field(default_factory=dict)  # files that the members read, with their hashes
    runner: object = None  # of the members
    mats: list = field(default_factory=list)  # pounding.stability.Mat of each whose stability is asked for
    stability: dict = field(default_factory=dict)  # member -> what was found of these in it
    controlled: object = None  # controlled.Controlled, of a study with samples at full order beside these

    def __post_init__(self):
        self.fitted = {}
        self.index = {(one.gap, one.level, one.sample, one.exchanged, one.factors): number
                      for number, one in enumerate(self.design.members) if not one.disturbed}
        largest = self.outcomes.spectra.max((0, 2, 3))
        if not self.main(self.outcomes.spectra):
            raise UserError(f"{self.study.path}: no probe moves; has {self.study.scene.name} probes, and no record of "
                            "its own along an axis of the study's targets, over which it wins?")
        self.channels = [number for number in range(len(largest)) if largest[number] > ROUND_OFF * largest.max()]
        self.cells = [(gap, level) for gap in [*self.study.gaps, None] for level in self.study.levels]

    def main(self, spectra: np.ndarray) -> list:
        """Numbers of the channels whose largest of these spectra (members, channels, ...) is not small beside that of
        their probe."""
        largest = spectra.max((0, *range(2, spectra.ndim)))
        of_probe = {}
        for name, value in zip(self.outcomes.channels, largest):
            of_probe[name.split()[0]] = max(value, of_probe.get(name.split()[0], 0.0))
        return [number for number, name in enumerate(self.outcomes.channels)
                if largest[number] > MAIN * of_probe[name.split()[0]] > 0]

    def of(self, gap: float | None, level: float, exchanged: bool = False, factors: tuple = OWN_FIELD) -> np.ndarray:
        """Members of a cell, by sample; `exchanged`: those in the joints of the next samples; `factors`: in other
        fields."""
        return np.array([self.index[gap, level, sample, exchanged, factors] for sample in range(self.study.samples)])

    def damping(self, ratio: float) -> int:
        """Number of the study's damping ratio that is nearest."""
        return int(abs(self.outcomes.damping - ratio).argmin())

    def frequencies_shown(self, default) -> list:
        """Numbers of the frequencies that are nearest to those of `show`, or to others [Hz]."""
        given = self.study.show.get("frequencies", default)
        given = [float(one) for one in given.split(",")] if isinstance(given, str) else given
        return sorted({int(abs(self.outcomes.frequency - one).argmin()) for one in given})

    # Spectra.

    def spectra_rows(self, gap: float | None, level: float) -> list:
        """A row per channel that moves, damping ratio and frequency."""
        found = self.outcomes
        one = moments(found.spectra[self.of(gap, level)][:, self.channels], self.study.confidence)
        columns = {"mean": one.mean, "median": one.median, "p16": one.low, "p84": one.high, "cov": one.cov,
                   "log_deviation": one.log_deviation, "half_width_of_mean": one.half_width, "envelope": one.largest,
                   "mean_widened": widened(found.frequency, one.mean), "p84_widened": widened(found.frequency, one.high)}
        return found.rows(self.channels, lambda at: {"members": one.count,
                                                     **{name: f"{values[at]:.6g}" for name, values in columns.items()}})

    # Probabilities.

    def hits(self, event, gap: float | None) -> np.ndarray:
        """Whether the event comes about (samples, levels)."""
        members = np.stack([self.of(gap, level) for level in self.study.levels], 1)
        found = self.outcomes
        if event == CONTACT:
            return found.episodes[members].sum(-1) > 0
        if isinstance(event, Item):
            damping = self.damping(event.damping)
            return np.any([event.fails(found.frequency, found.spectra[members][:, :, channel, damping])
                           for channel in (found.channels.index(f"{event.probe} {way}") for way in event.ways)], axis=0)
        inside = (found.frequency >= event.band[0]) & (found.frequency <= event.band[1])
        channel = found.channels.index(f"{event.probe} {event.direction}")
        damping = self.damping(event.damping)
        return found.spectra[members][:, :, channel, damping, inside].max(-1) > event.acceleration

    @property
    def events(self) -> list:
        return [CONTACT, *self.study.capacities, *self.equipment]

    def gaps_of(self, event) -> list:
        return list(self.study.gaps) if event == CONTACT else [*self.study.gaps, None]

    def probability(self, event, gap: float | None) -> tuple:
        """Members in which an event comes about, their part of all, and the ends of its interval, each (levels)."""
        counts = self.hits(event, gap).sum(0)
        return counts, counts / self.study.samples, *binomial_interval(counts, self.study.samples, self.study.confidence)

    def probability_rows(self) -> list:
        rows = []
        for event in self.events:
            for gap in self.gaps_of(event):
                rows += [{"event": name_of(event), "gap [m]": gap_text(gap), "pga [m/s2]": level, "hits": int(count),
                          "of": self.study.samples, "probability": part, "low": float(a), "high": float(b)}
                         for level, count, part, a, b in zip(self.study.levels, *self.probability(event, gap))]
        return rows

    def fits(self, event) -> dict:
        """Gap -> Fragility, or the line why there is none."""
        name = name_of(event)
        if name in self.fitted:
            return self.fitted[name]
        found = self.fitted[name] = {}
        for gap in self.gaps_of(event):
            try:
                found[gap] = fit_paired(self.study.levels, self.hits(event, gap), self.study.confidence)
            except FitRefused as error:
                found[gap] = str(error)
        return found

    # The joint that would be needed.

    def needed(self, contact: int | None = None, torsion: float | None = None) -> np.ndarray:
        """Nominal joint at which the contact (any: the worst) just does not close, of the runs apart [m]: their nominal
        gap less the smallest that was left; (samples, levels). `torsion`: factor on the closing of each pair; None: that of
        the study, 1: what the runs did."""
        members = np.stack([self.of(None, level) for level in self.study.levels], 1)
        places = [self.outcomes.contacts.index(name) for name in self.study.joints]
        left = self.left(self.study.torsion.factor if torsion is None else torsion)[members]
        return self.study.apart - (left[..., places].min(-1) if contact is None else left[..., contact])

    def left(self, torsion: float) -> np.ndarray:
        """Smallest gap of each contact where closings are so many times those of the runs (members, contacts) [m]."""
        found = self.outcomes
        if torsion == 1:
            return found.smallest_gap
        gaps = found.pair_gap - torsion * (found.pair_gap - found.pair_least)
        return np.stack([gaps[:, found.pair_contact == number].min(1, initial=np.inf) for number in range(len(found.contacts))], 1)

    def joint_rows(self, rules: dict) -> list:
        rows = []
        for name in [*self.study.joints, "any"]:
            needed = self.needed(None if name == "any" else self.outcomes.contacts.index(name))
            for number, level in enumerate(self.study.levels):
                row = {"joint": name, "pga [m/s2]": level}
                for part in EXCEEDED:
                    value, low, high = quantile(needed[:, number], 1 - part, self.study.confidence)
                    name_of_part = f"{100 * part:g} %"
                    row |= {f"{name_of_part} [m]": value, f"{name_of_part} low": low, f"{name_of_part} high": high}
                row |= {f"{rule} [m]": value * level for rule, value in rules.get(name, {}).items()}
                rows.append(row)
        return rows

    def first_contact(self) -> np.ndarray:
        """Peak ground acceleration at which each sample first closes a joint of each gap (samples, gaps) [m/s2]: the
        needed joint of the runs as they were, linear between the levels and from zero, and on beyond the last level."""
        needed = self.needed(torsion=1)
        at_rest = -self.study.built(self.design.samples).min(1)
        levels = np.array([0.0, *self.study.levels])
        result = np.empty((self.study.samples, len(self.study.gaps)))
        for sample in range(self.study.samples):
            path = np.array([at_rest[sample], *needed[sample]])
            for place, gap in enumerate(self.study.gaps):
                above = np.flatnonzero(path > gap)
                if above.size and above[0] == 0:
                    result[sample, place] = 0.0
                    continue
                k = min(above[0] if above.size else len(levels) - 1, len(levels) - 1)
                slope = (path[k] - path[k - 1]) / (levels[k] - levels[k - 1])
                result[sample, place] = levels[k] + (gap - path[k]) / slope if slope > 0 else np.inf
        return result

    def contradictions(self) -> int:
        """Members that touched although the run apart says that the joint was wide enough, or the other way round."""
        needed = self.needed(torsion=1)
        return int(sum((self.hits(CONTACT, gap) != (needed > gap)).sum() for gap in self.study.gaps))

    # How many motions were enough.

    def enough_rows(self, band: tuple = (0.0, np.inf)) -> list:
        """Per cell, channel and damping ratio the largest coefficient of variation, and how many members it asks for so
        that the mean, and that of the logarithm, is known within TOLERANCE at 68 and 95 %."""
        rows, found = [], self.outcomes
        inside = (found.frequency >= band[0]) & (found.frequency <= band[1])
        for gap, level in self.cells:
            spectra = found.spectra[self.of(gap, level)]
            main = self.main(spectra)
            one = moments(spectra[:, main][..., inside])
            for c, channel in enumerate(main):
                for d, ratio in enumerate(found.damping):
                    worst = int(one.cov[c, d].argmax())
                    log_worst = float(np.nanmax(one.log_deviation[c, d]))
                    row = {"gap [m]": gap_text(gap), "pga [m/s2]": level, "channel": found.channels[channel],
                           "damping": f"{ratio:g}", "largest cov": float(one.cov[c, d, worst]),
                           "at [Hz]": float(found.frequency[inside][worst]), "largest log deviation": log_worst}
                    for confidence in (0.68, 0.95):
                        row[f"mean {100 * confidence:g} %"] = int(
                            members_needed(one.cov[c, d, worst], TOLERANCE, confidence))
                        row[f"ln mean {100 * confidence:g} %"] = int(
                            members_needed(log_worst, np.log(1 + TOLERANCE), confidence))
                    rows.append(row)
        return rows

    # How much of the scatter is the joint's.

    @property
    def exchanged_cells(self) -> list:
        return [cell for cell in self.cells if cell[0] is not None] if self.study.exchange else []

    def logarithms(self, gap: float, level: float, channels: list, factors: tuple = OWN_FIELD) -> list:
        """ln of the spectra of a cell, with each sample's own joint and with the next one's."""
        return [np.log(np.maximum(self.outcomes.spectra[self.of(gap, level, exchanged, factors)][:, channels], 1e-300))
                for exchanged in (False, True)]

    def scatter_rows(self) -> list:
        """Per cell, main channel, damping ratio and frequency the deviation of ln S, and what of it the joint and the
        motion make alone, the other one held."""
        rows, found = [], self.outcomes
        for gap, level in self.exchanged_cells:
            main = self.main(found.spectra[self.of(gap, level)])
            one = scatter(*self.logarithms(gap, level, main))
            rows += found.rows(main, lambda at: {name: f"{getattr(one, name)[at]:.4g}" for name in ("all", "joint", "motion")},
                               {"gap [m]": gap_text(gap), "pga [m/s2]": level})
        return rows

    def joint_share_rows(self) -> list:
        """Per cell, main channel and band the deviations of ln S at 5 % damping, rms over the band's frequencies, and
        the part of the variance that would go if the joint were known, with its interval."""
        rows, found = [], self.outcomes
        damping = self.damping(0.05)
        for gap, level in self.exchanged_cells:
            main = self.main(found.spectra[self.of(gap, level)])
            own, exchanged = (values[:, :, damping] for values in self.logarithms(gap, level, main))
            for band, inside in found.bands:
                one = scatter(own[..., inside], exchanged[..., inside])
                part = joint_share(own[..., inside], exchanged[..., inside], self.study.confidence)
                rows += [{"gap [m]": gap_text(gap), "pga [m/s2]": level, "channel": found.channels[channel],
                          "band [Hz]": band,
                          **{name: rms(getattr(one, name)[c]) for name in ("all", "joint", "motion")},
                          "share of the joint": float(part[0][c]), "low": float(part[1][c]), "high": float(part[2][c])}
                         for c, channel in enumerate(main)]
        return rows

    def field_rows(self) -> list:
        """Per joint at the strongest level, main channel and band, for the study's own fields and each pair of factors on
        them: how many members touch, the 84 % spectrum at 5 % damping over that in the study's own fields, in the median
        of the band's frequencies and where it is furthest from 1, and with `exchange` the deviation of ln S that the
        joint makes alone."""
        rows, found, level = [], self.outcomes, self.study.levels[-1]
        damping = self.damping(0.05)
        for gap in self.study.gaps if self.study.field_factors else []:
            main = self.main(found.spectra[self.of(gap, level)])
            high = {factors: moments(found.spectra[self.of(gap, level, factors=factors)][:, main, damping]).high
                    for factors in (OWN_FIELD, *self.study.field_factors)}
            for factors, spectra in high.items():
                hits = int((found.episodes[self.of(gap, level, factors=factors)].sum(-1) > 0).sum())
                ratio = spectra / high[OWN_FIELD]
                joint = scatter(*(values[:, :, damping] for values in self.logarithms(gap, level, main, factors))).joint \
                    if self.study.exchange else None
                for band, inside in found.bands:
                    rows += [{"gap [m]": gap_text(gap), "pga [m/s2]": level, "channel": found.channels[channel],
                              "band [Hz]": band, "deviation times": factors[0], "length times": factors[1],
                              "touch": hits, "84 % ratio, median": float(np.median(ratio[c, inside])),
                              "84 % ratio, furthest": furthest(ratio[c, inside]),
                              "joint": rms(joint[c, inside]) if joint is not None else ""}
                             for c, channel in enumerate(main)]
        return rows

    # Repeats at full order.

    def repeat_rows(self, full: Outcomes) -> list:
        """Per repeated member and main channel of it rms and largest ln-ratio of its spectra to full order, where they
        are above a hundredth of their largest, beside those of a little more shaking."""
        rows, found = [], self.outcomes
        disturbed = [number for number, one in enumerate(self.design.members) if one.disturbed]
        for place, number in enumerate(self.design.repeated):
            one = self.design.members[number]
            sums = [float(values.impulse_sum[index].sum()) for values, index in ((found, number), (full, place))]
            for channel in self.main(full.spectra[place:place + 1]):
                exact = full.spectra[place][channel]
                mine, noise = (found.spectra[index][channel] for index in (number, disturbed[place]))
                held = exact > 0.01 * exact.max(-1, keepdims=True)
                errors = [np.log(a[held] / b[held]) for a, b in ((mine, exact), (noise, mine))]
                rows.append({"sample": one.sample, "gap [m]": gap_text(one.gap), "pga [m/s2]": one.level,
                             "channel": found.channels[channel], "rms": rms(errors[0]),
                             "largest": float(abs(errors[0]).max()), "rms of noise": rms(errors[1]),
                             "largest of noise": float(abs(errors[1]).max()), "impulses [N s]": sums[0],
                             "at full order [N s]": sums[1], "touched": int(found.episodes[number].sum() > 0),
                             "at full order": int(full.episodes[place].sum() > 0)})
        return rows

    def member_rows(self) -> list:
        found, rows = self.outcomes, []
        for number, one in enumerate(self.design.members):
            touched = found.episodes[number].sum() > 0
            rows.append({"sample": one.sample, "gap [m]": gap_text(one.gap), "pga [m/s2]": one.level,
                         "disturbed": int(one.disturbed), "exchanged": int(one.exchanged),
                         "deviation times": one.factors[0], "length times": one.factors[1],
                         "impacts": int(found.episodes[number].sum()),
                         "first [s]": float(np.nanmin(found.first_time[number])) if touched else "",
                         "impulses [N s]": float(found.impulse_sum[number].sum()),
                         "largest impulse [N s]": float(found.impulse_largest[number].max(initial=0.0)),
                         "peak force [N]": float(found.force_peak[number].max(initial=0.0)),
                         **{f"smallest gap {name} [m]": float(found.smallest_gap[number, place])
                            for place, name in enumerate(found.contacts)},
                         "energy residual": float(found.residual[number])})
        return rows


def furthest(ratios: np.ndarray) -> float:
    """The ratio that is furthest from 1, up or down."""
    return float(ratios[abs(np.log(ratios)).argmax()])


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def gap_text(gap: float | None) -> str:
    return "apart" if gap is None else f"{gap:g}"


def name_of(event) -> str:
    return event if event == CONTACT else event.name


def quantile(values: np.ndarray, p: float, confidence: float) -> tuple:
    """Quantile, and the order statistics between which it lies at this confidence, whatever the distribution; empty
    where there are too few."""
    ordered, count = np.sort(values), len(values)
    tail = (1 - confidence) / 2
    low, high = int(stats.binom.ppf(tail, count, p)), int(stats.binom.ppf(1 - tail, count, p)) + 1
    return (float(np.quantile(values, p)), float(ordered[low - 1]) if low >= 1 else "",
            float(ordered[high - 1]) if high <= count else "")


def fit_row(event, gap: float | None, fit: Fragility | str, first: np.ndarray | None, uncertainty: float | None) -> dict:
    """`first`: peak ground accelerations at first contact, whose median and deviation stand beside the fit."""
    row = {"event": name_of(event), "gap [m]": gap_text(gap)}
    if isinstance(fit, str):
        row |= dict.fromkeys(("theta [m/s2]", "theta low", "theta high", "beta", "beta low", "beta high"), "")
        row["refused"] = fit
    else:
        row |= {"theta [m/s2]": fit.theta, "theta low": fit.theta_interval[0], "theta high": fit.theta_interval[1],
                "beta": fit.beta, "beta low": fit.beta_interval[0], "beta high": fit.beta_interval[1], "refused": ""}
        row |= {name: value for name, value in hclpf([fit.theta], [fit.beta], uncertainty).items() if name.startswith("HCLPF")}
    held = first is not None and (first > 0).all() and np.isfinite(first).all()
    row["theta of first contacts"] = float(np.exp(np.log(first).mean())) if held else ""
    row["beta of first contacts"] = float(np.log(first).std(ddof=1)) if held else ""
    return row
