#!/usr/bin/python3
"""The page of what goes with what, made by asking the program for every pair of features.

    table.py --write    asks for all of them (minutes) and writes docs/reference/composition.md
"""
import itertools
import os
import re
import sys
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import program
from cells import PROPERTIES, Cell, pair, sentence
from features import FEATURES, KINDS

PAGE = Path(program.SOURCE, "docs", "reference", "composition.md")
CELLS = list(itertools.combinations(FEATURES, 2))
HEAD = """# Features in pairs

Every pair of features of the program, each on the same small scene: two houses of one storey side by side, their floors facing
each other over a joint, shaken in three directions. The page is generated (`tests/composition/table.py --write`) from one
declaration of each feature (`tests/composition/features.py`) and from the answers of the program; `tests/composition` runs the
cells that are *yes* and holds each to these:

{properties}

Two features that state the same option of a structure are laid on one house each. So *yes* means: it runs, and these hold,
but for a property that a feature names with its reason as one that it has not (`spared` in its declaration).
{counts}

| sign | meaning |
|---|---|
| `+` | yes |
| `x` | refused in one line, with exit status 1: [below](#refused) |
| `.` | impossible: two features that are in each other's place, [below](#impossible) |

"""
MEANINGS = {
    "the ledger closes": "the energy balance closes to 1e-12 of its largest term",
    "two ranks": "two ranks move as one does",
    "continued": "a run continued from a checkpoint is the uninterrupted one, to the bit",
    "all modes": "structures reduced to all of their modes move as at full order (1e-9), where they may be reduced",
    "as a member": "a member of an ensemble is its single run (1e-9), where it may be one",
    "at rest": "a structure at rest stays at rest, under its weight as well",
    "other units": "in millimetres, tonnes and seconds it is the same (1e-9)",
    "turned": "turned by a quarter about z it is the same (1e-9)",
}


def outcome(first, second):
    """The sign of a pair and, where it is no yes, its reason."""
    scene = pair(first, second)
    if isinstance(scene, str):
        return ".", scene
    cell = Cell(scene)
    try:
        result, _ = cell.run()
        return ("+", "") if result.returncode == 0 else ("x", sentence(result))
    finally:
        cell.close()


def outcomes(cells):
    with ThreadPoolExecutor(program.JOBS) as pool:
        return dict(zip(((f.name, g.name) for f, g in cells), pool.map(lambda cell: outcome(*cell), cells)))


def written(found):
    """The page of these outcomes of all pairs."""
    signs = [sign for sign, _ in found.values()]
    counts = (f"There are {len(FEATURES)} features and {len(found)} pairs: {signs.count('+')} are yes, {signs.count('x')} refused, "
              f"{signs.count('.')} impossible.")
    properties = "\n".join(f"- {MEANINGS[name]};" for name in PROPERTIES)[:-1] + "."
    names, lines = [f.name for f in FEATURES], []
    width = max(map(len, names))
    for row in (lambda n: n // 10 or " ", lambda n: n % 10):
        lines.append(" " * (width + 5) + "".join(str(row(n)) for n in range(1, len(names))))
    for i, name in enumerate(names):
        lines.append(f"{i + 1:3d} {name:{width}s} " + "".join(found[names[j], name][0] for j in range(i)))
    text = HEAD.format(properties=properties, counts=counts) + "```\n" + "\n".join(lines) + "\n```\n\n"
    text += "Kinds: " + "; ".join(
        f"{kind} {i + 1} to {i + len(of)}" for kind in KINDS for of in [[f for f in FEATURES if f.kind == kind]]
        for i in [FEATURES.index(of[0])]) + ".\n\n## Refused\n\n| of | beside | sentence |\n|---|---|---|\n"
    refused = defaultdict(list)
    for (first, second), (sign, reason) in found.items():
        if sign == "x":
            refused[first, reason].append(second)
    text += "".join(f"| {first} | {', '.join(seconds)} | {reason.replace('|', chr(92) + '|')} |\n" for (first, reason), seconds in refused.items())
    text += "\n## Impossible\n\n| rule | features |\n|---|---|\n"
    rules = defaultdict(dict)
    for cell, (sign, reason) in found.items():
        if sign == ".":
            rules[reason].update(dict.fromkeys(cell))
    text += "".join(f"| {rule} | {', '.join(of)} |\n" for rule, of in rules.items())
    text += "\n## Spared\n\nA feature may be spared a property that is not its own.\n\n| feature | property | reason |\n|---|---|---|\n"
    text += "".join(f"| {f.name} | {name} | {reason} |\n" for f in FEATURES for name, reason in f.spared.items())
    return text


def told():
    """The sign of every pair by the page."""
    block = re.search(r"```\n(.*?)\n```", PAGE.read_text(), re.DOTALL)[1].splitlines()[2:]
    rows = [re.fullmatch(r" *\d+ (.*?) +([+x.]*)", line + ("" if i else " ")).groups() for i, line in enumerate(block)]
    return {(rows[j][0], name): sign for name, signs in rows for j, sign in enumerate(signs)}


if __name__ == "__main__":
    if sys.argv[1:] != ["--write"]:
        sys.exit(__doc__)
    PAGE.write_text(written(outcomes(CELLS)))
