"""The two small buildings of petsc-options/new, for tests of what is done with whole runs."""
import os
import sys
from pathlib import Path

import program

FOLDER = Path(program.SOURCE) / "petsc-options" / "new" / "two-buildings"
SCENE = FOLDER / "two-buildings.yaml"
# Two impacts at a gap of 0.01; no modes, which take most of the time on a busy machine.
SHORT = {"end_time": 1.2, "modes": 0, "left_damping_reference": 3, "right_damping_reference": 4}

os.environ["POUNDING_BUILD"] = os.path.abspath(program.BUILD)
sys.path.insert(0, os.path.join(program.SOURCE, "python"))
sys.dont_write_bytecode = True
import pounding  # noqa: E402


def shortened(options):
    """Those of a short run of the scene; gap: that of both floors [m]."""
    if "gap" in options:
        options["floor1_gap"] = options["floor2_gap"] = options.pop("gap")
    return {**SHORT, **options}


def run(output, ranks=1, **options):
    """A short run of the scene into a folder, as a job of waiting ranks, and what it left."""
    words = pounding.runs.words_of(SCENE, shortened(options))
    done = program.run([*words, "-output", os.path.abspath(output)], ranks, folder=FOLDER)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    Path(output, pounding.runs.LOG).write_text(done.stdout + done.stderr)
    return pounding.load(output)


def launched(output, ranks=2, **options):
    """The same by the package's own start of runs."""
    return pounding.run(SCENE, output, ranks, FOLDER, **shortened(options))


def own_scene(folder, more=""):
    """Path of a scene of one's own in a folder: 1.2 s of the two buildings at gaps of 0.01 m, seen at one roof."""
    path = os.path.join(folder, "mine.yaml")
    with open(path, "w") as file:
        file.write(f"include: {SCENE}\n{more}end_time: 1.2\nprobes: left_roof\n"
                   "left: {damping: {reference: 3}}\nright: {damping: {reference: 4}}\n"
                   "floor1: {gap: 0.01}\nfloor2: {gap: 0.01}\n")
    return path
