"""The parts of the commands beside: one package per command. What they share with other people's scripts is the
package `pounding` of the folder python."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
