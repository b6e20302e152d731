"""Values of options of run/benchmark and run/scaling."""

import math
import re


def positive(text: str) -> int:
    value = int(text)
    if value < 1:
        raise ValueError
    return value


def integers(text: str) -> list:
    """Positive integers, separated by commas."""
    return [positive(word) for word in text.split(",")]


def sizes(text: str) -> list:
    """Numbers of dofs, separated by commas: 36000, 36k, 1M."""
    return [positive(re.sub("M$", "000000", re.sub("k$", "000", word))) for word in text.split(",")]


def names_of(known):
    """Reader of some of the known names, separated by commas."""
    def names(text: str) -> list:
        found = text.split(",")
        if not set(found) <= set(known):
            raise ValueError
        return found
    return names


def positive_number(text: str) -> float:
    value = float(text)
    if not 0 < value < math.inf:
        raise ValueError
    return value


def seconds(text: str) -> float:
    """Length of a measurement: up to a minute."""
    return min(positive_number(text), 60.0)
