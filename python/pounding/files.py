"""Files that are written whole or not at all, beside what is there, and never through a symbolic link."""

import hashlib
import os
import re
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def written_beside(path: Path | str) -> Iterator[Path]:
    """The name of a new, empty file beside `path`, which takes its place when the block has ended well; a link there is
    replaced, not followed. Where the block fails nothing is left, and what was there stays."""
    path = Path(path)
    draft = path.with_name(f".{secrets.token_hex(6)}{path.suffix}")
    try:
        os.close(os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666))
        yield draft
        os.replace(draft, path)
    except OSError as error:
        if error.errno is None:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error
    finally:
        draft.unlink(missing_ok=True)


def write_bytes(path: Path | str, content: bytes) -> None:
    """Throws OSError, and leaves what was there."""
    with written_beside(path) as draft, open(draft, "wb") as file:
        file.write(content)


def write_text(path: Path | str, text: str) -> None:
    """As write_bytes, in UTF-8; text that is none throws UnicodeEncodeError."""
    write_bytes(path, text.encode("utf-8"))


def open_new(path: Path | str):
    """A text file to be written that is read while it grows: what had its name before, a link too, has it no longer."""
    path = Path(path)
    path.unlink(missing_ok=True)
    return open(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666), "w")


def file_name(text: str) -> str:
    """A name of a file in a folder, made of a name of a user's: letters, digits, _ . + = -; where others had to go, or
    the name is long, with a number of its own, so that two names never share a file."""
    name = re.sub(r"[^\w.+=-]", "-", text, flags=re.ASCII)[:100].lstrip(".")
    return name if name == text else f"{name}.{hashlib.sha256(text.encode('utf-8', 'replace')).hexdigest()[:6]}"
