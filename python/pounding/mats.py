"""Mats on incoherent ground as a user tells of them, and their motions as supports of a scene."""

from dataclasses import dataclass
from pathlib import Path

from pounding.coherency import Coherency, CoherencyError, model_of
from pounding.fragility.study_file import Reader
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


def read(reader: Reader) -> Coherence:
    """What the keys KEYS of a file, or of the block of one, tell; its tables lie beside it. Throws UserError."""
    given = reader.values.get("mats") or {}
    if not isinstance(given, dict):
        reader.fail("mats", "is no list of names with centre and sides")
    if len(given) < 2:
        reader.refuse("mats", f"coherence tells how mats move apart, and there is {'one' if given else 'none'}; give two or more")
    blocks = {name: reader.part("mats", tuple(given)).part(name, ("centre", "sides", "groups")) for name in given}
    mats = tuple(Mat(str(name), tuple(one.numbers("centre", count=3)), tuple(one.numbers("sides", None, 0.0, count=2)))
                 for name, one in blocks.items())
    return Coherence(mats, {str(name): str(one.values.get("groups", name)) for name, one in blocks.items()}, *read_ground(reader),
                     reader.values)


def read_ground(reader: Reader) -> tuple:
    """Model of the coherency, the wave that passes, if there is one, and the seed. Throws UserError."""
    try:
        model = model_of(reader.values.get("model"), reader.path.parent)
    except (CoherencyError, OSError) as error:
        reader.refuse("", error)
    wave = None
    if reader.values.get("wave"):
        one = reader.part("wave", ("speed", "towards"))
        wave = Wave(one.number("speed", None, 0.0), tuple(one.numbers("towards", count=2)))
        if not any(wave.towards):
            one.refuse("towards", "a wave has a direction, as 1,0")
    return model, wave, reader.whole("seed", 1, 0)


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
