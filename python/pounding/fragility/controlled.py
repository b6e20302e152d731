"""Numbers of a study at full order, with its reduced runs as control variates: how many samples of each order, and what they say
together."""

import hashlib
import json
import time
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from pounding import UserError
from pounding.files import write_text
from pounding.plot.design_spectra import SHOWN
from pounding.runs import Job, clear, finish
from pounding.tables import write_csv

from . import control_variates as control
from .analysis import CONTACT, EXCEEDED, Analysis, gap_text, name_of
from .both_orders import FULL, REDUCED
from .design import Design

CAPTION = "At full order, with reduced runs as control variates"
PLAN, COSTS = "plan.json", "costs.json"


@dataclass(frozen=True)
class Numbers:
    """Samples in their order: `pilot` of them at all orders, which give slopes, then those that each order has (`counts`, the dearest
    first, of orders that pay), beginning alike; `reached`: half of the interval of the least known mean over it, as planned."""

    pilot: int
    counts: dict
    reached: float = 0.0

    @property
    def count(self) -> int:
        """Samples in all, those of the reduction."""
        return self.pilot + self.counts[REDUCED]

    @property
    def told(self) -> str:
        between = "".join(f", {count} at order {name}" for name, count in self.counts.items() if name not in (FULL, REDUCED))
        pilot = f", beside a pilot of {self.pilot} at all orders: the least known mean within {100 * self.reached:.2g} %" if self.pilot else ""
        return f"{self.counts[FULL]} samples at full order{between} and {self.counts[REDUCED]} by the reduction, each with those before{pilot}"


def plain(design: Design, first: int, end: int) -> list:
    """Members of samples with numbers from `first` to before `end`, in the study's joints and apart."""
    return [one for one in design.members if one.is_plain and first <= one.sample < end]


def settle(runner, may_run: bool) -> Numbers:
    """How many samples are run at each order: as given, or by the plan of the pilot, which is run where it is missing and kept.
    Throws UserError."""
    study, asked = runner.study, runner.study.both
    if asked.samples:
        return Numbers(0, {FULL: asked.samples, REDUCED: study.samples})
    told = asdict(asked), study.samples, study.confidence, [one.values for one in runner.design.members]
    kept = runner.bases[FULL] / f"{hashlib.sha256(str(told).encode()).hexdigest()[:12]}-{PLAN}"
    if not kept.is_file():
        if not may_run:
            raise UserError(f"{study.path}: full_order: accuracy: its pilot has not been run; run/fragility {study.path} --pilot does so")
        print(f"fragility: pilot of {asked.pilot} samples at {len(study.orders)} orders", flush=True)
        pilot = dict.fromkeys(study.orders, plain(runner.design, 0, asked.pilot))
        costs = _measured(runner, pilot)
        runner.run((1, 1), pilot)
        orders = sorted(study.orders, key=lambda order: (order != FULL, order == REDUCED, -costs[order]))
        full, *cheap = (np.concatenate(_planned(_analysis(runner, asked.pilot, order)), axis=1) for order in orders)
        moving = full.mean(0) > 0
        found = control.plan((full.std(0, ddof=1) / full.mean(0))[moving],
                             [_cautious(control.correlation(full, one), asked.pilot)[moving] for one in cheap],
                             [costs[order] for order in orders], asked.accuracy, study.samples - asked.pilot, study.confidence)
        counts = {order: count for order, count in zip(orders, found.counts) if count}
        write_text(kept, json.dumps(asdict(Numbers(asked.pilot, counts, found.reached))))
    return Numbers(**json.loads(kept.read_text(encoding="utf-8")))


def _cautious(rho: np.ndarray, count: int) -> np.ndarray:
    """Correlations from so few draws, less their bias."""
    return np.sqrt(np.clip(1 - (1 - rho**2) * (count - 1) / (count - 2), 0, 1))


def run(runner, numbers: Numbers, part: tuple) -> str:
    """Runs what is missing of the study's samples at all orders, of a part i of n; returns how. Throws UserError."""
    members = {REDUCED: runner.design.members, **{order: plain(runner.design, numbers.pilot, numbers.pilot + count)
                                                  for order, count in numbers.counts.items() if order != REDUCED}}
    mine = {order: some[part[0] - 1::part[1]] for order, some in members.items()}
    if all(mine.values()):
        _measured(runner, mine)
    return runner.run((1, 1), mine)


def _measured(runner, members: dict) -> dict:
    """Time that a member takes at each order [s], as it was first measured: by running what is missing of these of each order, where it
    was not yet."""
    kept = runner.bases[FULL] / COSTS
    costs = json.loads(kept.read_text(encoding="utf-8")) if kept.is_file() else {}
    for order in [order for order in members if order not in costs]:
        missing = runner.found(members[order], order)[1]
        began = time.monotonic()
        if missing:
            runner.run((1, 1), {order: members[order]})
        costs[order] = (time.monotonic() - began) / len(missing) if missing else _timed(runner, members[order][0], order)
        write_text(kept, json.dumps(costs))
    return costs


def _timed(runner, member, order: str) -> float:
    """Time of a run of a member that is there already, anew [s]."""
    place = (runner.bases[order] / "timed").absolute()
    began = time.monotonic()
    failure = finish(lambda: Job(runner.words(member, order), place, runner.ranks, Path.cwd(), runner.variables))
    if failure:
        raise UserError(failure)
    clear(place)
    return time.monotonic() - began


def _analysis(runner, count: int, order: str) -> Analysis:
    """Of the first samples, without those in joints of others. Throws UserError where a member is missing."""
    members = plain(runner.design, 0, count)
    return Analysis(replace(runner.study, samples=count), replace(runner.design, members=members), runner.complete(members, order),
                    runner.equipment)


def _shown(analysis: Analysis) -> list:
    """Numbers of the frequencies whose spectra are planned and listed."""
    frequency = analysis.outcomes.frequency
    return analysis.frequencies_shown([one for one in SHOWN if frequency[0] <= one <= frequency[-1]])


def _planned(analysis: Analysis) -> list:
    """Quantities whose means the plan is made for, a list of (samples, values): spectra at 5 % damping of the channels that count at
    the shown frequencies, and the joint needed."""
    found, damping, at = analysis.outcomes, analysis.damping(0.05), _shown(analysis)
    main = analysis.main(found.spectra)
    return [found.spectra[analysis.of(gap, level)][:, main, damping][:, :, at].reshape(analysis.study.samples, -1)
            for gap, level in analysis.cells] + [np.maximum(analysis.needed(), 0.0)]


class Controlled:
    """The study's numbers at full order, with reduced runs as controls."""

    def __init__(self, runner, numbers: Numbers, reduced: Analysis):
        """`reduced`: of all samples. Throws UserError where a member at another order is missing."""
        self.numbers, self.study = numbers, runner.study
        costs = json.loads((runner.bases[FULL] / COSTS).read_text(encoding="utf-8"))
        self.costs = [costs[order] for order in numbers.counts]
        self.analyses = [reduced if order == REDUCED else _analysis(runner, numbers.pilot + count, order) for order, count in numbers.counts.items()]
        self.full = self.analyses[0]

    def draws(self, value_of) -> control.Draws:
        """Of values (samples, ...) of an analysis."""
        values, first = [value_of(one) for one in self.analyses], self.numbers.pilot
        return control.Draws([one[first:] for one in values], [one[:first] for one in values] if first else None, self.costs)

    def _row(self, name: str, gap: str, level: float, found: control.Estimate, at: tuple, draws: control.Draws, simple) -> dict:
        """`simple`: the same number of draws without a control, of the reduced runs and of those at full order alone."""
        values = [getattr(found, part)[at] for part in ("value", "low", "high")]
        return {"quantity": name, "gap [m]": gap, "pga [m/s2]": level,
                **{key: "" if np.isnan(value) else float(value) for key, value in zip(("value", "low", "high"), values)},
                "reduced alone": float(simple(draws.values[-1])[at]), "full order alone": float(simple(draws.full)[at]),
                "correlation": float(found.correlation[at]), "gain": float(found.gain[at])}

    @cached_property
    def rows(self) -> list:
        """Probabilities, joint needed, and mean and 84 % of the spectra at 5 % damping and the shown frequencies."""
        study, found = self.study, self.full.outcomes
        rows = []
        for event in self.full.events:
            for gap in self.full.gaps_of(event):
                draws = self.draws(lambda one: one.hits(event, gap).astype(float))
                some = control.probability(draws, study.confidence)
                rows += [self._row(f"P({name_of(event)})", gap_text(gap), level, some, (k,), draws, lambda v: v.mean(0))
                         for k, level in enumerate(study.levels)]
        draws = self.draws(lambda one: one.needed())
        for part in EXCEEDED:
            some = control.quantile(draws, 1 - part, study.confidence)
            rows += [self._row(f"joint needed, exceeded in {100 * part:g} % [m]", "apart", level, some, (k,), draws,
                               lambda v: np.quantile(v, 1 - part, axis=0)) for k, level in enumerate(study.levels)]
        damping, main = self.full.damping(0.05), self.full.main(found.spectra)
        for gap, level in self.full.cells:
            draws = self._spectra(gap, level, main, damping)
            for name, some, simple in (("mean", control.mean(draws, study.confidence), lambda v: v.mean(0)),
                                       ("84 %", control.quantile(draws, 0.84, study.confidence), lambda v: np.quantile(v, 0.84, axis=0))):
                rows += [self._row(f"{name} of {found.channels[channel]}, {found.frequency[k]:.3g} Hz [m/s2]", gap_text(gap), level, some, (c, k),
                                   draws, simple) for c, channel in enumerate(main) for k in _shown(self.full)]
        return rows

    def _spectra(self, gap: float | None, level: float, channels: list, damping: int) -> control.Draws:
        return self.draws(lambda one: one.outcomes.spectra[one.of(gap, level)][:, channels, damping])

    def write_spectra(self, folder: Path) -> None:
        """A table of whole spectra of each cell, in the folder spectra."""
        found, study = self.full.outcomes, self.study
        for gap, level in self.full.cells:
            table = []
            for d, ratio in enumerate(found.damping):
                draws = self._spectra(gap, level, self.full.channels, d)
                some = control.mean(draws, study.confidence), control.quantile(draws, 0.84, study.confidence)
                table += [{"channel": found.channels[channel], "damping": f"{ratio:g}", "frequency": f"{f:.9g}",
                           **{f"{name}{end}": f"{getattr(one, key)[c, k]:.6g}" for name, one in zip(("mean", "p84"), some)
                              for end, key in (("", "value"), (" low", "low"), (" high", "high"))},
                           "correlation": f"{some[0].correlation[c, k]:.4g}", "gain of the mean": f"{some[0].gain[c, k]:.4g}"}
                          for c, channel in enumerate(self.full.channels) for k, f in enumerate(found.frequency)]
            write_csv(folder / "spectra" / f"full-order_gap-{gap_text(gap)}_pga-{level:g}.csv", table)

    def told(self) -> list:
        """How many runs of each order there were, what they cost, and what they gained, in sentences."""
        asked, reached = self.study.both.accuracy, self.numbers.reached
        gains = {words: [row["gain"] for row in self.rows if row["quantity"].startswith(key)]
                 for words, key in (("means of spectra", "mean"), ("their 84 %", "84 %"), ("the joint", "joint"), ("contact", f"P({CONTACT}"))}
        lines = [f"At full order by control variates: {self.numbers.told}. A run at full order costs {self.costs[0] / self.costs[-1]:.3g} reduced ones; at equal "
                 f"cost the variance is less by factors of {', '.join(f'{np.median(some):.2g} ({words})' for words, some in gains.items())} "
                 "in the median."]
        if asked and reached > asked:
            lines.append(f"Doubt: full_order: {self.study.samples} samples do not suffice for an accuracy of {100 * asked:g} %: the plan's least "
                         f"known mean is within {100 * reached:.2g} %.")
        return lines
