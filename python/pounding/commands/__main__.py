"""A command by its name: python3 -P __main__.py NAME ARGUMENTS. Without a name it lists what there is."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from pounding.commands import PREFIX, start  # noqa: E402

NAMES = sorted(path.stem for path in Path(__file__).parent.glob("[a-z]*.py") if path.stem != "process")

if len(sys.argv) > 1 and sys.argv[1] in NAMES:
    start(sys.argv.pop(1))
listed = "\n".join(f"  {PREFIX}{name}" for name in NAMES)
sys.exit(f"{PREFIX.rstrip(' -/')}: no tool {sys.argv[1]}; there are\n{listed}" if len(sys.argv) > 1 else print(listed))
