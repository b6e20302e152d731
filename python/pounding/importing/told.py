"""What the command says of a model: cards, counts, mass, and the first modes that the program finds."""

import re
import tempfile
from collections import Counter
from pathlib import Path

from pounding.runs import alone

from .model import COMPONENTS


def _table(counts: Counter) -> str:
    return ", ".join(f"{name} {count}" for name, count in sorted(counts.items()))


def cards_told(cards, allowed) -> list:
    """Lines about all cards, those that are lost one by one."""
    lines = []
    if cards.read:
        lines.append(f"read: {_table(cards.read)}")
    reasons: dict = {}
    for name, count in cards.noted.items():
        reasons.setdefault(cards.why.get(name, ""), Counter())[name] = count
    for why, counts in reasons.items():
        lines.append(f"passed over{f' ({why})' if why else ''}: {_table(counts)}")
    for name, count in sorted(cards.lost.items()):
        word = "lost, as allowed" if name.upper() in allowed else "LOST"
        lines.append(f"{word}: {name} {count}, first at {cards.first[name]}: {cards.why[name]}")
    return lines


def model_told(scene, mass: float, centre, expected: float | None) -> list:
    """Lines about what was written."""
    model = scene.model
    kinds = Counter(element.kind for element in model.elements)
    kinds["point_mass"] = len({mass.node for mass in model.masses})
    kinds["spring"] = sum(len(spring.nodes) == 2 for spring in model.springs)
    kinds["grounded_spring"] = sum(len(spring.nodes) == 1 for spring in model.springs)
    lines = [f"nodes {len(scene.joints.used)}, elements: {_table(+kinds)}"]
    held = Counter(COMPONENTS[k] for mask in scene.held.values() for k in range(6) if mask >> k & 1)
    supports = ", ".join(f"{name} {held[name]}" for name in COMPONENTS if held[name])
    lines.append(f"supported nodes {len(scene.held)}" + (f": {supports}" if supports else ""))
    for what, count in (("rigid bodies", len(scene.joints.rigid) + len(scene.joints.in_part)), ("arms", len(scene.joints.joined)),
                        ("hinges and pins", len(scene.joints.pins)), ("ties", len(model.ties)),
                        ("stops with a gap", len(scene.contacts))):
        if count:
            lines.append(f"{what} {count}")
    if model.has_properties:
        text = f"mass {mass:.9g} kg"
        if expected is not None:
            text += f", expected {expected:.9g} kg: {100 * (mass / expected - 1):+.4f} %"
        if centre:
            text += ", centre of gravity " + ", ".join(f"{value:.7g}" for value in centre) + " m"
        lines.append(text)
    return lines + model.said


def modes_told(scene: Path, structure: str, modes: int) -> tuple:
    """Lines with the mass and the modes that the program finds, and its complaint or ''. Throws RunError where it is
    not built."""
    with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
        said, failure = alone("-options_file", scene, "-dry_run", "-modes", modes, "-output", folder)
    if failure:
        return [], failure
    lines = []
    for line in said.split("\n"):
        if line.startswith((f"structure {structure}:", "warning:", "  a step of its solids")):
            lines.append(line)
        elif re.match(r"  mode  frequency|  +\d+ +[\d.e+-]+  ", line):
            lines.append(line)
    return lines, ""
