"""Commands and blocks of an ANSYS archive (.cdb), as CDWRITE makes it."""

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar

from .cards import Fields, cut, lines_of, number, whole
from .model import InputFault

BLOCKS = ("NBLOCK", "EBLOCK", "RLBLOCK", "CMBLOCK", "SECBLOCK", "ETBLOCK")


@dataclass(slots=True)
class Command(Fields):
    """Words of a line in capitals, the first the command's name; of a block its rows as (place, words) as well."""

    name: str
    words: list
    place: str
    rows: list = field(default_factory=list)
    MISSING: ClassVar = ("value", 1)

    @property
    def fields(self) -> list:
        return self.words


def widths_of(line: str, place: str) -> list:
    """Widths of the fields of a format of Fortran: (3i9,6e21.13e3). Throws InputFault."""
    found: list = []
    for count, width in re.findall(r"(\d{0,6})[ieagf](\d{1,6})(?:\.\d{1,6}(?:e\d{1,6})?)?", line.lower()):
        found += [int(width)] * min(int(count or 1), 1001)
    if len(found) > 1000:
        raise InputFault(f"{place}: '{line.strip()}' is a format of {len(found)} fields")
    if 0 in found or not found or not line.strip().startswith("("):
        raise InputFault(f"{place}: '{line.strip()}' is no format")
    return found


class Commands:
    """All commands of an archive in their order."""

    def __init__(self, path: Path):
        self.lines = lines_of(path)
        self.at = 0
        self.found: list = []
        self.parameters: dict = {}  # names of *SET -> words
        while self.at < len(self.lines):
            place, line = self._next()
            line = line.split("!")[0]
            for text in line.split("$") if "$" in line else [line]:
                words = [word.strip() for word in text.strip().split(",")]
                if not words[0]:
                    continue
                name = words[0].upper()
                if name == "*SET" and len(words) > 2:
                    self.parameters[words[1].upper()] = words[2]
                elif name[:1].isalpha():  # whole words alone: nothing is computed
                    words[1:] = [self.parameters.get(word.upper(), word) for word in words[1:]]
                command = Command(name, words[1:], place)
                if name in BLOCKS:
                    getattr(self, f"_read_{name.lower()}")(command)
                self.found.append(command)

    def _next(self) -> tuple:
        if self.at >= len(self.lines):
            raise InputFault(f"{self.lines[-1][0]}: the file ends within a block")
        self.at += 1
        return self.lines[self.at - 1]

    def _widths(self) -> list:
        place, line = self._next()
        return widths_of(line, place)

    def _read_nblock(self, command: Command) -> None:
        """Rows up to the line -1; of nodes up to the command N as well."""
        widths = self._widths()
        while True:
            place, line = self._next()
            if line.strip() == "-1" or command.name == "NBLOCK" and line.strip().startswith("N,"):
                return
            if not line.strip():
                raise InputFault(f"{place}: an empty line in the block of {command.name}")
            command.rows.append((place, cut(line, widths)))

    _read_eblock = _read_etblock = _read_nblock

    def _read_cmblock(self, command: Command) -> None:
        """Numbers, as many as the header says."""
        count, widths = command.int(2), self._widths()
        found: list = []
        while len(found) < count:
            place, line = self._next()
            fields = [whole(text, place) for text in cut(line, widths)]
            if not fields:
                raise InputFault(f"{place}: {len(found)} numbers of a component of {count}")
            found += fields
        command.rows = found

    def _read_rlblock(self, command: Command) -> None:
        """Sets of real constants: number -> values."""
        formats = [self._widths(), self._widths()]
        for _ in range(command.int(0)):
            place, line = self._next()
            fields = cut(line, formats[0])
            if len(fields) < 2:
                raise InputFault(f"{place}: a set of real constants has a number and a count")
            own, count = whole(fields[0], place), whole(fields[1], place)
            values = [number(text, place) for text in fields[2:] if text]
            while len(values) < count:
                place, line = self._next()
                more = [number(text, place) for text in cut(line, formats[1]) if text]
                if not more:
                    raise InputFault(f"{place}: {len(values)} real constants of {count}")
                values += more
            command.rows.append((own, values))

    def _read_secblock(self, command: Command) -> None:
        for _ in range(command.int(0)):
            place, line = self._next()
            command.rows.append((place, [word.strip() for word in line.split(",")]))
