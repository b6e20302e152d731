"""The commands: a module for each, whose `main` reads the command's line. run/NAME of the sources starts one, and so do
`pounding-NAME` of pip and `pounding-tools NAME` of an installed prefix."""

import os
import signal
import sys

TOP = os.path.abspath(os.path.join(os.path.realpath(__file__), *[os.pardir] * 4))


# What stands before a command's name where it is called: that of the sources has its program in a build.
PREFIX = ("pounding-" if os.path.basename(sys.argv[0]).startswith("pounding-") or not os.path.exists(f"{TOP}/run") else
          "run/" if os.path.exists(f"{TOP}/CMakeLists.txt") else "pounding-tools ")


def called(text: str) -> str:
    """A text about commands with their names as they are called here: `run/plot`, `pounding-plot` or `pounding-tools plot`."""
    import re
    return re.sub(r"\brun/(?=[a-z])", PREFIX, text)


def leave_when_interrupted(name: str) -> None:
    """Until a command has begun, an interrupt ends it in one line as well."""

    def leave(*_) -> None:
        os.write(2, f"{PREFIX}{name}: interrupted\n".encode())
        os._exit(1)

    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, leave)


def start(name: str) -> None:
    """Carries out a command and ends the process; GOES_ON of its module says that it goes on where it was interrupted."""
    leave_when_interrupted(name)
    from importlib import import_module

    from .process import begin, end
    begin(f"run/{name}")
    command = import_module(f"{__name__}.{name}")
    end(command.main, goes_on=getattr(command, "GOES_ON", False))


def command_line(name: str) -> str:
    """A command as it is started from any folder."""
    return f"{TOP}/run/{name}" if PREFIX == "run/" else PREFIX + name


def words_of_command(name: str, *words) -> list:
    """What starts a command in a process of its own."""
    return [sys.executable, "-B", "-P", os.path.join(os.path.dirname(__file__), "__main__.py"), name, *map(str, words)]


def installed() -> None:
    """The command that the script of pip is called after; `pounding-report` is what run/plot draws."""
    name = os.path.basename(sys.argv[0]).removeprefix("pounding-")
    start("plot" if name == "report" else name)
