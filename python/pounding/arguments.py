"""Readers of values of the command line, whose mistakes are told in words."""

import argparse
import math
import re
import shlex

from pounding.runs import RunError, require_room


def names(choices):
    """A list separated by commas, each of them one of `choices`."""
    known = {str(choice).lower(): choice for choice in choices}

    def read(text: str) -> list:
        words = [word.strip().lower() for word in text.split(",")]
        for word in words:
            if word not in known:
                raise argparse.ArgumentTypeError(f"'{word}' is none of {', '.join(map(str, choices))}")
        return [known[word] for word in words]

    return read


def positive(kind):
    """Reader of a number of this kind above zero."""
    def read(text: str):
        value = kind(text)
        if not value > 0:
            raise argparse.ArgumentTypeError(f"{text} is not above 0")
        if value == math.inf:
            raise argparse.ArgumentTypeError(f"{text} is not finite")
        return value

    read.__name__ = kind.__name__  # argparse says it of what is no number
    return read


def numbers_above_0(text: str) -> list:
    """Numbers above zero between commas."""
    read = positive(float)
    try:
        return [read(word) for word in text.split(",")]
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"'{text}' is no list of numbers between commas") from error


def ranks(text: str) -> int:
    """A number of ranks that the cores, or a batch system, can hold."""
    count = positive(int)(text)
    try:
        require_room(count)
    except RunError as error:
        raise argparse.ArgumentTypeError(str(error)) from error
    return count


def words(text: str) -> list:
    """Words of a command line that are given as one."""
    try:
        return shlex.split(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{text!r}: {str(error).lower()}") from error


def integers(text: str) -> list:
    """Positive integers, separated by commas."""
    return [positive(int)(word) for word in text.split(",")]


def sizes(text: str) -> list:
    """Numbers of dofs, separated by commas: 36000, 36k, 1M."""
    return integers(re.sub(r"M\b", "000000", re.sub(r"k\b", "000", text)))


def seconds(text: str) -> float:
    """Length of a measurement: up to a minute."""
    return min(positive(float)(text), 60.0)
