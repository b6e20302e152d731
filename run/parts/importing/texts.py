"""Lines and numbers of text files, each fault with its place in one line."""

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
