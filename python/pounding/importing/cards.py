"""Cards of all formats: lines of text, and the fields of a line by their places, faults told in one line with place."""

import math
import re
from pathlib import Path

from .model import InputFault

SHORT = re.compile(r"^([+-]?(?:\d+\.?\d*|\.\d+))([+-]\d+)$")  # 2.1+11, as Nastran has it
MOST = 10**8  # numbers of a range
LISTED = 10**6  # of one that becomes a list
LETTERS, DIGITS = 64, 18  # of a number
LARGEST = 1e60  # number; its fourth power is one as well
LINE = 10**4  # letters
FILES, BYTES = 1000, 2**31  # of a model with all that it includes


def shown(text) -> str:
    """A text as a message repeats it."""
    return text if len(text) <= 60 else f"{text[:57]}..."


def number(text: str, place: str) -> float:
    """A number; throws InputFault."""
    try:
        value = math.nan if len(text) > LETTERS or "_" in text or not text.isascii() else float(
            SHORT.sub(r"\1e\2", text.strip().lower().replace("d", "e")))
    except ValueError:
        value = math.nan
    if abs(value) > LARGEST and math.isfinite(value):
        raise InputFault(f"{place}: '{shown(text)}' is beyond {LARGEST:g}")
    if not math.isfinite(value):
        raise InputFault(f"{place}: '{shown(text)}' is not a number")
    return value


def numbers(fields, place: str) -> list:
    """Numbers of a line; empty fields are 0."""
    return [number(text, place) if text else 0.0 for text in fields]


def is_whole_number(text: str) -> bool:
    """Digits alone: no sign, and none of other alphabets."""
    return text.isascii() and text.isdigit() and len(text) <= DIGITS


def whole(text: str, place: str) -> int:
    """With or without a sign; throws InputFault."""
    digits = text.strip()
    if not is_whole_number(digits[1:] if digits[:1] in ("+", "-") else digits):
        raise InputFault(f"{place}: '{shown(text)}' is not a whole number")
    return int(digits)


def whole_range(first: int, last: int, step: int, place: str) -> range:
    """Numbers from the first to the last; throws InputFault where there are too many to be meant."""
    if step < 1 or last < first or last - first > MOST:
        raise InputFault(f"{place}: a range from {first} to {last} by {step}")
    return range(first, last + 1, step)


def listed(numbers_: range, place: str) -> range:
    """A range that becomes a list; throws InputFault where that is too long."""
    if len(numbers_) > LISTED:
        raise InputFault(f"{place}: a list of {len(numbers_)} numbers, more than {LISTED}")
    return numbers_


class Guard:
    """What all files of a model have read so far; `begin` before the first. Files are regular, and neither too many nor
    too large together."""

    count = size = 0

    def begin(self) -> None:
        self.count = self.size = 0

    def content(self, path: Path) -> bytes:
        """Of the next file. Throws InputFault."""
        try:
            if not path.is_file():
                raise InputFault(f"{path}: {'no file with contents' if path.exists() else 'no such file'}")
            self.count, self.size = self.count + 1, self.size + path.stat().st_size
            if self.count > FILES:
                raise InputFault(f"{path}: more than {FILES} files are included, again and again perhaps")
            if self.size > BYTES:
                raise InputFault(f"{path}: more than {BYTES / 2**30:g} GB of text, with all files that are included")
            return path.read_bytes()
        except (OSError, ValueError) as error:
            reason = (error.strerror or "").lower() if isinstance(error, OSError) else str(error)
            raise InputFault(f"{path}: {reason or 'cannot be read'}") from error


GUARD = Guard()


def split_lines(text: str) -> list:
    """Lines of a text, which end with \\n, \\r or both alone: str.splitlines ends them at 0x85 and the like as well."""
    return re.split("\r\n|\n|\r", text)


def lines_of(path: Path, seen=()):
    """Lines of a text as (place, line). Throws InputFault where it is none."""
    text = GUARD.content(path).decode("latin-1")
    if path.resolve() in seen:
        raise InputFault(f"{path}: includes itself")
    if "\0" in text[:4096]:
        raise InputFault(f"{path} line 1: not a text")
    lines = split_lines(text)
    found = [(f"{path.name} line {count}", line.rstrip()) for count, line in enumerate(lines, 1)]
    for place, line in found:
        if len(line) > LINE:
            raise InputFault(f"{place}: {len(line)} letters in a line, more than {LINE}")
    return found[:-1] if not lines[-1] else found


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
