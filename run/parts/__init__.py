"""The way from the folder run to the package `pounding`, which the commands for users are a part of, and the commands for those that
work on the program: one package for each."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

from pounding.commands import start  # noqa: E402, F401
