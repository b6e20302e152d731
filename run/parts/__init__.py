"""The parts of the commands beside: one package per command, and what a command calls itself. What they share with
other people's scripts is the package `pounding` of the folder python."""

import re
import signal
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

# Under a prefix pounding-tools starts the commands; there is no build there.
INSTALLED = not (Path(__file__).resolve().parents[2] / "CMakeLists.txt").exists()


def called(text: str) -> str:
    """A text about commands with their names as they are called here: `run/plot` or `pounding-tools plot`."""
    return re.sub(r"\brun/(?=[a-z])", "pounding-tools ", text) if INSTALLED else text


def stop_when_terminated() -> None:
    """SIGTERM, as a batch system sends it, stops a command as Ctrl-C does: its runs with it."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)
