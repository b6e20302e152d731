"""Runs that need not be repeated: what they were asked for, what they read and what they left is as it was."""

import errno
import functools
import hashlib
import json
import os
import stat
from pathlib import Path

from pounding.files import write_text
from pounding.results import result_files

REQUEST, SUMMARY = "request.json", "summary.json"
WHOLE = 64 * 2**20  # files up to so many bytes are compared by their contents, larger ones by their size
BASIS = "_modal_basis"  # kept by runs for other runs; the program sees itself whether one is that of its structure


def digest(path: Path) -> str:
    """SHA-256 of a file, computed once while the system says that it is the same. Throws OSError."""
    told = os.stat(path)
    if not stat.S_ISREG(told.st_mode):  # a pipe would be waited for
        raise OSError(errno.EINVAL, "no file with contents", str(path))
    return _digest(str(path), told.st_dev, told.st_ino, told.st_size, told.st_mtime_ns, told.st_ctime_ns)


@functools.lru_cache(maxsize=10000)
def _digest(path: str, *_told: int) -> str:
    found = hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(2**20):
            found.update(block)
    return found.hexdigest()


def inputs_of(summary: dict) -> dict:
    """Path, as the program that ran named it -> hash of what it read, from its summary, bases left out. Throws
    ValueError where the summary does not tell."""
    try:
        return {str(one["file"]): str(one["sha256"]) for one in summary["inputs"]
                if not str(one["option"]).endswith(BASIS)}
    except (KeyError, TypeError) as error:
        raise ValueError("it does not list the inputs of the run") from error


def folders_of(summary: dict) -> dict:
    """Folder of matrices -> names in it: one that is added is read as well."""
    found = {}
    for one in summary["inputs"]:
        if str(one["option"]).endswith("_matrices"):
            found[str(Path(one["file"]).parent)] = []
    return found


def _names(folder: Path, of: dict) -> dict:
    """The same with the names of today. Throws OSError."""
    return {place: sorted(path.name for path in (folder / place).iterdir()) for place in of}


def are_current(inputs: dict, folder: Path) -> bool:
    """Whether all files, named from `folder`, where the program runs, are those that were read."""
    try:
        return all(digest(folder / path) == found for path, found in inputs.items())
    except (OSError, ValueError):
        return False


def _left(folder: Path, names: tuple) -> dict:
    """Name -> size and, of all but large ones, hash of the files among `names` that are there."""
    found = {}
    for name in names:
        path = folder / name
        if path.is_file() and not path.is_symlink():
            size = path.stat().st_size
            found[name] = [size, digest(path) if size <= WHOLE else ""]
    return found


def _summary(place: Path) -> dict:
    """Throws OSError or ValueError."""
    found = json.loads((place / SUMMARY).read_text(encoding="utf-8"))
    if not isinstance(found, dict):
        raise ValueError(f"{place / SUMMARY} is no summary of a run")
    return found


def is_finished(words: list, place: Path, folder: Path) -> bool:
    """Whether `place` holds the results of a run by this command line, whole, and every file that it read is still
    what it was; `folder`: where the program would run. The program's version is none of it."""
    try:
        done = json.loads((place / REQUEST).read_text(encoding="utf-8"))
        return (done["words"] == [str(word) for word in words] and SUMMARY in done["left"]
                and _left(place, tuple(done["left"])) == done["left"]
                and _names(folder, done["folders"]) == done["folders"]
                and are_current(inputs_of(_summary(place)), folder))
    except (OSError, ValueError, KeyError, TypeError):
        return False


def begin_anew(place: Path) -> None:
    """What is in the place is finished no longer."""
    for name in (REQUEST, SUMMARY):
        (place / name).unlink(missing_ok=True)


def sign(words: list, place: Path, folder: Path, more: tuple = ()) -> str:
    """Marks what a run from `folder` left, and `more` files, as finished: '' or, where it did not leave what it should,
    one line."""
    try:
        told = _summary(place)
        inputs_of(told)
        request = {"words": [str(word) for word in words], "left": _left(place, (*result_files(place), *more)),
                   "folders": _names(folder, folders_of(told))}
        write_text(place / REQUEST, json.dumps(request, indent=1))
    except (OSError, ValueError) as error:
        return f"{place / SUMMARY}: {' '.join(str(error).split())}"
    return ""
