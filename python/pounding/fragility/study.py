"""The study file of run/fragility: which keys it may have, what they mean, and what is wrong with them."""

import csv
import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from pounding import UserError
from pounding.fragility import DISTRIBUTIONS, Variable
from pounding.mats import Coherence
from pounding.motion_rules import read_rules
from pounding.motion_signals import MotionError
from pounding.results import DIRECTIONS

from . import spans
from .both_orders import FULL, REDUCED, BothOrders, read as read_both_orders
from .coherence import Moved, read as read_coherence
from .matching import Matching, read as read_matching
from .stability import Stability, read as read_stability
from .struck import Struck, read as read_struck
from .study_file import Reader, beside, given_options, load
from .torsion import Torsion, read as read_torsion

KEYS = ("title", "scene", "output", "options", "reduction", "seed", "samples", "confidence", "motions", "levels",
        "motion_rules", "match", "gaps", "apart", "joints", "coherence", "soils", "states", "submittal", "uncertainty", "exchange", "field_factors",
        "factors", "capacities", "full_order", "frequencies", "dampings", "show", "elevations", "spans", "stability",
        "struck", "accidental_torsion")
DAMPINGS = (0.02, 0.03, 0.04, 0.05, 0.07)
SYNTHETIC = {"duration": "25", "envelope": "2,15"}
RECORDED = {"unit": "auto", "time_step": "0", "column": "0"}
WIDEST, WIDE = 5.0, 0.5  # joints that are refused, and doubted [m]
SHALLOW, STRONG = 0.5, 30.0  # largest levels that are doubted [m/s2]
G = 9.80665  # [m/s2]
MOST_MEMBERS = 1000000
FACTOR = re.compile(r"\w+_(stiffness|damping)_factor")


@dataclass(frozen=True)
class Axis:
    """The motions along one axis: `records`, or synthetic ones that match `target`, told apart by `seeds`. `ratio`: its
    peak over that of the level; `options`: more options of the motion, as duration. Of records that the study matched how
    they were (`matched`, their peaks in place of the ratio), and what they are `made_of`. `ratios`: of each motion its own."""

    records: tuple = ()
    target: str = ""
    seeds: tuple = ()
    ratio: float = 1.0
    options: tuple = ()
    matched: tuple = ()
    made_of: str = ""
    ratios: tuple = ()

    def ratio_of(self, motion: int) -> float:
        """Peak of a motion over that of the level."""
        return self.matched[motion]["peak"] if self.matched else self.ratios[motion] if self.ratios else self.ratio

    def name_of(self, motion: int) -> str:
        """Of a record its file without folder and ending, of a synthetic motion its seed."""
        return Path(self.records[motion]).stem if self.records else str(self.seeds[motion])

    @property
    def kind(self) -> str:
        """Its motions in words."""
        return self.made_of or ("records" if self.records else f"synthetic motions to {Path(self.target).name}")

    @property
    def motions(self) -> tuple:
        """Its records, or the seeds of its synthetic motions."""
        return self.records or self.seeds

    @property
    def understood(self) -> dict:
        """Options by which the motion is read or made, whatever the scene says of its own."""
        return {**(SYNTHETIC if self.target else RECORDED), **dict(self.options)}


@dataclass(frozen=True)
class Joint:
    """A contact: by how much its gap differs from the nominal one, `shape` [m] (one value, two or four), and a
    deviation that is drawn, of all values alike. `field`: standard deviation and length of correlation [m] of a random
    part over the face, another one in each sample; empty: none. `survey`: file of the gaps as they were measured, of
    which `shape` has the least then, and the gaps of the study are wider or narrower than these; `closing`: elevation and
    static closing [m] taken off them."""

    shape: tuple = (0.0,)
    deviation: Variable | None = None
    field: tuple = ()
    survey: str = ""
    closing: tuple = ()

    @property
    def column(self) -> str:
        """Option by which members have joints of their own."""
        return "static_closing" if self.survey else "gap"

    def text(self, width: float) -> str:
        """Value of the option in a joint that is wider by so much [m] than its shape."""
        if self.survey:
            return ",".join(f"{z:g}:{closing - width:.9g}" for z, closing in self.closing)
        return ",".join(f"{max(0.0, width + one):.9g}" for one in self.shape)


@dataclass(frozen=True)
class Capacity:
    """What a floor spectrum must not exceed [m/s2] at a frequency of the band [Hz]."""

    probe: str
    direction: str
    band: tuple
    damping: float
    acceleration: float

    @property
    def name(self) -> str:
        return (f"{self.probe} {self.direction} above {self.acceleration:g} m/s2 in {self.band[0]:g}-{self.band[1]:g} "
                f"Hz, {100 * self.damping:g} %")


@dataclass
class Study:
    path: Path
    scene: Path
    title: str
    output: Path
    options: dict
    reduction: dict
    seed: int
    samples: int
    confidence: float
    axes: dict  # "x" -> Axis
    correlation: float  # below which motions that act together are
    between: bool  # the limit holds between samples as well
    wanted: int  # motions to be chosen from the first seed on; 0: those that are given
    levels: list  # peak ground accelerations [m/s2]
    gaps: list  # nominal [m]
    apart: float  # of the runs without pounding [m]
    joints: dict  # contact -> Joint
    exchange: bool  # each member with a joint is run once more in the joint of the next sample
    field_factors: list  # pairs of factors on deviation and length of the fields, of joints beside the study's own
    factors: list  # Variables, whose names are options
    capacities: list
    share: float  # of the members that are repeated at full order
    full_options: dict
    noise: float  # part by which their shaking is disturbed
    both: BothOrders | None  # samples at both orders
    frequencies: list = field(default_factory=list)
    dampings: list = field(default_factory=list)
    show: dict = field(default_factory=dict)
    named: dict = field(default_factory=dict)  # `soils`, `states` and `submittal` as the file has them
    uncertainty: float | None = None  # beta_U of capacities, given by the user
    rules: Path | None = None  # table that judges the motions
    matching: Matching | None = None  # of the motions to its targets
    coherence: Coherence | None = None  # of the ground under mats that move apart
    coherent_too: bool = False  # whether samples are run on coherent ground beside it
    moved: Moved | None = None  # these as supports, once their motions are made
    elevations: list | None = None  # between bands of the table of the joint [m]; None: those that suit its pairs
    stability: Stability | None = None  # of the mats
    struck: Struck | None = None  # places whose pressure is asked for
    torsion: Torsion = Torsion()  # accidental, on the closings

    @property
    def motion_count(self) -> int:
        return len(next(iter(self.axes.values())).motions)

    @property
    def orders(self) -> dict:
        """Options of each order in which members may run, by its name: the reduction, those between, full order."""
        between = self.both.between if self.both else {}
        return {REDUCED: self.reduction, **{name: {**self.reduction, **one} for name, one in between.items()}, FULL: self.full_options}

    @property
    def is_surveyed(self) -> bool:
        return any(joint.survey for joint in self.joints.values())

    def width_told(self, width: float) -> str:
        """How wide a joint must be, or by how much wider it must be or narrower it may be than surveyed."""
        if not self.is_surveyed:
            return f"must be as wide as {1e3 * width:.3g} mm"
        if width >= 0:
            return f"must be {1e3 * width:.3g} mm wider than surveyed"
        return f"may be {1e3 * -width:.3g} mm narrower than surveyed"

    def joint_named(self, gap: float) -> str:
        """A joint of the study in a sentence."""
        if not self.is_surveyed:
            return f"joint of {1e3 * gap:g} mm"
        return f"joint as surveyed{f' and {1e3 * gap:g} mm wider' if gap else ''}"

    @property
    def width_title(self) -> str:
        """Heading of the widths that a study gives and finds: changes, where joints were surveyed."""
        return "change of the joint as surveyed" if self.is_surveyed else "nominal joint"

    @property
    def variables(self) -> list:
        return self.factors + [joint.deviation for joint in self.joints.values() if joint.deviation]

    def deviations(self, drawn: np.ndarray) -> np.ndarray:
        """Of the joints (samples, joints) [m], of what was drawn of the variables (samples, variables)."""
        names = [one.name for one in self.variables]
        return np.stack([drawn[:, names.index(f"{name}_gap")] if joint.deviation else np.zeros(len(drawn))
                         for name, joint in self.joints.items()], 1)

    def built(self, drawn: np.ndarray) -> np.ndarray:
        """Least width of the joints at a nominal gap of 0 (samples, joints) [m]."""
        return self.deviations(drawn) + np.array([min(joint.shape) for joint in self.joints.values()])


def standard_frequencies() -> list:
    """301 from 0.1 to 100 Hz, evenly spaced in their logarithm, and on to 400 Hz [Hz]."""
    return [float(f"{0.1 * 10 ** (k / 100):.6g}") for k in range(361)] + [400.0]


def _variable(reader: Reader, name: str) -> Variable:
    kind = reader.values.get("distribution", "normal")
    if kind not in DISTRIBUTIONS:
        reader.fail("distribution", f"is none of {', '.join(DISTRIBUTIONS)}")
    centre_key, spread_key = ("median", "cov") if kind == "lognormal" else ("mean", "deviation")
    wrong = [key for key in ("median", "mean", "cov", "deviation")
             if key in reader.values and key not in (centre_key, spread_key)]
    if wrong:
        reader.fail(wrong[0], f"goes with another distribution; {kind} has {centre_key} and {spread_key}")
    factor = bool(FACTOR.fullmatch(name))
    centre = reader.number(centre_key, 1.0 if factor else 0.0, 0.0 if kind == "lognormal" or factor else None)
    return Variable(name, kind, centre, reader.number(spread_key, None, 0.0))


SPREAD = ("distribution", "median", "mean", "cov", "deviation")
MOTION = ("records", "target", "seeds", "ratio", "options")


def _axis(reader: Reader, name: str) -> Axis:
    one = reader.part(name, MOTION)
    records, target = one.values.get("records"), one.values.get("target")
    if (records is None) == (target is None):
        raise UserError(f"{reader.path}: motions: {name} needs either records or a target")
    options = one.options("options")
    ratios = tuple(one.numbers("ratio", None, 0.0)) if isinstance(one.values.get("ratio"), list) else ()
    ratio = ratios[0] if ratios else one.number("ratio", 1.0, 0.0)
    if records is not None:
        if not isinstance(records, list) or not all(isinstance(item, str) for item in records):
            one.fail("records", "is not a list of files")
        paths = tuple(beside(reader.path, item) for item in records)
        missing = [item for item in paths if not Path(item).is_file()]
        if missing:
            raise UserError(f"{reader.path}: motions: {name}: {missing[0]}: no such file")
        if ratios and len(ratios) != len(paths):
            one.fail("ratio", f"are {len(ratios)} of {len(paths)} records")
        return Axis(paths, "", (), ratio, tuple(options.items()), ratios=ratios)
    if ratios:
        one.fail("ratio", "is one for all motions to a target; a list of them goes with records")
    path = beside(reader.path, str(target))
    if not Path(path).is_file():
        raise UserError(f"{reader.path}: motions: {name}: {path}: no such file")
    seeds = one.numbers("seeds", [], -1) if one.values.get("seeds") is not None else []
    if any(not seed.is_integer() for seed in seeds) or len(set(seeds)) < len(seeds):
        one.fail("seeds", "is not a list of different whole numbers")
    return Axis((), path, tuple(int(seed) for seed in seeds), ratio, tuple(options.items()))


def read_motions(reader: Reader) -> tuple:
    """Axes, the limit of correlation, whether it holds between samples, and how many motions are to be chosen."""
    motions = reader.part("motions", ("x", "y", "z", "correlation", "between_samples", "choose"))
    axes = {name: _axis(motions, name) for name in DIRECTIONS if name in motions.values}
    if not axes:
        raise UserError(f"{reader.path}: motions has no axis x, y or z")
    counts = {name: len(axis.motions) for name, axis in axes.items() if axis.motions}
    wanted = motions.whole("choose", 0, 0)
    if wanted and counts:
        motions.fail("choose", "goes with targets without seeds, from which it takes the first independent ones")
    if not wanted and (len(counts) < len(axes) or len(set(counts.values())) > 1):
        raise UserError(f"{reader.path}: motions: every axis needs as many records or seeds as the others, or "
                        "`choose` says how many synthetic motions are wanted")
    return axes, motions.number("correlation", 0.16, 0.0), motions.flag("between_samples"), wanted, wanted or next(iter(counts.values()))


def soils_of(reader: Reader):
    """The block `soils`, in the study or in a file of its own, as run/column writes it."""
    values = reader.values.get("soils")
    if not isinstance(values, str):
        return values
    path = Path(beside(reader.path, values))
    found = load(path)
    if not isinstance(found, dict) or set(found) != {"soils"}:
        raise UserError(f"{path}: is no file with a block `soils` and nothing else")
    return found["soils"]


def _joints(reader: Reader) -> dict:
    values = reader.values.get("joints")
    if not isinstance(values, dict) or not values:
        raise UserError(f"{reader.path}: joints is missing: the contacts whose gaps the study sets, as "
                        "`joints: {roof: {}}`")
    found = {}
    for name in values:
        one = Reader(values[name] or {}, reader.path, f"joints: {name}", ("shape", "deviation", "field", "survey", "static_closing"))
        shape = tuple(one.numbers("shape", [0.0]))
        if len(shape) not in (1, 2, 4):
            one.fail("shape", "has neither one value nor two or four")
        survey, closing = _survey(one)
        if survey:
            shape = (min(least for _, least in survey_points(one, survey, name)) - max(taken for _, taken in closing),)
        drawn = _variable(one.part("deviation", SPREAD), f"{name}_gap") if one.values.get("deviation") else None
        found[name] = Joint(shape, drawn, _field(one), survey, closing)
    if len({bool(joint.survey) for joint in found.values()}) > 1:
        raise UserError(f"{reader.path}: joints: gaps are widths of joints by drawing and changes of surveyed ones; give all of "
                        "them a survey, or none")
    return found


def _survey(one: Reader) -> tuple:
    """File of a survey, and elevations with their static closing."""
    if one.values.get("survey") is None:
        if one.values.get("static_closing") is not None:
            one.fail("static_closing", "goes with a survey; of a joint by drawing it is an option of the scene")
        return "", ()
    if one.values.get("shape") is not None:
        one.fail("shape", "is that of the survey; leave one of the two out")
    path = beside(one.path, str(one.values["survey"]))
    if not Path(path).is_file():
        one.fail("survey", "is no file")
    try:
        points = [tuple(map(float, point.split(":"))) for point in str(one.values.get("static_closing", "0:0")).split(",")]
    except ValueError:
        points = [()]
    if any(len(point) != 2 for point in points):
        one.fail("static_closing", "is not elevation:closing between commas")
    return path, tuple(points)


def survey_points(one: Reader, path: str, contact: str) -> list:
    """Elevation and gap of the points of a contact in a survey [m]; the program checks the rest of the file."""
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            lines = [line for line in file if line.strip() and not line.startswith("#")]
        separator = ";" if ";" in lines[0] else ","
        found = [(float(row["z"]), float(row["gap"])) for row in csv.DictReader(lines, delimiter=separator, skipinitialspace=True)
                 if row.get("contact", contact).strip() == contact]
    except (OSError, ValueError, KeyError, TypeError, IndexError, AttributeError):
        return one.fail("survey", "is no table of points with the columns x, y, z and gap")
    return found or one.fail("survey", f"has no point of contact {contact}")


def _field(reader: Reader) -> tuple:
    if not reader.values.get("field"):
        return ()
    one = reader.part("field", ("deviation", "length"))
    found = one.number("deviation", None, 0.0), one.number("length", None, 0.0)
    if not all(found):
        one.fail("deviation" if not found[0] else "length", "is not above 0")
    return found


def _field_factors(reader: Reader, joints: dict) -> list:
    found = []
    for number, pair in enumerate(reader.entries("field_factors"), 1):
        one = Reader({"pair": pair}, reader.path, f"field_factors, number {number}", ("pair",))
        values = tuple(one.numbers("pair", None, 0.0))
        if len(values) != 2 or values == (1.0, 1.0):
            one.fail("pair", "is not two factors, on deviation and length, that change a field")
        found.append(values)
    if found and not any(joint.field for joint in joints.values()):
        reader.fail("field_factors", "makes no difference: no joint has a field")
    if len(set(found)) < len(found):
        reader.fail("field_factors", "has a pair twice")
    return found


def _factors(reader: Reader) -> list:
    values = reader.values.get("factors") or {}
    if not isinstance(values, dict):
        reader.fail("factors", "is no list of factors")
    for name in values:
        if not FACTOR.fullmatch(str(name)):
            raise UserError(f"{reader.path}: factors: {name} is neither <structure>_stiffness_factor nor "
                            "<structure>_damping_factor")
    return [_variable(Reader(one or {}, reader.path, f"factors: {name}", SPREAD), name)
            for name, one in values.items()]


def _capacities(reader: Reader, frequencies: list, dampings: list) -> list:
    found = []
    for number, one in enumerate(reader.entries("capacities"), 1):
        part = Reader(one, reader.path, f"capacities, number {number}",
                       ("probe", "direction", "band", "damping", "acceleration"))
        band, damping = part.increasing("band", [frequencies[0], frequencies[-1]]), part.one_of("damping", dampings, dampings[0])
        if len(band) != 2 or not any(band[0] <= f <= band[1] for f in frequencies):
            part.fail("band", "is not two frequencies with one of the study's between them")
        if part.values.get("direction") not in DIRECTIONS:
            part.fail("direction", "is not x, y or z")
        found.append(Capacity(str(part.values.get("probe", "")), part.values["direction"], tuple(band), damping,
                              part.number("acceleration", None, 0.0)))
    return found


def _motion_rules(reader: Reader) -> Path | None:
    """The table of rules on motions, if there is one; what is wrong with it is told at once."""
    if reader.values.get("motion_rules") is None:
        return None
    table = reader.path.parent / str(reader.values["motion_rules"])
    try:
        read_rules(table)
    except MotionError as error:
        raise UserError(f"{reader.path}: motion_rules: {error}") from error
    return table


def _show(reader: Reader, gaps: list, levels: list) -> dict:
    one = reader.part("show", ("gap", "level", "channel", "frequencies"))
    for key, known in (("gap", gaps), ("level", levels)):
        one.one_of(key, known, known[0])
    return one.values


def own_gap(study: Study) -> float | None:
    """The nominal gap of the study that its scene has: that of a joint whose gap the scene or the study's options give."""
    options = {**given_options(study.scene), **study.options}
    for name, joint in study.joints.items():
        try:
            values = [float(text) for text in options[f"{name}_gap"].split(",")]
        except (KeyError, ValueError):
            continue
        nominal = sum(values) / len(values) - sum(joint.shape) / len(joint.shape)
        same = [gap for gap in study.gaps if abs(gap - nominal) <= 1e-6 + 1e-3 * gap]
        if same:
            return same[0]
    return None


def check_names(study: Study, probes: list, contacts: list) -> None:
    """Throws UserError where the study speaks of probes and contacts that the scene has not."""
    for name in study.joints:
        if name not in contacts:
            raise UserError(f"{study.path}: joints: {name} is no contact of the scene; it has "
                            f"{', '.join(contacts) or 'none'}")
    for name in study.struck.strengths.own if study.struck else ():
        if name not in contacts:
            raise UserError(f"{study.path}: struck: contacts: {name} is no contact of the scene; it has "
                            f"{', '.join(contacts) or 'none'}")
    for one in study.capacities:
        if one.probe not in probes:
            raise UserError(f"{study.path}: capacities: {one.probe!r} is no probe of the scene; it has "
                            f"{', '.join(probes) or 'none'}")
    channels = [f"{probe} {way}" for probe in probes for way in DIRECTIONS]
    if study.show.get("channel", channels[0] if channels else None) not in channels:
        raise UserError(f"{study.path}: show: channel: {study.show.get('channel')!r} is none of the scene's "
                        f"{', '.join(channels) or 'probes, of which there are none'}")


def check_orders(study: Study) -> None:
    """Throws UserError where the study has too few samples for those that it asks for at full order."""
    complaint = study.both.complaint(study.samples) if study.both else ""
    if complaint:
        raise UserError(f"{study.path}: full_order: {complaint}")


def doubts(study: Study) -> list:
    """What may be meant otherwise: a line each."""
    found, low, high = [], study.levels[0], study.levels[-1]
    if high < SHALLOW:
        found.append(f"levels: {low:g} to {high:g} are m/s2, {high / G:.2g} g at most; {high:g} g would be "
                     f"{high * G:.3g}.")
    if high > STRONG:
        found.append(f"levels: {high:g} m/s2 are {high / G:.2g} g; are they cm/s2?")
    if study.gaps[-1] > WIDE:
        found.append(f"gaps: a joint of {study.gaps[-1]:g} m; are gaps in m?")
    return found


def read(path: Path) -> Study:
    """The study of a file. Throws UserError."""
    values = load(path)
    if isinstance(values, dict) and set(values) == {"fragility"}:
        values = values["fragility"]
    reader = Reader(values, path, "", KEYS)
    scene = path.parent / str(reader.values.get("scene", ""))
    if not scene.is_file():
        raise UserError(f"{path}: scene: {scene}: no such file")
    axes, limit, between, wanted, motions = read_motions(reader)
    table = _motion_rules(reader)
    frequencies = reader.increasing("frequencies", standard_frequencies())
    dampings = reader.increasing("dampings", DAMPINGS)
    full = reader.part("full_order", ("share", "options", "noise", "samples", "accuracy", "pilot", "between"))
    gaps, levels = reader.increasing("gaps", None, -1e-12), reader.increasing("levels")
    if gaps[-1] > WIDEST:
        reader.fail("gaps", f"has a joint of {gaps[-1]:g} m, above {WIDEST:g} m: gaps are in m, 40 mm are 0.04")
    samples = reader.whole("samples", motions, 2)
    joints, exchange = _joints(reader), reader.flag("exchange")
    if exchange and not any(joint.deviation or joint.field for joint in joints.values()):
        reader.fail("exchange", "makes no difference: no joint has a deviation or a field")
    field_factors = _field_factors(reader, joints)
    options = reader.options("options")
    options |= spans.read(reader, {**given_options(scene), **options})
    members = samples * (len(levels) + len(gaps) * (1 + exchange) * (len(levels) + len(field_factors)))
    if members > MOST_MEMBERS:
        reader.fail("samples", f"makes {members} members, more than {MOST_MEMBERS}")
    return Study(
        path, scene.resolve(), str(reader.values.get("title", f"Study {path.stem}")),
        Path(str(reader.values.get("output", Path("results") / f"fragility-{path.stem}"))), options,
        reader.options("reduction"), reader.whole("seed", 1, 0), samples,
        reader.number("confidence", 0.95, 0.0, 1.0), axes, limit, between, wanted, levels, gaps,
        reader.number("apart", max(1.0, 20 * gaps[-1]), gaps[-1]), joints, exchange, field_factors, _factors(reader),
        _capacities(reader, frequencies, dampings), full.number("share", 0.0, -1e-12, 1.0 + 1e-12),
        full.options("options"), full.number("noise", 1e-3, 0.0), read_both_orders(full, exchange), frequencies, dampings,
        _show(reader, gaps, levels), {**{key: reader.values.get(key) for key in ("states", "submittal")}, "soils": soils_of(reader)},
        reader.optional("uncertainty", 0.0), table,
        read_matching(reader, table, limit), *read_coherence(reader),
        elevations=reader.increasing("elevations", None, -1e9) if "elevations" in reader.values else None,
        stability=read_stability(reader, levels, {**given_options(scene), **reader.options("options")}.get("structures", "")),
        struck=read_struck(reader, levels), torsion=read_torsion(reader))
