"""Cards of all formats: lines of text, and the fields of a line by their places, faults told in one line with place."""

import math
import re
from pathlib import Path

from .model import InputFault

SHORT = re.compile(r"^([+-]?(?:\d+\.?\d*|\.\d+))([+-]\d+)$")  # 2.1+11, as Nastran has it
MOST = 10**8  # numbers of a range


def number(text: str, place: str) -> float:
    """A number; throws InputFault."""
    try:
        value = float(SHORT.sub(r"\1e\2", text.strip().lower().replace("d", "e")))
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputFault(f"{place}: '{text}' is not a number")
    return value


def numbers(fields, place: str) -> list:
    """Numbers of a line; empty fields are 0."""
    return [number(text, place) if text else 0.0 for text in fields]


def whole(text: str, place: str) -> int:
    try:
        return int(text)
    except ValueError as error:
        raise InputFault(f"{place}: '{text}' is not a whole number") from error


def whole_range(first: int, last: int, step: int, place: str) -> range:
    """Numbers from the first to the last; throws InputFault where there are too many to be meant."""
    if step < 1 or last < first or last - first > MOST:
        raise InputFault(f"{place}: a range from {first} to {last} by {step}")
    return range(first, last + 1, step)


def lines_of(path: Path, seen=()):
    """Lines of a text as (place, line). Throws InputFault where it is none."""
    if path.resolve() in seen:
        raise InputFault(f"{path}: includes itself")
    try:
        text = path.read_bytes().decode("latin-1")
    except OSError as error:
        raise InputFault(f"{path}: {(error.strerror or 'cannot be read').lower()}") from error
    if "\0" in text[:4096]:
        raise InputFault(f"{path} line 1: not a text")
    return [(f"{path.name} line {count}", line.rstrip()) for count, line in enumerate(text.splitlines(), 1)]


class Fields:
    """What cards have in common: `fields` as text and their `place`. `NAMED`: faults say `name` as well; `MISSING`: how a
    field that is not there is told, from which number on, where there is no fallback."""

    __slots__ = ()
    NAMED = True
    MISSING = ("field", 1)

    @property
    def where(self) -> str:
        return f"{self.place}: {self.name}" if self.NAMED else self.place

    def text(self, at: int) -> str:
        return self.fields[at] if at < len(self.fields) else ""

    def real(self, at: int, fallback: float = 0.0) -> float:
        return number(self.text(at), self.where) if self.text(at) else fallback

    def int(self, at: int, fallback: int | None = None) -> int:
        """Throws InputFault where there is none and no fallback."""
        if not self.text(at):
            if fallback is None:
                raise InputFault(f"{self.where} has no {self.MISSING[0]} {at + self.MISSING[1]}")
            return fallback
        return whole(self.text(at), self.where)

    def vector(self, at: int) -> tuple:
        return tuple(self.real(at + k) for k in range(3))


def names_of(text: str) -> frozenset:
    """Names between commas, those of several words, or else between blanks."""
    return frozenset(" ".join(name.split()) for name in (text.split(",") if "," in text else text.split()))


def cut(line: str, widths) -> list:
    """Fields of these widths, as far as the line goes; more of the last width."""
    fields, at = [], 0
    while at < len(line.rstrip()):
        width = widths[min(len(fields), len(widths) - 1)]
        fields.append(line[at:at + width].strip())
        at += width
    return fields
