"""Values of options of run/benchmark and run/scaling."""

import re

from parts.arguments import positive


def integers(text: str) -> list:
    """Positive integers, separated by commas."""
    return [positive(int)(word) for word in text.split(",")]


def sizes(text: str) -> list:
    """Numbers of dofs, separated by commas: 36000, 36k, 1M."""
    return integers(re.sub(r"M\b", "000000", re.sub(r"k\b", "000", text)))


def seconds(text: str) -> float:
    """Length of a measurement: up to a minute."""
    return min(positive(float)(text), 60.0)
