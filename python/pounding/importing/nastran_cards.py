"""Bulk data of a Nastran deck: cards in small, large and free fields, and its coordinate systems."""

import math
import re
from dataclasses import dataclass
from typing import ClassVar

from .cards import Fields, number, whole, whole_range
from .geometry import applied, cross, difference, length, sum_of, unit
from .model import InputFault

BLANKS = re.compile(r"\s+(?=[edED+-])|(?<=[edED+-])\s+")  # within a number
GLOBAL = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(slots=True)
class Card(Fields):
    """A card with its fields from the second on: the first has place 0 here."""

    name: str
    fields: list
    place: str
    MISSING: ClassVar = ("field", 2)

    def real(self, at: int, fallback: float = 0.0) -> float:
        """Also with blanks before its exponent, `10.6 +6`, as cards of old have it."""
        return number(BLANKS.sub("", self.text(at)), self.where) if self.text(at) else fallback

    def ranges_from(self, at: int) -> list:
        """Whole numbers to the end, with THRU and BY, as ranges; a number alone is a range of one."""
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
                found[-1] = whole_range(found[-1][0], last, step, self.place)
                continue
            first = whole(words[k], f"{self.place}: {self.name}")
            found.append(range(first, first + 1))
            k += 1
        return found

    def list_from(self, at: int, most: int) -> list:
        """The same as a list. Throws InputFault where it has more numbers than there can be."""
        ranges = self.ranges_from(at)
        if sum(map(len, ranges)) > most:
            raise InputFault(f"{self.where}: a list of {sum(map(len, ranges))} numbers; the deck has {most}")
        return [number_ for one in ranges for number_ in one]


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
