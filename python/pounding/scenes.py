"""Scenes as dictionaries: {"end_time": 5, "left": {"mesh": "left.geo"}} or flat {"left_mesh": "left.geo"}."""

import re
from pathlib import Path

from pounding import UserError
from .files import write_bytes


class SceneError(UserError):
    """A scene that cannot be written or read: one line for the user."""


def value_text(value) -> str:
    """A value as the program reads it: true and false, `none` for None, items joined by commas."""
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return ",".join(value_text(item) for item in value)
    if isinstance(value, float):
        return repr(value)
    return str(value)


def flatten(scene: dict, prefix: str = "") -> dict:
    """Option -> text, nested names joined by _ as the program does. Throws SceneError where a name comes twice or
    is none."""
    options = {}
    for name, value in scene.items():
        if not re.fullmatch(r"[A-Za-z][\w/.]*", str(name), re.ASCII):
            raise SceneError(f"'{name}' is not a name of an option")
        own = flatten(value, f"{prefix}{name}_") if isinstance(value, dict) else {f"{prefix}{name}": value_text(value)}
        for option, text in own.items():
            if options.setdefault(option, text) is not text:
                raise SceneError(f"{option} stands twice in the scene")
    return options


def _quoted(text: str) -> str:
    escapes = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t"}
    escapes |= {chr(code): f"\\x{code:02x}" for code in [*range(32), 127] if chr(code) not in escapes}
    return '"' + "".join(escapes.get(letter, letter) for letter in text) + '"'


def _lines(scene: dict, indent: str) -> list:
    lines = []
    for name, value in scene.items():
        if isinstance(value, dict):
            lines += [f"{indent}{name}:"] + _lines(value, indent + "  ")
        else:
            lines.append(f"{indent}{name}: {_quoted(value_text(value))}")
    return lines


def write_scene(path: Path | str, scene: dict, comment: str = "") -> Path:
    """Writes the scene as an options file in YAML, nested as it is given, under a comment of one line or more, and
    returns its path. Throws SceneError, or OSError if it cannot be written; a file that is there then stays as it
    was."""
    path, options = Path(path), flatten(scene)
    for name, text in options.items():
        if any(letter in text for letter in "\0\r\x85\u2028\u2029") or not text.isascii() and _not_utf_8(text):
            raise SceneError(f"{name}: {text!a} has letters that no file of options can hold")
    head = [f"# {line}".rstrip() for line in comment.splitlines()]
    write_bytes(path, ("\n".join(head + _lines(scene, "")) + "\n").encode("utf-8", "surrogateescape"))
    return path


def _letter(escape: re.Match) -> str:
    code = escape[1]
    return chr(int(code[1:], 16)) if len(code) == 3 else {"n": "\n", "t": "\t"}.get(code, code)


def _not_utf_8(text: str) -> bool:
    try:
        text.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        return True
    return False


def read_scene(path: Path | str) -> dict:
    """Option -> text of a `resolved.yaml`, or of another file of flat lines `name: "value"`. Throws SceneError,
    or OSError if there is none."""
    options = {}
    text = Path(path).read_text(encoding="utf-8", errors="surrogateescape")  # names of files are bytes
    for number, line in enumerate(text.split("\n"), 1):
        if not line.strip() or line.startswith("#"):
            continue
        found = re.fullmatch(r'"?([A-Za-z][\w/.]*)"?: "((?:[^"\\]|\\.)*)"', line)
        if not found:
            raise SceneError(f"{path}, line {number}: not a line of resolved options")
        options[found[1]] = re.sub(r"\\(x[0-9a-f]{2}|.)", _letter, found[2])
    return options
