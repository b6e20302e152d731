"""Commands for those who work on the program: one package for each, and how a command begins and ends. What they share with the
commands for its users is the package `pounding` of the folder python."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

from pounding.commands.process import begin, end, parser_of  # noqa: E402, F401
