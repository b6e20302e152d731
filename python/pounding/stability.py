"""Stability of mats: sliding, overturning about each edge and flotation over time, from the resultant of the forces under a
structure; their worst instants, the path that a mat would slide, its settlement. Formulas are in docs/manual/review.md."""

import re
from dataclasses import dataclass

import numpy as np

from pounding import UserError
from pounding.results import Result, ResultError

FORCES = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
EDGES = ("x-", "x+", "y-", "y+")
CRITERIA = ("sliding", *(f"overturning {edge}" for edge in EDGES), "flotation")
WORST = 5  # instants that are kept of each criterion
APART = 0.1  # between two instants that are told apart, at least [s]
G = 9.80665  # [m/s2]
WATER = 1000.0 * 9.81  # weight of water unless the user gives the buoyancy [N/m3]
ROUND_OFF = 1e-9  # of the weight, with a side of the mat as its arm: what drives less drives nothing
ALL_HELD = 0.999  # part of the weight that forces under a structure carry at rest, at least, where nothing of it is clamped
CARRIED = 0.5  # and below which something else carries it
MOTIONS = ("settlement", "settlement at most", "stays moved")  # of a base
KEYS = ("friction", "passive", "buoyancy", "water", "edges", "level", "weight", "weight_at", "contact")


@dataclass(frozen=True)
class Given:
    """A mat as the user has it, named by its structure; None is found from the run. `passive`: resistance beside friction
    [N]; `buoyancy` [N], or `water`: its level [m]; `edges`: x and y of the underside's, low and high [m]; `level`: its
    elevation [m]; `weight` [N] and its place in plan [m], where the run has no gravity; `contact`: on which it stands."""

    name: str
    friction: float
    passive: float = 0.0
    buoyancy: float | None = None
    water: float | None = None
    edges: tuple | None = None
    level: float | None = None
    weight: float | None = None
    weight_at: tuple | None = None
    contact: str = ""


@dataclass(frozen=True)
class Mat:
    """What factors are made of: SI. `added`: weight that the run's own forces do not have [N]; `weight`: all of it, which
    acts at `weight_at` in plan; `mass` [kg] of it; `doubts`: lines about it."""

    name: str
    friction: float
    passive: float
    buoyancy: float
    edges: tuple
    level: float
    weight: float
    weight_at: tuple
    mass: float
    added: float
    doubts: tuple = ()

    @property
    def middle(self) -> tuple:
        return (self.edges[0] + self.edges[1]) / 2, (self.edges[2] + self.edges[3]) / 2


def read(reader) -> dict:
    """Name -> Given of the mats of a block. `reader`: fragility.study_file.Reader of the block. Throws UserError."""
    values = reader.values.get("mats")
    if not isinstance(values, dict) or not values:
        reader.fail("mats", "is no list of structures with what their mats have, as `mats: {tower: {friction: 0.5}}`")
    blocks = {str(name): type(reader)(block or {}, reader.path, ": ".join(filter(None, (reader.place, "mats", str(name)))), KEYS)
              for name, block in values.items()}
    return {name: _given(name, one) for name, one in blocks.items()}


def _given(name: str, one) -> Given:
    """A mat of its block."""
    def least(key: str, value: float | None) -> float | None:
        if value is not None and value < 0:
            one.fail(key, "is below 0")
        return value

    if "water" in one.values and "buoyancy" in one.values:
        one.fail("water", "is beside a buoyancy; give one of the two")
    edges = tuple(one.numbers("edges")) if "edges" in one.values else None
    if edges and (len(edges) != 4 or not (edges[0] < edges[1] and edges[2] < edges[3])):
        one.fail("edges", "is not x1, x2, y1, y2 of the mat's underside, x1 below x2 and y1 below y2")
    place = tuple(one.numbers("weight_at")) if "weight_at" in one.values else None
    if place and len(place) != 2:
        one.fail("weight_at", "is not x, y")
    return Given(name, least("friction", one.number("friction")), least("passive", one.number("passive", 0.0)),
                 least("buoyancy", one.optional("buoyancy")), one.optional("water"), edges, one.optional("level"),
                 least("weight", one.optional("weight")), place, str(one.values.get("contact", "")))


# What a run tells of its mats.

def facts_of(run: Result) -> dict:
    """Structure -> facts of its mat, from the result folder of a run: mass [kg], box, soil, whether anything holds it, forces
    under it about the origin at the start, and the scene's gravity downwards, and whether it was at rest under it."""
    told, options = run.summary, run.summary.get("options", {})
    rest = told.get("equilibrium", {}).get("structures", {})
    found = {}
    for name, one in told.get("structures", {}).items():
        soil = one.get("soil", {})
        gravity = str(options.get(f"{name}_gravity", options.get("gravity", "0")))
        numbers = [float(part) for part in gravity.split(",")]
        found[name] = {"mass": one.get("mass", 0.0), "extent": one.get("extent"), "sides": soil.get("size"), "centre": soil.get("centre"),
                       "held": bool(one.get("connectivity", {}).get("held_against_every_rigid_motion", True)),
                       "gravity": numbers[0] if len(numbers) == 1 else -numbers[-1],
                       "at_rest": name in rest, "clamped": one.get("dofs") != one.get("dofs_before_clamping"), "start": None}
        item = item_of(run, name)
        if item and len(run.history.get("time", [])):
            found[name]["start"] = resultants(run, item)[0].tolist()
    return found


def item_of(run: Result, structure: str) -> str:
    """Recorded force of the kind reactions on a structure; empty if there is none."""
    options = run.summary.get("options", {})
    names = dict.fromkeys(name.split(".")[0] for name in run.history.get("forces", []))
    return next((name for name in names if options.get(f"{name}_kind") == "reactions" and options.get(f"{name}_structure") == structure), "")


def about_origin(forces: np.ndarray, point) -> np.ndarray:
    """Forces and moments (samples, 6) about the origin, of those about a point [m]."""
    return np.concatenate([forces[:, :3], forces[:, 3:] + np.cross(np.asarray(point, float), forces[:, :3])], 1)


def resultants(run: Result, item: str) -> np.ndarray:
    """Forces and moments of the ground on a structure about the origin (samples, 6) [N, N m]."""
    forces = np.stack([run.force(f"{item}.{part}")[1] for part in FORCES], 1)
    return about_origin(forces, run.summary.get("moments_about", {}).get(item, (0.0, 0.0, 0.0)))


def resolve(given: Given, facts: dict, gravity: float | None, place: str) -> Mat:
    """A mat from what the user gives and a run tells. `gravity`: the user's [m/s2], for a scene without. Throws UserError,
    which begins with `place`."""
    def refuse(why: str):
        raise UserError(f"{place}: mats: {given.name}: {why}")

    if given.name not in facts:
        raise UserError(f"{place}: mats: {given.name} is no structure of the scene; it has {', '.join(facts)}")
    one = facts[given.name]
    if not one["held"]:
        refuse("nothing holds this structure: no clamp, soil or springs under it; a mat on a contact has its slip from single runs (contact)")
    edges, level = given.edges, given.level
    if edges is None:
        if not (one["sides"] and one["centre"]):
            refuse("nothing tells how large its mat is; give edges: [x1, x2, y1, y2]")
        (x, y), sides = one["centre"][:2], list(one["sides"]) * (3 - len(one["sides"]))
        edges = (x - sides[0] / 2, x + sides[0] / 2, y - sides[1] / 2, y + sides[1] / 2)
    box = one["extent"]
    if level is None:
        if not (one["centre"] or box):
            refuse("nothing tells the elevation of its underside; give level")
        level = one["centre"][2] if one["centre"] else box[0][2]
    elif box and not box[0][2] - (box[1][2] - box[0][2]) <= level <= box[0][2] + 1e-3:
        refuse(f"level {level:g} m is not that of an underside: nothing stands there, the structure reaches from {box[0][2]:g} to "
               f"{box[1][2]:g} m")
    area = (edges[1] - edges[0]) * (edges[3] - edges[2])
    buoyancy = given.buoyancy or 0.0
    if given.water is not None:
        buoyancy = WATER * area * max(0.0, given.water - level)
    weight, at, mass, added, doubts = _weight(given, one, gravity, edges, refuse)
    return Mat(given.name, given.friction, given.passive, buoyancy, tuple(edges), float(level), weight, at, mass, added, tuple(doubts))


def _weight(given: Given, facts: dict, gravity: float | None, edges: tuple, refuse) -> tuple:
    """Weight, its place in plan and its mass, the part of it that the run has not, and doubts."""
    middle = (edges[0] + edges[1]) / 2, (edges[2] + edges[3]) / 2
    if facts["gravity"] == 0:
        if given.weight is None and not gravity:
            refuse("the scene has no gravity, from which the force on the ground would come; give gravity: 9.81, or weight of the mat's all [N]")
        weight = given.weight if given.weight is not None else facts["mass"] * gravity
        doubts = [] if given.weight_at else [f"Doubt: mat {given.name}: the scene has no gravity: its weight of {weight:.4g} N is taken "
                                             "to act at the middle of the mat (weight_at says otherwise)."]
        if facts["clamped"] and given.weight is None:
            doubts.append(f"Doubt: mat {given.name}: nodes clamped to the ground count in its weight, and their inertia is in none of its factors.")
        return weight, given.weight_at or middle, facts["mass"] if given.weight is None else weight / (gravity or G), weight, doubts
    if given.weight is not None or given.weight_at:
        refuse("weight is that of the scene, which has gravity; leave weight and weight_at out")
    start = facts["start"]
    if not facts["at_rest"] or start is None:
        refuse("the scene's weight falls onto the ground at the start; give preload: static, so that it rests")
    whole = facts["mass"] * facts["gravity"]
    if not start[2] > CARRIED * whole:
        refuse(f"at rest the ground under it carries {start[2]:.4g} N of {whole:.4g} N; what else does, a contact? Its factors are not "
               "those of these forces")
    doubts = []
    if start[2] < ALL_HELD * whole:
        doubts.append(f"Doubt: mat {given.name}: {100 * (1 - start[2] / whole):.2g} % of the mass are clamped to the ground, or stand on "
                      "something else; weight and inertia of that part are in none of its factors.")
    return start[2], (-start[4] / start[2], start[3] / start[2]), start[2] / facts["gravity"], 0.0, doubts


# Factors over time.

def factors(forces: np.ndarray, mat: Mat) -> tuple:
    """Factors of CRITERIA at each sample (samples, criteria), and the numbers that they are made of (samples, NUMBERS).
    `forces`: of the ground on the structure, about the origin (samples, 6). A factor of nothing that drives is infinite."""
    x1, x2, y1, y2 = mat.edges
    (xw, yw), (xm, ym) = mat.weight_at, mat.middle
    normal = forces[:, 2] + mat.added
    moment = forces[:, 3:] - np.cross(np.array([xw, yw, mat.level]), forces[:, :3])
    across = np.hypot(forces[:, 0], forces[:, 1])
    held = mat.friction * np.maximum(normal - mat.buoyancy, 0.0) + mat.passive
    arms = np.array([[xw - x1, xm - x1], [x2 - xw, x2 - xm], [yw - y1, ym - y1], [y2 - yw, y2 - ym]])
    righting = np.maximum(normal[:, None] * arms[:, 0] - mat.buoyancy * arms[:, 1], 0.0)
    turning = np.stack([moment[:, 1], -moment[:, 1], -moment[:, 0], moment[:, 0]], 1)
    floating = np.full(len(normal), mat.buoyancy)
    resisting = np.column_stack([held, righting, normal])
    driving = np.column_stack([across, turning, floating])
    driving[driving < ROUND_OFF * mat.weight * np.array([1.0, *[max(x2 - x1, y2 - y1)] * len(EDGES), 1.0])] = 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        found = np.where(driving > 0, resisting / driving, np.inf)
    return np.maximum(found, 0.0), np.stack([resisting, driving], 2)


def worst(time: np.ndarray, values: np.ndarray, count: int = WORST, apart: float = APART) -> np.ndarray:
    """Numbers of the samples of the least local minima of a history, the least first, each `apart` [s] from those before it or
    farther; of equal neighbours the first one counts, and infinite values none."""
    before, after = np.r_[np.inf, values[:-1]], np.r_[values[1:], np.inf]
    places = np.flatnonzero(np.isfinite(values) & (values < before) & (values <= after))
    taken = []
    for place in places[np.argsort(values[places], kind="stable")]:
        if all(abs(time[place] - time[other]) >= apart * (1 - 1e-9) for other in taken):
            taken.append(int(place))
        if len(taken) == count:
            break
    return np.array(taken, int)


def slid(time: np.ndarray, forces: np.ndarray, mat: Mat) -> float:
    """Path [m] of the mat by Newmark's sliding block: the structure, rigid from the mat on, is driven by the force that the run
    puts on it and braked by friction and passive resistance, which the run has not."""
    mass = mat.mass
    held = mat.friction * np.maximum(forces[:, 2] + mat.added - mat.buoyancy, 0.0) + mat.passive
    beyond = np.flatnonzero(np.hypot(forces[:, 0], forces[:, 1]) > held)
    if not len(beyond):
        return 0.0
    steps = np.diff(time)
    push = -(forces[1:, :2] + forces[:-1, :2]) / 2 * (steps / mass)[:, None]
    brake = (held[1:] + held[:-1]) / 2 * steps / mass
    path, vx, vy = 0.0, 0.0, 0.0
    number, last = max(int(beyond[0]) - 1, 0), len(steps)
    while number < last:
        wx, wy = vx + push[number, 0], vy + push[number, 1]
        speed = float(np.hypot(wx, wy))
        left = max(0.0, 1.0 - brake[number] / speed) if speed > 0 else 0.0
        wx, wy = wx * left, wy * left
        path += steps[number] * float(np.hypot(vx + wx, vy + wy)) / 2
        vx, vy = wx, wy
        number += 1
        if vx == vy == 0.0:  # at rest until it is driven again
            place = int(np.searchsorted(beyond, number))
            if place == len(beyond):
                break
            number = max(number, int(beyond[place]) - 1)
    return path


@dataclass(frozen=True)
class Found:
    """Of a mat in one run: of each criterion its worst instants (criteria, WORST): number of the sample, or -1 where there are
    fewer; their times [s], factors, what resists and drives [N, N m], and the forces about the mat's middle at its level
    (criteria, WORST, 6); `slid`: path by Newmark's block [m]."""

    time: np.ndarray
    factor: np.ndarray
    numbers: np.ndarray  # (criteria, WORST, 2)
    forces: np.ndarray
    slid: float


def found(time: np.ndarray, forces: np.ndarray, mat: Mat) -> Found:
    """The worst instants of a run, whose forces are about the origin."""
    values, numbers = factors(forces, mat)
    middle = about_origin(forces, -np.array([*mat.middle, mat.level]))
    shape = (len(CRITERIA), WORST)
    one = Found(np.full(shape, np.nan), np.full(shape, np.inf), np.full((*shape, 2), np.nan), np.full((*shape, 6), np.nan), slid(time, forces, mat))
    for c in range(len(CRITERIA)):
        at = worst(time, values[:, c])
        for array, source in ((one.time, time[at]), (one.factor, values[at, c]), (one.numbers, numbers[at, c]), (one.forces, middle[at])):
            array[c, :len(at)] = source
    return one


def instant_rows(mat: Mat, one: Found, more: dict | None = None, count: int = WORST) -> list:
    """A row for each worst instant with its numbers."""
    rows = []
    for c, criterion in enumerate(CRITERIA):
        for rank in range(min(count, WORST)):
            if not np.isfinite(one.factor[c, rank]):
                continue
            rows.append({"mat": mat.name, "criterion": criterion, **(more or {}), "rank": rank + 1, "factor": float(one.factor[c, rank]),
                         "time [s]": float(one.time[c, rank]), "resisting [N, N m]": float(one.numbers[c, rank, 0]),
                         "driving [N, N m]": float(one.numbers[c, rank, 1]), "weight [N]": mat.weight, "buoyancy [N]": mat.buoyancy,
                         **{f"{part} [{'N' if part[0] == 'F' else 'N m'}]": float(value) + (mat.added if part == "Fz" else 0.0)
                            for part, value in zip(FORCES, one.forces[c, rank])}})
    return rows


# A single run.

def of_run(run: Result, given: dict, gravity: float | None, place: str) -> list:
    """(Mat or None, Found or None, motion) of each mat of a run; motion: path that it slid in its contact with friction
    [m], settlement at the end and at most, and horizontal displacement that stays [m], of those that were recorded. Throws
    UserError."""
    facts, out = facts_of(run), []
    for name, one in given.items():
        item = item_of(run, name)
        if not item and one.contact and name in facts:
            out.append((None, None, _motion(run, one, place)))
            continue
        if not item and facts.get(name, {}).get("held"):
            raise UserError(f"{place}: mats: {name}: the run recorded no force under it; give its scene `forces: base` and "
                            f"`base: {{structure: {name}, kind: reactions}}`")
        mat = resolve(one, facts, gravity, place)
        out.append((mat, found(run.history["time"], resultants(run, item), mat), _motion(run, one, place)))
    return out


def _motion(run: Result, given: Given, place: str) -> dict:
    motion = {}
    if given.contact:
        if given.contact not in run.contacts:
            raise UserError(f"{place}: mats: {given.name}: {given.contact} is no contact of the run; it has {', '.join(run.contacts) or 'none'}")
        if "slip" not in run.impacts:
            raise ResultError(f"{run.folder}: no impacts.csv with slips")
        motion["slid"] = slip_of(run, given.contact)
    return motion | dict(zip(MOTIONS, base_motion(run, given.name)))


def slip_of(run: Result, contact: str) -> float:
    """Slips of the episodes of a contact, added up [m]."""
    return float(np.asarray(run.impacts["slip"])[np.asarray(run.impacts["contact"], str) == contact].sum())


def base_motion(run: Result, structure: str) -> list:
    """MOTIONS of a base [m] since the start; empty where none was recorded."""
    ways = [run.base(structure, way) for way in "xyz"]
    if not all(ways):
        return []
    x, y, z = (values - values[0] for _, values in ways)
    return [float(-z[-1]), float(-z.min()), float(np.hypot(x[-1], y[-1]))]


def tables_of(found_of: list, names: list, asked: float) -> tuple:
    """Rows of the least factors, and of the worst instants, of the mats of a run."""
    rows, instants = [], []
    for name, (mat, one, motion) in zip(names, found_of):
        for c, criterion in enumerate(CRITERIA if mat else ()):
            if np.isfinite(one.factor[c, 0]):
                rows.append({"mat": name, "criterion": criterion, "asked": asked, "least": float(one.factor[c, 0]), "time [s]": float(one.time[c, 0]),
                             "holds": "yes" if one.factor[c, 0] >= asked else "no"})
        more = motion | ({"slides by Newmark's block": one.slid} if one else {})
        rows += [{"mat": name, "criterion": key, "value [m]": value} for key, value in more.items()]
        instants += instant_rows(mat, one) if mat else []
    return rows, instants


def safe_name(structure: str) -> str:
    """Name of the recorded force of a mat in the scenes of a study."""
    return "mat_" + re.sub(r"\W", "_", structure)
