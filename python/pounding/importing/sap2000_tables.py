"""Tables of a SAP2000 text (.s2k): rows of NAME=VALUE under TABLE: "..."."""

import re
from dataclasses import dataclass
from pathlib import Path

from .cards import lines_of, number
from .model import InputFault

ENTRY = re.compile(r'(?<![A-Za-z0-9_/%.\-])([A-Za-z0-9_/%.\-]+)\s*=\s*("[^"]*"|[^\s"]+)')
TITLE = re.compile(r'TABLE:\s*"([^"]+)"', re.IGNORECASE)
ROW = 10**5  # letters of a row with the lines on which it goes on


@dataclass(slots=True)
class Row:
    """Values of a row by their names, as text; `place` in the file."""

    values: dict
    place: str

    def text(self, name: str) -> str:
        """Throws InputFault where it is not there."""
        if name not in self.values:
            raise InputFault(f"{self.place}: {name} is not given")
        return self.values[name]

    def real(self, name: str, preset: float | None = None) -> float:
        if preset is not None and name not in self.values:
            return preset
        return number(self.text(name), f"{self.place}: {name}")

    def says(self, name: str) -> bool:
        return self.values.get(name, "No").lower() == "yes"


@dataclass(slots=True)
class Table:
    name: str
    place: str
    rows: list


def tables_of(path: Path) -> list:
    """Tables in the order of the file. Throws InputFault for a row that is none, a file without tables."""
    tables, begun, place = [], "", ""
    for where, line in lines_of(path):
        text = line.strip()
        if begun:
            text, where = f"{begun} {text}", place
        if text.endswith(" _") or text == "_":
            begun, place = text[:-1].strip(), where
            if len(begun) > ROW:
                raise InputFault(f"{place}: a row of more than {ROW} letters")
            continue
        begun = ""
        title = TITLE.match(text)
        if title:
            tables.append(Table(" ".join(title[1].upper().split()), where, []))
        elif not text or text.upper().startswith("END TABLE DATA") or not tables:
            continue
        else:
            found = ENTRY.findall(text)
            if not found or ENTRY.sub("", text).strip():
                raise InputFault(f"{where}: '{text[:60]}' is no row of NAME=VALUE")
            tables[-1].rows.append(Row({name: value.strip('"') for name, value in found}, where))
    if begun:
        raise InputFault(f"{place}: a row that goes on, and the file does not")
    if not tables:
        raise InputFault(f"{path}: no table in it; export the model as a SAP2000 text (.s2k)")
    return tables
