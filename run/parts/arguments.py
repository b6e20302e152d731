"""Readers of values of the command line, whose mistakes are told in words."""

import argparse


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
        return value

    return read
