"""Sticks of beams without mass, whose mass is that of points: the scaled mass that lets the program step them."""

import json
import math
import tempfile
from pathlib import Path

from pounding.files import write_text
from pounding.runs import RunError, alone
from pounding.scenes import write_scene

HIGHEST, MOST = 33.0, 1e-3  # modes up to this frequency [Hz] move by at most this part of it
TRIED = 60  # modes
# Mass of c K, c = dt^2 / 4, divides a frequency by sqrt(1 + c omega^2), or by less where other elements carry a part.
SURE = math.sqrt(1 / (1 - MOST)**2 - 1) / (math.pi * HIGHEST)


def _frequencies(options: dict, name: str, mesh: str, step: float) -> list:
    """Of the scene with this step; [] where the program refuses it. Throws RunError where it is not built."""
    with tempfile.TemporaryDirectory(prefix="pounding-") as folder:
        scene = Path(folder, "scene.yaml")
        write_text(scene.with_name(options[name]["mesh"]), mesh)
        write_scene(scene, {**options, name: {**options[name], "mass_scaling": step}}, "")
        if alone("-options_file", scene, "-end_time", "1e-12", "-modes", TRIED, "-output", scene.parent)[1]:
            return []
        structures = json.loads((scene.parent / "summary.json").read_text())["structures"]
        return sorted(mode["frequency"] for mode in structures[name].get("frequencies", []))


def _moved(true: list, found: list) -> float:
    """The largest change of a mode up to HIGHEST, as a part of it; infinite where there are more of them."""
    if len(found) < len(true) or sum(f <= HIGHEST for f in found) > len(true):
        return math.inf
    return max((abs(a / b - 1) for a, b in zip(found, true) if b > 0), default=0.0)


def scaling_of(options: dict, name: str, mesh: str) -> tuple:
    """The largest step of `mass_scaling`, to three digits, that moves no mode up to HIGHEST by more than MOST, and a
    line that says so."""
    told = f"as dofs without mass follow, mass_scaling {{}} s: it moves no mode below {HIGHEST:g} Hz by more than .1 %"

    def shortened(step: float) -> float:
        digits = 2 - math.floor(math.log10(step))
        return math.floor(step * 10**digits) / 10**digits

    sure = shortened(SURE)
    try:
        all_ = _frequencies(options, name, mesh, sure / 10)
    except RunError:
        all_ = []
    true = [f for f in all_ if f <= HIGHEST]
    if not any(true) or len(all_) == TRIED == len(true):
        return sure, told.format(f"{sure:g}")
    best, moved = sure, _moved(true, _frequencies(options, name, mesh, sure))
    long = shortened(SURE * HIGHEST / true[-1])
    for _ in range(5):
        found = _moved(true, _frequencies(options, name, mesh, long)) if long > best else math.inf
        if found <= MOST:
            best, moved = long, found
            if found > 0.9 * MOST or not found:
                break
            long = shortened(long * min(math.sqrt(MOST / found), 4.0))
        else:
            long = shortened(math.sqrt(best * long))
    return best, told.format(f"{best:g}") + f" ({len(true)} modes, the highest {true[-1]:.4g} Hz, by {100 * moved:.2g} %)"
