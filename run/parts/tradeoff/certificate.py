"""A rung of a scene's ladder that is as close to full order as asked, and how that is known."""

import math
from dataclasses import dataclass, field
from pathlib import Path

from pounding.results import UNREADABLE

from . import estimate, flexibility, ladder
from .climb import ALL, BAND_NAMES, Climb, Climbed, Facts, window_of
from .runs import Outcome
from .settings import Setting

FASTER = (8, 4, 2)  # multiples of full order's step that are tried with a rung
NOTHING = dict.fromkeys(BAND_NAMES, 0.0)


@dataclass
class Candidate:
    """A setting within the target: a rung, as it is or with a longer step; `parts`: its error, per band."""

    rung: int  # of the rungs
    setting: Setting
    outcome: Outcome  # over the window
    parts: dict  # "reduction", "longer step" -> rms per band

    @property
    def cost(self) -> float:
        return self.outcome.per_second()

    @property
    def error(self) -> float:
        return math.hypot(*(part[ALL] for part in self.parts.values()))


@dataclass
class Certificate:
    """What was found; errors are rms of the logarithm of the floor spectra's ratio, per band."""

    target: float
    facts: Facts
    window: float | None  # [s]; None: the whole scene
    end_time: float  # [s]
    floor: dict  # disturbance -> rms per band
    climbed: list  # coarsest first
    errors: list  # of the rungs: estimates per band
    full: bool  # full order is the last of them: its distances are errors
    chosen: int  # of the rungs
    reached: bool
    shrank: bool
    setting: Setting = None  # of the chosen rung, with a longer step where it pays
    outcome: Outcome = None  # of that setting, over the whole scene
    tried: list = field(default_factory=list)  # the Candidates that were set beside it
    parts: dict = field(default_factory=dict)  # reduction, longer step; step; mesh -> rms per band
    true: list = field(default_factory=list)  # per rung the distance from full order, where it was checked

    @property
    def confirmed(self) -> bool:
        """Full order, or a rung with a finer one beside it."""
        return self.full or self.chosen < len(self.climbed) - 1

    def beside_full_order(self, band: str = ALL) -> float:
        """Of the chosen setting: reduction and longer step, and no less than the noise floor."""
        return max(math.hypot(*(self.parts.get(name, NOTHING)[band] for name in ("reduction", "longer step"))),
                   self.floor_of(band))

    def all_parts(self, band: str = ALL) -> float:
        """With the time step and, where it was asked for, the mesh."""
        return math.hypot(self.beside_full_order(band),
                          *(self.parts.get(name, NOTHING)[band] for name in ("step", "mesh")))

    def floor_of(self, band: str = ALL) -> float:
        return max((one[band] for one in self.floor.values()), default=0.0)

    def lacking(self, folder: Path) -> list:
        """Of every reduced rung, the part of an impulse's velocities that its basis has not and the finest has; None
        where no file of a basis tells."""
        reduced = [one.rung.modes for one in self.climbed if one.rung.modes]
        return [_lacking(folder, self.facts.structures, one.rung.modes, reduced[-1]) if one.rung.modes else None
                for one in self.climbed]


def _lacking(folder: Path, structures: tuple, modes: int, finest: int) -> float | None:
    try:
        return max(flexibility.lacking(folder / f"basis-{name}-{modes}.h5", folder / f"basis-{name}-{finest}.h5")
                   for name in structures)
    except UNREADABLE:
        return None


def certify(climb: Climb, target: float, window: float | None = None, budget: float = 600.0,
            finer: tuple = (), check: bool = False) -> Certificate:
    """The fastest setting with an estimated error of at most `target`, of all rungs and longer steps that could be it.
    `budget`: wall time that full order may take over the window [s]; `finer`: options of a finer mesh, with which the
    chosen setting runs once more over the window. `check`: the ladder goes by its own rungs, and full order is run over
    the window for nothing but the true errors. Throws CertificateError."""
    facts = climb.facts()
    steps = ladder.rungs(facts.structures, facts.dofs)
    first = next((one for one in steps if climb.run(one.setting, None) is not None), ladder.FULL)
    whole = climb.run(first.setting, None, must=True)
    climb.compare_moving(whole)
    end_time = whole.summary["end_time"]
    window = window if window else window_of(whole, climb.place(first.setting, None))
    if window is not None and window >= end_time:
        window = None
    found = _climb(climb, facts, steps[steps.index(first):], target, window,
                   not check and facts.cost * (window or end_time) <= budget)
    found.end_time = end_time
    if check:
        full = climb.run(ladder.FULL.setting, window, must=True)
        facts.cost = full.per_second()
        found.true = [climb.distance(one.outcome, full) for one in found.climbed]
    _add_step(climb, found)
    if finer:
        _add_mesh(climb, found, finer)
    _run_whole(climb, found)
    return found


def _climb(climb: Climb, facts: Facts, steps: list, target: float, window: float | None, affordable: bool):
    """Runs rung after rung until the fastest setting within the target is known; full order first where it is
    affordable."""
    top = []
    if affordable:
        top = [Climbed(ladder.FULL, climb.run(ladder.FULL.setting, window, must=True))]
        facts.cost = top[0].outcome.per_second()
    climbed, floor, found = [], {}, None
    best = facts.cost if top else math.inf  # wall time per second of motion of the fastest one within the target
    for rung in steps:
        if rung.modes is None and (top or not affordable):
            break
        if climbed and not _may_be_faster(climbed[-1].outcome, facts, best, found):
            break
        outcome = climb.run(rung.setting, window)
        if outcome is None:
            continue
        climbed.append(Climbed(rung, outcome))
        if len(climbed) == 2 or (len(climbed) == 1 and len(steps) < 3):
            floor = climb.noise_floor(rung.setting, window, outcome, facts.options)
        found = _judge(climb, facts, target, window, floor, climbed + top, bool(top))
        if found and found.climbed[found.chosen].rung.modes and found.confirmed and (
                top or len(climbed) > 2) and found.errors[found.chosen][ALL] <= max(target, found.floor_of()):
            _choose(climb, found)
            best = found.outcome.per_second()
    if found is None:
        outcome = climb.run(ladder.FULL.setting, window, must=True)
        found = _judge(climb, facts, target, window, floor, [Climbed(ladder.FULL, outcome)], True)
    if not found.tried:
        _choose(climb, found)
    return found


def _may_be_faster(last: Outcome, facts: Facts, best: float, found: Certificate | None) -> bool:
    """Whether a finer rung than the `last` one could take less than `best` wall time per second of motion: a step of it
    costs no less, so that it needs a longer one of those that are tried, and more of the target left for it than a rung
    has that lacks half of the target, or no more than the noise."""
    if found and found.tried:
        least = min(found.errors[one.rung][ALL] for one in found.tried if found.climbed[one.rung].rung.modes)
        if least <= max(0.5 * found.target, found.floor_of()):
            return False
    return last.per_second() * min(1.0, last.summary["time_step"] / (FASTER[0] * facts.time_step)) < best


def _judge(climb: Climb, facts: Facts, target: float, window: float | None, floor: dict, climbed: list,
           full: bool) -> Certificate | None:
    """The certificate as far as it goes, of the coarsest rung within the target; None of a single rung that is not full
    order."""
    if len(climbed) < 2 and not full:
        return None
    distances = climb.distances(climbed)
    least = {band: max((one[band] for one in floor.values()), default=0.0) for band in BAND_NAMES}
    told = {band: estimate.estimates(distances[band], least[band], full) for band in BAND_NAMES}
    errors = [{band: told[band][k].error for band in BAND_NAMES} for k in range(len(climbed))]
    good = _within(errors, full, max(target, least[ALL]))
    chosen = good[0] if good else len(climbed) - 1
    return Certificate(target, facts, window, 0.0, floor, climbed, errors, full, chosen, errors[chosen][ALL] <= target,
                       full or estimate.shrank(distances[ALL]), climbed[chosen].rung.setting,
                       climbed[chosen].outcome, parts={"reduction": errors[chosen]})


def _within(errors: list, full: bool, allowed: float) -> list:
    """Rungs of no larger error; the finest one has none beside it that would confirm it, unless it is full order."""
    return [k for k in range(len(errors) if full else len(errors) - 1) if errors[k][ALL] <= allowed]


def _choose(climb: Climb, found: Certificate) -> None:
    """Takes the fastest setting of the rungs within the target and the longer steps that it allows them; where no rung
    is within it, the finest."""
    allowed = max(found.target, found.floor_of())
    found.tried, best = [], None
    for k in _within(found.errors, found.full, allowed) or [found.chosen]:
        for one in _settings_of(climb, found, k, allowed, best.cost if best else math.inf):
            found.tried.append(one)
            best = one if best is None or one.cost < best.cost else best
    found.chosen, found.setting, found.outcome, found.parts = best.rung, best.setting, best.outcome, best.parts
    found.reached = best.error <= found.target


def _settings_of(climb: Climb, found: Certificate, k: int, allowed: float, best: float) -> list:
    """Rung k as it is, and with the mass of stiff members and fast coordinates scaled for the longest step that
    is allowed and could make it faster than `best` [s/s]."""
    rung = found.climbed[k]
    plain = Candidate(k, rung.rung.setting, rung.outcome, {"reduction": found.errors[k]})
    step = rung.outcome.summary["time_step"]
    for factor in FASTER:
        longer = factor * found.facts.time_step
        if longer < 1.1 * step or plain.cost * step / longer >= best:
            break
        setting = ladder.longer_step(rung.rung, found.facts.structures, factor, found.facts.time_step)
        outcome = climb.run(setting, found.window)
        if outcome is None or outcome.summary["time_step"] < 1.1 * step:
            continue
        scaled = Candidate(k, setting, outcome, {**plain.parts, "longer step": climb.distance(outcome, rung.outcome)})
        if scaled.error <= allowed:
            return [plain, scaled]
    return [plain]


def _add_step(climb: Climb, found: Certificate) -> None:
    """What the step of the chosen rung does, by half of it: contact makes the scheme of first order, so that the
    error is twice the difference."""
    rung = found.climbed[found.chosen]
    half = ladder.changed(rung.rung.setting, "half-step", "half the time step",
                          (("time_step", 0.5 * rung.outcome.summary["time_step"]),))
    outcome = climb.run(half, found.window)
    if outcome is not None:
        moved = climb.distance(outcome, rung.outcome)
        found.parts["step"] = {band: 2 * moved[band] for band in BAND_NAMES}


def _add_mesh(climb: Climb, found: Certificate, finer: tuple) -> None:
    """What the mesh does, by a finer one: the difference, times 4/3 where its elements are half as large and the error
    falls with their square."""
    rung = found.climbed[found.chosen].rung
    own = tuple((name, value.replace("/basis-", "/basis-finer-") if name.endswith("_modal_basis") else value)
                for name, value in rung.setting.changes)
    setting = Setting(f"{rung.setting.name}-finer", f"{rung.setting.what}, finer mesh", (*own, *finer))
    outcome = climb.run(setting, found.window, must=True)
    moved = climb.distance(outcome, found.climbed[found.chosen].outcome)
    found.parts["mesh"] = {band: 4 / 3 * moved[band] for band in BAND_NAMES}


def _run_whole(climb: Climb, found: Certificate) -> None:
    """The chosen setting over the whole scene; the errors of a window grow as its distance from the next rung does."""
    if found.window is None:
        return
    short, found.outcome = found.outcome, climb.run(found.setting, None, must=True)
    if found.climbed[found.chosen].rung.modes is None and "longer step" not in found.parts:
        return  # full order itself
    other = found.climbed[found.chosen - 1 if found.chosen else min(1, len(found.climbed) - 1)]
    if other.rung.modes is None or other.rung == found.climbed[found.chosen].rung:
        return
    beside = climb.run(other.rung.setting, None)
    if beside is None:
        return
    window, whole = climb.distance(short, other.outcome), climb.distance(found.outcome, beside)
    for name in ("reduction", "longer step"):
        if name in found.parts:
            found.parts[name] = {band: value * max(1.0, whole[band] / window[band]) if window[band] > 0 else value
                                 for band, value in found.parts[name].items()}
    found.reached = found.beside_full_order() <= found.target
