"""The file of a study as keys that are taken one by one; what is wrong with them is one line with its place."""

import re
from pathlib import Path

import yaml

from pounding import UserError
from pounding.scenes import SceneError, flatten


ALONE = "as given"  # soil or state of a study that names none


def place_of(condition) -> dict:
    """Soil and state of a condition; nothing of None, which stands for the only one of a study."""
    return condition.place if condition else {}


class Reader:
    """A mapping of the file whose keys are taken one by one; what is wrong is told with its place."""

    def __init__(self, values, path: Path, place: str, known: tuple):
        self.path, self.place = path, place
        if not isinstance(values, dict):
            raise UserError(f"{path}: {place or 'the file'} is no list of keys and values")
        self.values = values
        for key in values:
            if key not in known:
                raise UserError(f"{path}: {self._at(key)} is unknown; {place or 'it'} has {', '.join(known)}")

    def _at(self, key) -> str:
        return f"{self.place}: {key}" if self.place else str(key)

    def refuse(self, key: str, why):
        """Throws UserError of a key, or of all of them where it is ''."""
        raise UserError(": ".join(filter(None, (str(self.path), self.place, str(key), str(why)))))

    def fail(self, key: str, why: str):
        """The same with the value of the key."""
        self.refuse(key, f"{self.values.get(key)!r} {why}")

    def number(self, key: str, default=None, above: float | None = None, below: float | None = None) -> float:
        value = self.values.get(key, default)
        if value is None:
            raise UserError(f"{self.path}: {self._at(key)} is missing")
        try:
            value = float(value) if isinstance(value, str) else value  # as YAML takes 30e6
        except ValueError:
            self.fail(key, "is not a number")
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) < float("inf"):
            self.fail(key, "is not a number")
        if above is not None and not value > above:
            self.fail(key, f"is not above {above:g}")
        if below is not None and not value < below:
            self.fail(key, f"is not below {below:g}")
        return float(value)

    def optional(self, key: str, above: float | None = None) -> float | None:
        """A number, or None where there is none."""
        return self.number(key, None, above) if key in self.values else None

    def one_of(self, key: str, known, default, whose: str = "the study's") -> float:
        """A number that is among those that are known."""
        value = self.number(key, default)
        if value not in known:
            self.fail(key, f"is none of {whose} {', '.join(f'{one:g}' for one in known)}")
        return value

    def whole(self, key: str, default: int, least: int) -> int:
        value = self.values.get(key, default)
        if isinstance(value, bool) or not isinstance(value, int) or value < least:
            self.fail(key, f"is not a whole number from {least} on")
        return value

    def flag(self, key: str) -> bool:
        value = self.values.get(key, False)
        if not isinstance(value, bool):
            self.fail(key, "is neither true nor false")
        return value

    def numbers(self, key: str, default=None, least: float | None = None, count: int = 0) -> list:
        """A list, or text of numbers between commas; `count`: how many, where that is fixed."""
        value = self.values.get(key, default)
        if value is None:
            raise UserError(f"{self.path}: {self._at(key)} is missing")
        items = value.split(",") if isinstance(value, str) else value if isinstance(value, (list, tuple)) else [value]
        try:
            found = [float(item) for item in items]
        except (TypeError, ValueError):
            self.fail(key, "is not a list of numbers")
        if not found or any(not abs(one) < float("inf") for one in found):
            self.fail(key, "is not a list of numbers")
        if count and len(found) != count:
            self.fail(key, f"is not {count} numbers{'' if least is None else f' above {least:g}'}")
        if least is not None and any(not one > least for one in found):
            self.fail(key, f"has a number that is not above {least:g}")
        return found

    def increasing(self, key: str, default=None, least: float = 0.0) -> list:
        found = self.numbers(key, default, least)
        if any(b <= a for a, b in zip(found, found[1:])):
            self.fail(key, "does not increase")
        return found

    def entries(self, key: str) -> list:
        values = self.values.get(key)
        if values is not None and not isinstance(values, list):
            self.fail(key, "is no list, each entry of which begins with -")
        return values or []

    def options(self, key: str) -> dict:
        values = self.values.get(key) or {}
        if not isinstance(values, dict):
            self.fail(key, "is no list of options")
        try:
            found = flatten(values)
        except SceneError as error:
            raise UserError(f"{self.path}: {self._at(key)}: {error}") from error
        for name in ("output", "dry_run", "restart", "ensemble", "include"):
            if name in found:
                raise UserError(f"{self.path}: {self._at(key)}: {name} is the study's own")
        return {name: beside(self.path, text) for name, text in found.items()}

    def part(self, key: str, known: tuple) -> "Reader":
        return Reader(self.values.get(key) or {}, self.path, self._at(key), known)


def beside(study: Path, text: str) -> str:
    """The absolute path of a file beside the study, where there is one; else the text."""
    path = study.parent / text
    return str(path.resolve()) if re.search(r"/|\.\w+$", text) and path.is_file() else text


def given_options(path: Path) -> dict:
    """Option -> text of a file of options and of those that it includes; nothing of what cannot be read here."""
    try:
        found = yaml.safe_load(path.read_text(encoding="utf-8"))
        options = flatten(found) if isinstance(found, dict) else {}
    except (OSError, ValueError, yaml.YAMLError, SceneError, RecursionError):
        return {}
    for name in filter(None, options.pop("include", "").split(",")):
        options = {**(given_options(path.parent / name.strip()) if (path.parent / name.strip()) != path else {}), **options}
    return options


class _Loader(yaml.SafeLoader):
    """Refuses a key that stands twice, of which YAML takes the last."""

    def construct_mapping(self, node, deep=False):
        keys = [key.value for key, _ in node.value if isinstance(key, yaml.ScalarNode)]
        twice = next((key for place, key in enumerate(keys) if key in keys[:place] and key != "<<"), None)
        if twice is not None:
            raise yaml.constructor.ConstructorError(None, None, f"{twice} stands twice", node.start_mark)
        return super().construct_mapping(node, deep)

    def flatten_mapping(self, node):
        super().flatten_mapping(node)
        if len(node.value) > 10000:  # merges of merges, which double at each level
            raise yaml.constructor.ConstructorError(None, None, "more than 10000 merged keys", node.start_mark)


def load(path: Path):
    if path.exists() and not path.is_file():  # a pipe would be waited for
        raise UserError(f"{path}: no file with contents")
    try:
        return yaml.load(path.read_text(encoding="utf-8"), _Loader)
    except OSError as error:
        raise UserError(f"{path}: {error.strerror}") from error
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise UserError(f"{path}: {' '.join(str(error).split())}") from error
