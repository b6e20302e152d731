"""Keywords of an LS-DYNA deck (.k) with their cards."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar

from .cards import Fields, cut, is_whole_number, lines_of, number, whole
from .model import InputFault

TEN = (10,) * 8
EIGHT = (8,) * 10
# Lines of keywords that a title or number precedes each time, with it.
HEADED = (("BOUNDARY_SPC", 2), ("BOUNDARY_PRESCRIBED_MOTION", 2), ("SECTION_SOLID", 2), ("SECTION_", 3))


@dataclass(slots=True)
class Card(Fields):
    """Fields of a line."""

    fields: list
    place: str
    NAMED: ClassVar = False

    def int(self, at: int, fallback: int = 0) -> int:
        text = self.text(at)
        if not text:
            return fallback
        if is_whole_number(text.lstrip("+-")):
            return whole(text, self.place)
        value = number(text, self.place)  # 1.0 where a whole number is meant
        return int(value) if value == int(value) and abs(value) < 1e15 else whole(text, self.place)


@dataclass(slots=True)
class Keyword:
    """A keyword without its star and without `TITLE` or `ID` at its end, and its lines."""

    name: str
    place: str
    lines: list = field(default_factory=list)

    def cards(self, *widths) -> list:
        """All lines, cut into fields of these widths; those between commas where there are some."""
        return [self.card(at, *widths) for at in range(len(self.lines))]

    def card(self, at: int, *widths) -> Card:
        """Throws InputFault where there are fewer."""
        if at >= len(self.lines):
            raise InputFault(f"{self.place}: *{self.name} has no card {at + 1}")
        place, line = self.lines[at]
        return Card([word.strip() for word in line.split(",")] if "," in line else cut(line, widths or TEN), place)


def keywords_of(path: Path, seen=()) -> list:
    """All keywords, those of included files in their place. Throws InputFault."""
    found: list = []
    for place, line in lines_of(path, seen):
        if line.startswith("$"):
            continue
        if not line.startswith("*"):
            if not found:
                if line.strip():
                    raise InputFault(f"{place}: a card before the first keyword; a deck of LS-DYNA begins with "
                                     "*KEYWORD")
                continue
            found[-1].lines.append((place, line))
            continue
        name = line[1:].strip().upper()
        if name.endswith(("+", "-", "%")) or name.startswith("KEYWORD") and "LONG" in name:
            raise InputFault(f"{place}: long formats of LS-DYNA are not known; write the deck in the standard one")
        found.append(Keyword(name.split()[0] if name else "", place))
        if found[-1].name == "END":
            break
    result: list = []
    for keyword in found:
        keyword.lines = [row for row in keyword.lines if row[1].strip() or keyword.name.startswith(("PART", "TITLE",
                                                                                                    "SECTION"))]
        if keyword.name in ("INCLUDE", "INCLUDE_PATH_RELATIVE"):
            for _, line in keyword.lines:
                result += keywords_of(path.parent / line.strip(), (*seen, path.resolve()))
        elif keyword.name.startswith("INCLUDE"):
            raise InputFault(f"{keyword.place}: *{keyword.name} is not known")
        result.append(keyword)
        for end in ("_TITLE", "_ID"):
            if keyword.name.endswith(end) and keyword.name not in ("SET_ID",):
                keyword.name = keyword.name[:-len(end)]
                each = next((count for name, count in HEADED if keyword.name.startswith(name)), len(keyword.lines))
                keyword.lines = [row for at, row in enumerate(keyword.lines) if at % each]
    return result
