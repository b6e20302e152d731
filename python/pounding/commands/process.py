"""A command as a process: the reader of its line, how it ends, and what it says then."""

import argparse
import atexit
import io
import os
import signal
import sys
import traceback
from pathlib import Path
from typing import Callable, NoReturn

from pounding import UserError

from . import called


def printable(text: str) -> str:
    """In one line, whatever a file's names have in them."""
    return "".join(letter if letter.isprintable() else ascii(letter)[1:-1] for letter in text)


def line_of(error: BaseException) -> str:
    """What an error says, in one line; of the system's the file first."""
    named = isinstance(error, OSError) and error.filename and error.strerror
    return printable(f"{error.filename}: {error.strerror}" if named else " ".join(map(str.strip, str(error).split("\n"))))


# What the commands need of others; the packages of Debian are python3-numpy and so on.
NEEDED = ("numpy", "scipy", "h5py", "jinja2", "matplotlib", "yaml")
_told = ""  # what the command is called
STOPPING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class Unheard(io.FileIO):
    """A standard stream whose reader may go: its words end then, and not the command."""

    def write(self, data) -> int:
        try:
            return super().write(data)
        except BrokenPipeError:
            return len(data)


def open_streams() -> None:
    """Standard streams that were closed take words and lose them, so that no file gets them that is opened later; of
    terminals that have few letters, others are written in numbers."""
    while (opened := os.open(os.devnull, os.O_RDWR)) <= 2:  # the lowest that is free
        os.set_inheritable(opened, True)
    os.close(opened)
    for number, name in ((1, "stdout"), (2, "stderr")):
        stream = getattr(sys, name)
        encoding = stream.encoding if hasattr(stream, "encoding") else "utf-8"
        if stream is None or hasattr(stream, "reconfigure"):
            buffered = io.BufferedWriter(Unheard(number, "w", closefd=False))
            setattr(sys, name, io.TextIOWrapper(buffered, encoding=encoding, errors="backslashreplace",
                                                line_buffering=number == 2 or os.isatty(number)))


def begin(name: str) -> str:
    """For the first line of a command: what it is called, and how it ends when it does not end by itself: in one line.
    While it is made ready a signal ends it at once; what nobody thought of has exit status 2."""
    global _told
    told = _told = called(name)

    def leave(line: str, status: int) -> None:
        try:
            sys.stdout.flush()
        except OSError:  # the disk is full
            pass
        try:
            print(f"{told}: {line}", file=sys.stderr, flush=True)
        finally:
            os._exit(status)

    def tell(kind, error, trace) -> None:
        if os.environ.get("POUNDING_TRACE"):
            traceback.print_exception(kind, error, trace)
        words = " ".join(str(error).split())
        if issubclass(kind, KeyboardInterrupt):
            leave("interrupted", 1)
        if issubclass(kind, ModuleNotFoundError) and error.name in NEEDED:
            leave(f"{error}; install python3-{error.name}", 1)
        if issubclass(kind, (OSError, MemoryError)):
            leave(line_of(error) or "the memory does not hold what it reads", 1)
        place = traceback.extract_tb(trace)[-1] if trace else None
        where = f", {Path(place.filename).name} line {place.lineno}" if place else ""
        leave(f"fault of the command itself ({kind.__name__}: {words}{where}); POUNDING_TRACE=1 shows how it came "
              "there", 2)

    def flush() -> None:
        try:
            sys.stdout.flush()
        except OSError as error:
            leave(f"what it says cannot be written: {error.strerror}", 1)

    open_streams()
    sys.excepthook = tell
    atexit.register(flush)
    for number in STOPPING:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, lambda *_: leave("interrupted", 1))
    return told


def parser_of(about: str) -> argparse.ArgumentParser:
    """Reader of the command's line, whose help is the text about it as it is written."""
    return argparse.ArgumentParser(prog=_told, description=called(about),
                                   formatter_class=argparse.RawDescriptionHelpFormatter)


def end(main: Callable, goes_on: bool = False) -> NoReturn:
    """Ends a command with the status that `main` returns; with 1 and one line where it throws UserError or
    OSError, or is interrupted. `goes_on`: the same command then goes on from there."""
    stop_when_terminated()
    try:
        sys.exit(main())
    except (UserError, OSError) as error:
        sys.stdout.flush()
        print(f"{_told}: {line_of(error)}", file=sys.stderr)
    except KeyboardInterrupt:
        if not goes_on:
            raise
        print(f"{_told}: interrupted; the same command goes on from here", file=sys.stderr)
    sys.exit(1)


def stop_when_terminated() -> None:
    """SIGTERM, as a batch system sends it, and SIGHUP of a terminal that is closed stop a command as Ctrl-C does: its
    runs with it. Under nohup SIGHUP stays ignored."""
    for number in STOPPING:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, signal.default_int_handler)
