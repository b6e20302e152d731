"""Blocks of an Abaqus or CalculiX deck: keyword, parameters, data lines; parts put in place by their instances."""

import math
from dataclasses import dataclass, field
from pathlib import Path

from .abaqus_parameters import Parameters
from .cards import is_whole_number, lines_of, names_of, number, numbers
from .geometry import cross, difference, dot, sum_of, unit
from .model import InputFault

# Parameters of keywords that are read, or say nothing of a model; any other one is a loss.
PARAMETERS = {
    "NODE": "NSET,SYSTEM", "ELEMENT": "TYPE,ELSET,SOLID ELEMENT NUMBERING",
    "NSET": "NSET,GENERATE,ELSET,INSTANCE,INTERNAL,UNSORTED",
    "ELSET": "ELSET,GENERATE,INSTANCE,INTERNAL,UNSORTED", "SURFACE": "NAME,TYPE,INTERNAL",
    "SOLID SECTION": "ELSET,MATERIAL,ORIENTATION,CONTROLS,COMPOSITE",
    "SHELL SECTION": "ELSET,MATERIAL,OFFSET,ORIENTATION,SECTION INTEGRATION,TEMPERATURE,POISSON,CONTROLS,COMPOSITE,"
                     "NODAL THICKNESS,SHELL THICKNESS",
    "BEAM SECTION": "ELSET,MATERIAL,SECTION,TEMPERATURE,POISSON,CONTROLS",
    "BEAM GENERAL SECTION": "ELSET,SECTION,DENSITY,POISSON,ZERO", "SPRING": "ELSET,NONLINEAR,ORIENTATION",
    "DASHPOT": "ELSET,NONLINEAR,ORIENTATION", "MASS": "ELSET,TYPE,ORIENTATION", "ROTARY INERTIA": "ELSET,ORIENTATION",
    "NONSTRUCTURAL MASS": "ELSET,UNITS", "BOUNDARY": "TYPE,OP,AMPLITUDE,REGION TYPE,FIXED",
    "RIGID BODY": "REF NODE,NSET,ELSET,TIE NSET,PIN NSET,ISOTHERMAL,ANALYTICAL SURFACE",
    "COUPLING": "CONSTRAINT NAME,REF NODE,SURFACE,ORIENTATION", "KINEMATIC COUPLING": "REF NODE,ORIENTATION",
    "TIE": "NAME,ADJUST,POSITION TOLERANCE,TYPE", "ELASTIC": "TYPE,MODULI",
    "DAMPING": "ALPHA,BETA,STRUCTURAL,COMPOSITE",
    "MPC": "", "EQUATION": "", "RELEASE": "", "TRANSFORM": "NSET,TYPE", "ORIENTATION": "NAME,DEFINITION,SYSTEM"}

# CalculiX takes no heed of blanks in them: without blanks -> as they are known here.
KEYWORDS = {keyword.replace(" ", ""): keyword for keyword in (*PARAMETERS, *names_of("""
    NODE PRINT, EL PRINT, NODE FILE, EL FILE, CONTACT PRINT, CONTACT FILE, NODE OUTPUT, ELEMENT OUTPUT, SECTION PRINT, END STEP,
    MODAL DYNAMIC, STEADY STATE DYNAMICS, BASE MOTION, INITIAL CONDITIONS, SPECIFIC HEAT, PHYSICAL CONSTANTS, MODAL DAMPING,
    TIME POINTS, SELECT CYCLIC SYMMETRY MODES, CONTACT PAIR, SURFACE INTERACTION, SURFACE BEHAVIOR, HEAT TRANSFER, END PART,
    END ASSEMBLY, END INSTANCE, TRANSVERSE SHEAR STIFFNESS, SHEAR CENTER"""))}
NAMES = {name.replace(" ", ""): name for names in PARAMETERS.values() for name in names.split(",")}


@dataclass(slots=True)
class Block:
    """A keyword without its star, in capitals, its parameters, and its data as (place, fields)."""

    keyword: str
    parameters: dict
    place: str
    data: list = field(default_factory=list)

    def name(self, key: str, fallback: str | None = None) -> str:
        """A parameter in capitals; throws InputFault where it is missing."""
        value = self.parameters.get(key, fallback)
        if value is None:
            raise InputFault(f"{self.place}: *{self.keyword} has no {key}")
        return value.strip().strip('"').upper()

    def strangers(self) -> list:
        """Its parameters that nothing reads."""
        known = PARAMETERS.get(self.keyword)
        return [] if known is None else [key for key in self.parameters if key not in known.split(",")]

    def number(self, key: str, fallback: float) -> float:
        return number(self.parameters[key], self.place) if key in self.parameters else fallback


def blocks_of(path: Path, seen=(), parameters_=None) -> list:
    """All blocks of a deck, those of included files in their place; `parameters_`: those of *PARAMETER so far."""
    blocks: list = []
    given = Parameters() if parameters_ is None else parameters_
    lines = iter(lines_of(path, seen))
    for place, line in lines:
        if line.lstrip().startswith("**") or not line.strip():
            continue
        if not blocks or blocks[-1].keyword != "HEADING" or line.lstrip().startswith("*"):
            line = given.fill(line, place)
        if not line.lstrip().startswith("*"):
            if not blocks:
                raise InputFault(f"{place}: data before the first keyword; a deck of Abaqus begins with one, as "
                                 "*HEADING")
            if blocks[-1].keyword == "PARAMETER":
                given.assign(line, place)
                continue
            blocks[-1].data.append((place, [text.strip() for text in line.split(",")]))
            continue
        while line.endswith(","):
            more = next(lines, None)
            if more is None:
                break
            line += more[1].strip()
        words = [word.strip() for word in line.strip()[1:].split(",")]
        parameters = {}
        for word in words[1:]:
            key, _, value = word.partition("=")
            if key.strip():
                key = " ".join(key.split()).upper()
                parameters[NAMES.get(key.replace(" ", ""), key)] = value.strip()
        keyword = " ".join(words[0].split()).upper()
        block = Block(KEYWORDS.get(keyword.replace(" ", ""), keyword), parameters, place)
        if block.keyword == "INCLUDE":
            blocks += blocks_of(path.parent / parameters.get("INPUT", "").strip('"'), (*seen, path.resolve()), given)
            blocks.append(Block("INCLUDE", parameters, place))
        else:
            blocks.append(block)
    return blocks


class Scope:
    """Names and numbers of a part, an instance or the whole deck, as the model knows them."""

    def __init__(self, name: str = "", outer=None):
        self.name, self.outer = name, outer
        self.nodes: dict = {}  # its number -> that of the model
        self.elements: dict = {}  # its number -> what was made of it
        self.node_sets: dict = {}
        self.element_sets: dict = {}
        self.surfaces: dict = {}
        self.inner: dict = {}  # name of an instance -> its scope

    def full(self, key):
        """A number or name with that of the instance before it, as in A.12."""
        return f"{self.name}.{key}" if self.name else key

    def find(self, what: str, key):
        """A set, surface, node or element by its name, `INSTANCE.NAME` too; None where there is none."""
        table = getattr(self, what)
        if key in table:
            return table[key]
        if isinstance(key, str):
            first, dot_, rest = key.partition(".")
            if dot_ and first in self.inner:
                return self.inner[first].find(what, int(rest) if is_whole_number(rest) else rest)
            if is_whole_number(key) and int(key) in table:
                return table[int(key)]
        if self.outer is None and len(self.inner) == 1 and "." not in str(key):
            return next(iter(self.inner.values())).find(what, key)
        return None


@dataclass(slots=True)
class Motion:
    """That of an instance: moved first, then turned."""

    shift: tuple = (0.0, 0.0, 0.0)
    origin: tuple = (0.0, 0.0, 0.0)
    axis: tuple | None = None
    angle: float = 0.0

    def place(self, x) -> tuple:
        x = sum_of(x, self.shift)
        return sum_of(self.origin, self.turn(difference(x, self.origin))) if self.axis else x

    def turn(self, v) -> tuple:
        """A direction; by Rodrigues' formula."""
        if not self.axis:
            return tuple(v)
        c, s = math.cos(self.angle), math.sin(self.angle)
        k = self.axis
        return tuple(c * a + s * b + (1 - c) * dot(k, v) * d for a, b, d in zip(v, cross(k, v), k))


def motion_of(block: Block) -> Motion:
    """By the data of *INSTANCE. Throws InputFault."""
    motion = Motion()
    rows = [(place, numbers(fields, place)) for place, fields in block.data if any(fields)]
    if rows:
        motion.shift = tuple((rows[0][1] + [0.0] * 3)[:3])
    if len(rows) > 1:
        place, values = rows[1]
        if len(values) < 7 or unit(difference(values[3:6], values[:3])) is None:
            raise InputFault(f"{place}: a rotation of an instance is two points and an angle")
        motion.origin = tuple(values[:3])
        motion.axis = unit(difference(values[3:6], values[:3]))
        motion.angle = math.radians(values[6])
    return motion
