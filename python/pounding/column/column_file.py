"""The file of run/column: layers, half-space, curves, motions and mats, and what is wrong with them."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pounding.fragility.study import SHALLOW, STRONG, read_motions
from pounding.fragility.study_file import Reader, load

from .curves import ColumnError, read as read_curve
from .iteration import Rule, Soil
from .waves import Column, Given

KEYS = ("layers", "halfspace", "curves", "motions", "level", "input", "mats", "cv", "ratio", "tolerance", "iterations", "thickest")
LAYER = ("name", "thickness", "vs", "g", "density", "damping", "curve", "cv")
# Least and most of a number that can be meant, and the unit in which others may be.
RANGES = {"thickness": (1e-3, 3e3, "m"), "vs": (10, 1e4, "m/s; in km/s"), "g": (1e5, 1e12, "Pa; in MPa"),
          "density": (500, 5e3, "kg/m3; in t/m3"), "damping": (0, 0.5, "a ratio; in %"), "cv": (0, 5, "a ratio; in %")}
WAY = 0.005  # of a wave through a sublayer [s]
AS = ("outcrop", "within")
ESTIMATES = ("best", "upper", "lower")


@dataclass(frozen=True)
class Mats:
    """Where mats lie [m below the surface], what stands for the ground there, `outcrop` or `within`, and how their soil is told:
    the depth over which a half-space of the program is the mean [m], its Poisson's ratio, structures, and structure -> name of
    the soil tables with {} for the estimate."""

    depth: float = 0.0
    outcrop: bool = True
    over: float = 0.0
    poisson: float = 0.0
    structures: tuple = ()
    tables: tuple = ()


@dataclass(frozen=True)
class Ground:
    """What a file has. `soil`: best estimate, in sublayers; `cv`: per sublayer and half-space; `axes`: as those of a study;
    `level`: peak of the given motion [m/s2], 0 as recorded; `given`, `at_mats`: entries of the column."""

    path: Path
    soil: Soil
    cv: np.ndarray
    axes: dict
    level: float
    given: Given
    mats: Mats
    at_mats: Given
    rule: Rule

    def estimates(self) -> dict:
        """Name -> soil: best, G times 1 + cv and G over 1 + cv at small strain."""
        factors = dict(zip(ESTIMATES, (np.ones_like(self.cv), 1 + self.cv, 1 / (1 + self.cv))))
        column = self.soil.column
        return {name: Soil(column.with_(factor * column.modulus, column.damping), self.soil.curves, self.soil.names)
                for name, factor in factors.items() if name == "best" or self.cv.any()}


def _number(reader: Reader, key: str, default=None) -> float:
    low, high, unit = RANGES[key]
    value = reader.number(key, default)
    if not low <= value < high:
        reader.fail(key, f"is not from {low:g} to {high:g} {unit}?")
    return value


def _layer(reader: Reader, curves: dict, halfspace: bool = False) -> dict:
    """Numbers of a layer at small strain."""
    if ("vs" in reader.values) == ("g" in reader.values):
        reader.fail("vs", "is the speed of shear waves; give it or g, the shear modulus, one of the two")
    density = _number(reader, "density")
    modulus = density * _number(reader, "vs") ** 2 if "vs" in reader.values else _number(reader, "g")
    name, curve = reader.values.get("curve"), None
    if name is not None:
        if name not in curves:
            reader.fail("curve", f"is none of {', '.join(curves) or 'the curves, of which there are none'}")
        if "damping" in reader.values:
            reader.fail("damping", "is that of the curve; leave one of the two out")
        curve = curves[name]
    damping = 0.0 if curve else _number(reader, "damping")
    return {"thickness": 0.0 if halfspace else _number(reader, "thickness"), "density": density, "modulus": modulus,
            "damping": damping, "curve": curve, "cv": reader.values.get("cv") is not None and _number(reader, "cv")}


def _layers(reader: Reader, curves: dict) -> list:
    """The layers from the surface down, with their names."""
    found = []
    for number, values in enumerate(reader.entries("layers"), 1):
        name = str(values.get("name", number)) if isinstance(values, dict) else str(number)
        if name in [one["name"] for one in found] or name == "halfspace":
            raise ColumnError(f"{reader.path}: layers: two are called {name}")
        found.append({"name": name, **_layer(Reader(values, reader.path, f"layers: {name}", LAYER), curves)})
    if not found:
        raise ColumnError(f"{reader.path}: layers has none; a half-space alone needs no column")
    return found


def _divided(layers: list, thickest: float, depth: float) -> list:
    """Sublayers as thick as is asked at most; one begins at a depth."""
    found, top = [], 0.0
    for layer in layers:
        bottom = top + layer["thickness"]
        cuts = [top, *([depth] if top + 1e-6 < depth < bottom - 1e-6 else []), bottom]
        most = thickest or WAY * np.sqrt(layer["modulus"] / layer["density"])
        for a, b in zip(cuts, cuts[1:]):
            count = max(1, int(np.ceil((b - a) / most - 1e-9)))
            found += [{**layer, "thickness": (b - a) / count}] * count
        top = bottom
    return found


def _word(reader: Reader, key: str, known: tuple) -> str:
    word = reader.values.get(key, known[0])
    if word not in known:
        reader.fail(key, f"is none of {', '.join(known)}")
    return word


def _mats(reader: Reader) -> Mats:
    one = reader.part("mats", ("depth", "as", "over", "poisson", "structures", "tables"))
    depth = one.number("depth", 0.0)
    if depth < 0:
        one.fail("depth", "is the depth below the surface; it is not below 0")
    names = tuple(name.strip() for name in str(one.values.get("structures") or "").split(",") if name.strip())
    tables = one.values.get("tables") or {}
    if not isinstance(tables, dict) or not all(isinstance(text, str) and "{}" in text for text in tables.values()):
        one.fail("tables", "has not a name of a file for each structure, in which {} stands for the estimate")
    return Mats(depth, _word(one, "as", AS) == "outcrop", one.number("over", None if names else 1.0, 0.0),
                one.number("poisson", None if names else 0.0, -1e-9, 0.5), names, tuple(tables.items()))


def read(path: Path, thickest: float | None = None) -> Ground:
    """`thickest`: of sublayers [m], in place of that of the file. Throws UserError or OSError."""
    reader = Reader(load(path), path, "", KEYS)
    if thickest:
        reader.values["thickest"] = thickest
    files = reader.values.get("curves") or {}
    if not isinstance(files, dict) or not all(isinstance(file, str) for file in files.values()):
        reader.fail("curves", "has not names of curves, each with its file")
    curves = {name: read_curve(name, path.parent / file) for name, file in files.items()}
    layers = _layers(reader, curves)
    rock = _layer(reader.part("halfspace", tuple(set(LAYER) - {"thickness", "curve", "name"})), {}, halfspace=True)
    mats, cv = _mats(reader), _number(reader, "cv", 0.5)
    parts = _divided(layers, reader.number("thickest", 0.0, -1e-9), mats.depth) + [{**rock, "name": "halfspace"}]
    column = Column(np.array([one["thickness"] for one in parts[:-1]]),
                    *(np.array([one[key] for one in parts]) for key in ("density", "modulus", "damping")))
    if mats.depth > column.tops[-1] + 1e-6:
        reader.fail("mats", f"lie below the layers, which are {column.tops[-1]:g} m thick")
    names = tuple(one["name"] for one in parts)
    told = reader.part("input", ("at", "as"))
    at = told.values.get("at", "halfspace")
    if str(at) not in names:
        told.fail("at", f"is none of {', '.join(dict.fromkeys(names))}")
    axes, *_, wanted, _ = read_motions(reader)
    if wanted:
        raise ColumnError(f"{path}: motions: choose: a column takes records, or targets with seeds")
    level = reader.number("level", 0.0, 0.0 if "level" in reader.values else None)
    if not level and any(axis.target for axis in axes.values()):
        raise ColumnError(f"{path}: level is missing: synthetic motions have the peak that it says [m/s2]")
    rule = Rule(reader.number("ratio", 0.65, 0.0, 1.0 + 1e-9), reader.number("tolerance", 1e-3, 0.0, 0.1),
                reader.whole("iterations", 100, 1))
    return Ground(path, Soil(column, tuple(one["curve"] for one in parts[:-1]), names),
                  np.array([cv if one["cv"] is False else one["cv"] for one in parts]), axes, level,
                  Given(names.index(str(at)), _word(told, "as", AS) == "outcrop"), mats,
                  Given(int(abs(column.tops - mats.depth).argmin()), mats.outcrop), rule)


def doubts_of(ground: Ground) -> list:
    """Sentences about numbers that are hardly meant."""
    level = ground.level
    return [f"a level of {level:g} m/s2 ({'in g' if level < SHALLOW else 'in cm/s2'}?)"] * (0 < level < SHALLOW or level > STRONG)
