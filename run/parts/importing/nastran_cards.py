"""Bulk data of a Nastran deck: cards in small, large and free fields, and its coordinate systems."""

import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from .cards import Fields, lines_of, whole, whole_range
from .geometry import applied, cross, difference, length, sum_of, unit
from .model import InputFault

GLOBAL = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(slots=True)
class Card(Fields):
    """A card with its fields from the second on: the first has place 0 here."""

    name: str
    fields: list
    place: str
    MISSING: ClassVar = ("field", 2)

    def list_from(self, at: int) -> list:
        """Whole numbers to the end, with THRU and BY."""
        words = [text for text in self.fields[at:] if text]
        found: list = []
        k = 0
        while k < len(words):
            if words[k].upper() == "THRU" and found and k + 1 < len(words):
                last, step = whole(words[k + 1], self.place), 1
                k += 2
                if k + 1 < len(words) and words[k].upper() == "BY":
                    step = whole(words[k + 1], self.place)
                    k += 2
                found += whole_range(found[-1], last, step, self.place)[1:]
                continue
            found.append(whole(words[k], f"{self.place}: {self.name}"))
            k += 1
        return found


def fields_of(line: str) -> tuple:
    """Name or mark of continuation, and 8 fields, or 4 of a large card."""
    if "," in line:
        words = [word.strip() for word in line.split(",")]
        large = words[0].endswith("*")
        count = 4 if large else 8
        return words[0], (words[1:count + 1] + [""] * count)[:count]
    line = line.expandtabs(8)
    first = line[:8].strip()
    if "*" in first:
        return first, [line[8 + 16 * k:24 + 16 * k].strip() for k in range(4)]
    return first, [line[8 + 8 * k:16 + 8 * k].strip() for k in range(8)]


def included(path: Path, seen=()):
    """Lines of a deck and of the files that it includes, without comments."""
    for place, line in lines_of(path, seen):
        line = line.split("$")[0].rstrip()
        found = re.match(r"\s*INCLUDE\s+['\"]?([^'\"]+)['\"]?\s*$", line, re.IGNORECASE)
        if found:
            yield from included(path.parent / found[1].strip(), (*seen, path.resolve()))
        elif line.strip():
            yield place, line


def deck_of(path: Path) -> tuple:
    """Lines of the control sections as (place, text), and the cards of the bulk data, up to ENDDATA."""
    lines = list(included(path))
    begin = next((at for at, (_, line) in enumerate(lines) if re.match(r"\s*BEGIN\s+BULK", line, re.IGNORECASE)), None)
    control = [] if begin is None else lines[:begin]
    cards: list = []
    for place, line in lines[0 if begin is None else begin + 1:]:
        first, fields = fields_of(line)
        if first[:1] in ("+", "*", ""):
            if not cards:
                raise InputFault(f"{place}: a continuation of no card")
            if first[:1] != "*":
                cards[-1].fields += [""] * (-len(cards[-1].fields) % 8)
            cards[-1].fields += fields
            continue
        name = first.rstrip("*").upper()
        if not re.fullmatch(r"[A-Z][A-Z0-9_]*", name):
            raise InputFault(f"{place}: '{first}' is no card of Nastran")
        if name == "ENDDATA":
            break
        cards.append(Card(name, list(fields), place))
    return control, cards


# Elements of structures, those of NASTRAN-95 among them, and where cards have a density or a mass.
STRUCTURAL = re.compile(r"C(BAR|BEAM|BEND|ROD|ONROD|TUBE|SHEAR|QUAD[124R8]|TRIA[1236R]|QDMEM\d?|TRMEM|QDPLT|TRPLT|TRBSC|HEXA[12]?|"
                        r"PENTA|WEDGE|TETRA|PYRAM|IHEX[123]|BUSH|ELAS[12])")
MASS_AT = {"MAT1": 4, "MAT2": 7, "MAT8": 8, "MAT9": 23, "CONM2": 3, "CMASS2": 1, "PMASS": 1, "PSHELL": 7, "PBAR": 6,
           "PROD": 5}


def holds_mass(path: Path) -> bool:
    """Whether a deck has elements of a structure and mass. Throws InputFault."""
    cards = deck_of(path)[1]
    return any(STRUCTURAL.fullmatch(card.name) for card in cards) and any(
        card.name == "CONM1" or card.name in MASS_AT and card.real(MASS_AT[card.name]) for card in cards)


class Systems:
    """Coordinate systems by number; `position` finds the coordinates of a grid point."""

    def __init__(self, position):
        self.position, self.cards, self.known = position, {}, {0: ("R", (0.0, 0.0, 0.0), GLOBAL)}
        self.open: set = set()

    def add(self, card: Card) -> None:
        if card.name[4] == "1":
            for at in (0, 4):
                if card.text(at):
                    self.cards[card.int(at)] = Card(card.name, card.fields[at:at + 4], card.place)
        else:
            self.cards[card.int(0)] = card

    def find(self, number_: int, place: str) -> tuple:
        """Kind (R, C, S), origin and axes. Throws InputFault."""
        if number_ in self.known:
            return self.known[number_]
        if number_ not in self.cards or number_ in self.open:
            raise InputFault(f"{place}: coordinate system {number_} is not in the deck, or hangs on itself")
        self.open.add(number_)
        card = self.cards[number_]
        if card.name[4] == "1":
            a, b, c = (self.position(card.int(k), card.place) for k in (1, 2, 3))
        else:
            a, b, c = (self.point(card.int(1, 0), card.vector(2 + 3 * k), card.place) for k in range(3))
        z = unit(difference(b, a))
        y = unit(cross(z, difference(c, a))) if z else None
        if y is None:
            raise InputFault(f"{card.place}: {card.name} {number_} has its three points in a line")
        self.known[number_] = card.name[5], a, (cross(y, z), y, z)
        self.open.discard(number_)
        return self.known[number_]

    def point(self, number_: int, x, place: str) -> tuple:
        """Global coordinates of a point of the system."""
        kind, origin, axes = self.find(number_, place)
        if kind == "C":
            x = (x[0] * math.cos(math.radians(x[1])), x[0] * math.sin(math.radians(x[1])), x[2])
        elif kind == "S":
            theta, phi = math.radians(x[1]), math.radians(x[2])
            x = (x[0] * math.sin(theta) * math.cos(phi), x[0] * math.sin(theta) * math.sin(phi), x[0] * math.cos(theta))
        return sum_of(origin, applied(axes, x))

    def axes_at(self, number_: int, x, place: str) -> tuple:
        """Axes of the system at a place; on the axis of a round one those of the system itself. Throws InputFault."""
        kind, origin, axes = self.find(number_, place)
        way = difference(x, origin)
        radial = cross(axes[2], way)
        if kind == "R" or length(radial) <= 1e-12 * max(length(x), length(way)):
            return axes
        tangent = unit(radial)
        if kind == "C":
            return cross(tangent, axes[2]), tangent, axes[2]
        outwards = unit(way)
        return outwards, cross(tangent, outwards), tangent
