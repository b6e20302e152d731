"""Mats on incoherent ground as a user tells of them, and their motions as supports of a scene."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pounding.coherency import Coherency, CoherencyError, model_of
from pounding.incoherent import COMPONENTS, Mat, Wave
from pounding.tables import write_rows

KEYS = ("mats", "model", "wave", "seed")


@dataclass(frozen=True)
class Coherence:
    """`groups`: of each mat what stands on it, as the option <support>_groups has it. `told`: as it was given."""

    mats: tuple
    groups: dict
    model: Coherency
    wave: Wave | None
    seed: int
    told: dict


def numbers(values, count: int, place: str, above: float = -np.inf) -> tuple:
    items = values.split(",") if isinstance(values, str) else values if isinstance(values, (list, tuple)) else [values]
    try:
        found = tuple(float(item) for item in items)
    except (TypeError, ValueError):
        found = ()
    if len(found) != count or not all(above < one < np.inf for one in found):
        more = "" if above == -np.inf else f" above {above:g}"
        raise CoherencyError(f"{place}: {values!r} is not {count} number{'s' if count > 1 else ''}{more}")
    return found


def mapping(values, place: str, known: tuple) -> dict:
    if not isinstance(values, dict):
        raise CoherencyError(f"{place}: {values!r} is no list of keys and values")
    unknown = next((key for key in values if key not in known), None)
    if unknown is not None:
        raise CoherencyError(f"{place}: {unknown} is unknown; it has {', '.join(known)}")
    return values


def read(values, folder: Path) -> Coherence:
    """What the keys KEYS of a file tell, whose tables lie in the folder. Throws CoherencyError or OSError."""
    told = mapping(values, "coherence", KEYS)
    mats, groups = [], {}
    given = told.get("mats") or {}
    if not isinstance(given, dict):
        raise CoherencyError(f"mats: {given!r} is no list of names with centre and sides")
    if len(given) < 2:
        raise CoherencyError(f"mats: coherence tells how mats move apart, and there is {'one' if given else 'none'}; give two or more")
    for name, one in given.items():
        one = mapping(one, f"mats: {name}", ("centre", "sides", "groups"))
        mats.append(Mat(str(name), numbers(one.get("centre"), 3, f"mats: {name}: centre"),
                        numbers(one.get("sides"), 2, f"mats: {name}: sides", 0.0)))
        groups[str(name)] = str(one.get("groups", name))
    return Coherence(tuple(mats), groups, model_of(told.get("model"), folder), read_wave(told), read_seed(told), told)


def read_wave(told: dict) -> Wave | None:
    if not told.get("wave"):
        return None
    one = mapping(told["wave"], "wave", ("speed", "towards"))
    wave = Wave(*numbers(one.get("speed"), 1, "wave: speed", 0.0), numbers(one.get("towards"), 2, "wave: towards"))
    if not any(wave.towards):
        raise CoherencyError("wave: towards: a wave has a direction, as 1,0")
    return wave


def read_seed(told: dict) -> int:
    seed = told.get("seed", 1)
    if isinstance(seed, bool) or not isinstance(seed, int) or seed < 0:
        raise CoherencyError(f"seed: {seed!r} is not a whole number from 0 on")
    return seed


def components(motions: dict) -> list:
    """Components that any mat has, rotations only where some mat turns."""
    return [name for name in COMPONENTS if any(name in own and (len(name) == 1 or own[name].any()) for own in motions.values())]


def write(path: Path, motion: dict, step: float, names: list) -> None:
    """The motion of a mat as a file of columns that the program reads."""
    columns = [motion[name] for name in names]
    write_rows(path, ["time", *names], ([f"{number * step:.9g}", *(f"{value:.17g}" for value in row)]
                                        for number, row in enumerate(zip(*columns))), exact=True)


def support_of(mat: str) -> str:
    """Name of the support that moves a mat, which may be called as its structure is."""
    return f"ground_{mat}"


def option_of(mat: str, component: str) -> str:
    """Beginning of the names of options of a component of the motion of a mat's support."""
    return f"{support_of(mat)}_{'motion' if len(component) == 1 else 'rotation'}_{component[-1]}"


def support_options(coherence: Coherence, names: list, files: dict) -> dict:
    """Options of a scene in which the mats are supports that move by these files, per mat."""
    found = {"supports": ",".join(support_of(mat.name) for mat in coherence.mats)}
    for mat in coherence.mats:
        found[f"{support_of(mat.name)}_groups"] = coherence.groups[mat.name]
        if any(len(name) == 2 for name in names):
            found[f"{support_of(mat.name)}_point"] = ",".join(f"{one:.9g}" for one in mat.centre)
        for place, name in enumerate(names):
            option = option_of(mat.name, name)
            found |= {f"{option}_record": str(files[mat.name]), f"{option}_column": str(place + 2)}
            if len(name) == 1:
                found[f"{option}_unit"] = "m/s2"
    return found
