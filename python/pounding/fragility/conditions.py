"""Soils under the mats and states of the buildings of a study: all of its samples are run in each pair of them; and, beside
incoherent ground, in the first of them on coherent ground."""

import re
from dataclasses import dataclass, replace

from pounding import UserError
from .study import Study, read_motions
from .study_file import ALONE, Reader, given_options

NAME = re.compile(r"\w[\w-]*")


@dataclass(frozen=True, eq=False)
class Condition:
    """Soil and state, and the study in them. `coherent`: on ground that moves all mats alike, where the study's does not;
    such a condition shows what coherence moves and is no part of the envelope."""

    soil: str
    state: str
    study: Study
    coherent: bool = False

    @property
    def title(self) -> str:
        return ", ".join([f"soil {self.soil}"] * (self.soil != ALONE) + [f"state {self.state}"] * (self.state != ALONE)
                         + ["coherent ground"] * self.coherent) or ALONE

    @property
    def folder(self) -> str:
        return "_".join([name for name in (self.soil, self.state) if name != ALONE] + ["coherent"] * self.coherent) or "as_given"

    @property
    def place(self) -> dict:
        return {"soil": self.soil, "state": self.state}


@dataclass(frozen=True)
class Soil:
    """Options, and motions in place of those of the study (none: the study's)."""

    options: dict
    axes: dict


def _blocks(reader: Reader, key: str) -> dict:
    """Name -> block of a list of named blocks; one without name where there is none."""
    values = reader.values.get(key)
    if values is None:
        return {ALONE: {}}
    if not isinstance(values, dict) or not values:
        reader.fail(key, f"is no list of named {key}, as `{key}: {{best: {{}}}}`")
    for name in values:
        if not NAME.fullmatch(str(name)) or name == ALONE:
            raise UserError(f"{reader.path}: {key}: {name!r} is no name of letters, digits, - and _")
    return {str(name): values[name] or {} for name in values}


def structures_on_soil(study: Study) -> list:
    """Structures whose scene lays a mat on soil."""
    given = {**given_options(study.scene), **study.options}
    return [name.removesuffix("_soil_mat") for name, value in given.items()
            if name.endswith("_soil_mat") and value != "none"]


def _soil(reader: Reader, name: str, block: dict, study: Study) -> Soil:
    one = Reader(block, reader.path, f"soils: {name}", ("factor", "options", "motions"))
    options, factor = one.options("options"), one.number("factor", 1.0, 0.0)
    structures = structures_on_soil(study)
    if "factor" in one.values and not structures:
        one.fail("factor", f"has no soil: no structure of {study.scene.name} has a soil_mat")
    if factor != 1:
        options |= {f"{structure}_soil_factor": f"{factor:.9g}" for structure in structures}
    if "motions" not in one.values:
        return Soil(options, {})
    axes, *_, count = read_motions(one)
    if list(axes) != list(study.axes) or count != study.motion_count:
        one.fail("motions", "has other axes, or another number of motions, than the study")
    return Soil(options, axes)


def find(study: Study) -> list:
    """The conditions of a study; none where it names neither soils nor states, nor asks for coherent ground beside its own.
    Throws UserError."""
    reader = Reader({key: study.named[key] for key in ("soils", "states") if study.named[key] is not None}, study.path, "",
                     ("soils", "states"))
    if not reader.values and not study.coherent_too:
        return []
    soils = {name: _soil(reader, name, block, study) for name, block in _blocks(reader, "soils").items()}
    states = {name: Reader({name: block}, study.path, "states", (name,)).options(name)
              for name, block in _blocks(reader, "states").items()}
    found = []
    for soil, of_soil in soils.items():
        for state, of_state in states.items():
            twice = sorted((set(of_soil.options) & set(of_state)) - {"modes"})
            if twice:
                raise UserError(f"{study.path}: {twice[0]} is given by soil {soil} and by state {state}")
            options = {**study.options, **of_soil.options, **of_state}
            found.append(Condition(soil, state, replace(study, options=options, axes=of_soil.axes or study.axes)))
    if study.coherent_too:
        first = found[0]
        found.append(replace(first, study=replace(first.study, coherence=None), coherent=True))
    return found
