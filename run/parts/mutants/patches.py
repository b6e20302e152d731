"""The faults that tests are held against: patches of tests/mutants, each with a head of three lines and a difference as
git writes it.

    room: the room of src, or the folder, that it is in
    fault: one sentence
    tests: up to three, that most likely to see it first: files of tests, or a class or test of a long one
           (springs_test, ensemble_test:Members), or filters of the programs of tests (unit:Links.*, parallel:Halo.*,
           which runs on 2 and on 3 ranks)
"""

import dataclasses
import re
from pathlib import Path

from pounding import UserError

PROGRAMS = {"unit": "unit_tests", "parallel": "parallel_tests"}
KEYS = ("room", "fault", "tests")


@dataclasses.dataclass(frozen=True)
class Mutant:
    path: Path
    room: str
    fault: str
    tests: tuple
    files: tuple  # that it changes, below the source folder

    @property
    def name(self) -> str:
        return self.path.stem


def read(path: Path) -> Mutant:
    head, _, difference = path.read_text().partition("\n\n")
    lines = [line.partition(": ") for line in head.splitlines()]
    if tuple(key for key, _, _ in lines) != KEYS or not all(value for _, _, value in lines):
        raise UserError(f"{path}: the lines before the difference have to be 'room: ', 'fault: ' and 'tests: '")
    room, fault, tests = (value for _, _, value in lines)
    files = tuple(re.findall(r"^\+\+\+ b/(.+)$", difference, re.MULTILINE))
    if not files:
        raise UserError(f"{path}: holds no difference")
    return Mutant(path, room, fault, tuple(tests.split()), files)


def read_all(folder: Path) -> list:
    return [read(path) for path in sorted(folder.glob("*.patch"))]
