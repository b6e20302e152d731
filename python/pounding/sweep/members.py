"""Members of a sweep: which options each has, where its results are, whether it is finished."""

import hashlib
import itertools
import re
from dataclasses import dataclass
from pathlib import Path

from pounding import UserError
from pounding.study import Run
from pounding.runs import words_of


@dataclass(frozen=True)
class Axis:
    """What one --set says: names of options that share a value, and the values."""

    names: tuple
    values: tuple

    @property
    def title(self) -> str:
        return ",".join(self.names)


@dataclass(frozen=True)
class Member:
    """`values`: one of each axis; `options`: of the command line."""

    name: str
    values: tuple
    options: tuple

    def run(self, scene: Path, more: list, place: Path, folder: Path) -> Run:
        """`place`: of its results; `folder`: where the program runs."""
        return Run((*words_of(scene, dict(self.options)), *more), place, folder)


def read_axis(text: str) -> Axis:
    """NAME=v1,v2 or NAME,NAME=v1,v2; values with commas of their own stand between semicolons."""
    names, equals, values = text.partition("=")
    found = [name.strip().lstrip("-") for name in names.split(",")]
    items = [value.strip() for value in values.split(";" if ";" in values else ",")]
    if not equals or not all(re.fullmatch(r"[A-Za-z]\w*", name) for name in found):
        raise UserError(f"--set {text}: expected NAME=value,value or NAME,NAME=value,value (the same for both)")
    if "" in items:
        raise UserError(f"--set {text}: an empty value; those with commas of their own stand between semicolons")
    if any(re.match(r"-[A-Za-z]", item) for item in items):
        raise UserError(f"--set {text}: a value that begins with a dash and a letter would be an option")
    if "output" in found or "dry_run" in found or "restart" in found:
        raise UserError(f"--set {text}: not with output, dry_run or restart; --out gives the folder of all members")
    if len(set(items)) < len(items):
        raise UserError(f"--set {text}: a value stands twice")
    return Axis(tuple(found), tuple(items))


def _folder_name(axes: list, values: tuple) -> str:
    """Made of the options and values; with a number of its own where letters had to go."""
    words = [f"{axis.names[0]}={Path(value).name if '/' in value else value}" for axis, value in zip(axes, values)]
    plain = "+".join(words)
    name = re.sub(r"[^\w.=+-]", "-", plain)[:100]
    exact = "+".join(f"{axis.title}={value}" for axis, value in zip(axes, values))
    told = name == plain and not any("/" in value for value in values)
    return name if told else f"{name}.{hashlib.sha256(exact.encode()).hexdigest()[:6]}"


def all_members(axes: list, together: bool) -> list:
    """The product of the axes, or with `together` the first values of all, then the second, and so on."""
    names = [name for axis in axes for name in axis.names]
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise UserError(f"{twice} is set twice")
    if together and len({len(axis.values) for axis in axes}) > 1:
        raise UserError("--zip needs as many values for every --set: "
                        + ", ".join(f"{axis.title} has {len(axis.values)}" for axis in axes))
    tuples = zip(*(axis.values for axis in axes)) if together else itertools.product(*(axis.values for axis in axes))
    return [Member(_folder_name(axes, values), values,
                   tuple((name, value) for axis, value in zip(axes, values) for name in axis.names))
            for values in tuples]
