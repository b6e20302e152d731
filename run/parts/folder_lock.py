"""One command at a time in a folder of results."""

import errno
import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

LOCK = ".command.lock"


class FolderTaken(OSError):
    """Another command works in the folder: one line for the user."""


@contextmanager
def alone_in(folder: Path, name: str, shared: bool = False, wait: bool = False) -> Iterator[None]:
    """Makes the folder and keeps other commands out of it until the block ends; the lock ends with the process, however
    that dies. `name`: what this command is called; `shared`: beside others that share it; `wait`: for those that do
    not. Where the file system has no locks nobody is kept out. Throws FolderTaken."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / LOCK
    lock = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666)
    try:
        try:
            fcntl.flock(lock, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | (0 if wait else fcntl.LOCK_NB))
        except OSError as error:
            if error.errno in (errno.EWOULDBLOCK, errno.EAGAIN, errno.EACCES):
                other = os.read(lock, 200).decode(errors="replace").strip() or "another command"
                raise FolderTaken(f"{folder}: {other} works there; wait until it has ended, or give another "
                                  "folder") from None
        if not shared:
            os.ftruncate(lock, 0)
            os.pwrite(lock, f"{name}, process {os.getpid()} on {os.uname().nodename},".encode(), 0)
        yield
    finally:
        os.close(lock)
