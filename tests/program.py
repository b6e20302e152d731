"""Runs the program as a user does and reads what it leaves; shared by the tests in Python."""
import atexit
import csv
import functools
import json
import os
import pathlib
import socket
import subprocess
import tempfile
import time
import unittest

SOURCE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BUILD = os.environ.get("POUNDING_BUILD", os.path.join(SOURCE, "build"))
PROGRAM = os.path.abspath(os.path.join(BUILD, "pounding"))
ALL = bool(os.environ.get("POUNDING_ALL"))  # run/test --all: also what takes long and seldom tells more
long = unittest.skipUnless(ALL, "run/test --all")
# Of a run whose test does not ask for another number; on any ranks there is one motion (scenes_on_ranks_test.py).
RANKS = int(os.environ.get("POUNDING_RANKS", 2 if ALL else 1))
JOBS = 2  # at once, of a test that says PROCESSORS = 2
SHARED = os.environ.get("POUNDING_SHARED", os.path.join(os.path.dirname(SOURCE), "shared"))
# Folders, meshes and records of a test file are in one folder, which goes with its process.
PLACE = tempfile.TemporaryDirectory(prefix="pounding-test-", ignore_cleanup_errors=True)
tempfile.tempdir = PLACE.name


def environment():
    """The variables that run/environment sets."""
    text = subprocess.run(["bash", "-c", "source run/environment && env -0"], cwd=SOURCE,
                          capture_output=True, text=True, check=True).stdout
    return dict(item.split("=", 1) for item in text.split("\0") if "=" in item)


ENVIRONMENT = environment()


def words(arguments, ranks):
    """The command that runs `pounding` on some ranks; arguments are words after the program's name.
    The small scenes of tests would not be cut on their own: they are, where nothing else is said. Results are in this
    process's own folder where nothing else is said, as tests run side by side."""
    words_given = [str(word) for word in arguments]
    own = [] if "-output" in words_given else ["-output", os.path.join(PLACE.name, "results")]
    line = ["mpirun", "-n", str(ranks), PROGRAM, *own, *words_given]
    return line + ["-partition", "elements"] if ranks > 1 and "-partition" not in line else line


# A rank notes how it ended. mpirun hears of crashes only: of a status it would make a second's wait.
NOTING = '"$@"; status=$?; echo $status > "$0/${OMPI_COMM_WORLD_RANK:-0}"; [ $status -le 2 ] || exit $status'


def launch(arguments, ranks=RANKS, timeout=900, folder=SOURCE, environment=None):
    """`run` in processes of its own, for what a job among others cannot show: signals, crashes, limits of the system,
    variables that are read before MPI starts, the peak of memory. One rank does without mpirun."""
    line = words(arguments, ranks)
    at = line.index(PROGRAM)
    start = line[:at] if ranks > 1 else []
    with tempfile.TemporaryDirectory(prefix="pounding-ranks-") as notes:
        result = subprocess.run([*start, "bash", "-c", NOTING, notes, *line[at:]], cwd=folder,
                                env=environment or ENVIRONMENT, capture_output=True, text=True, errors="replace", timeout=timeout)
        noted = [int(pathlib.Path(notes, name).read_text()) for name in sorted(os.listdir(notes))]
    if result.returncode == 0:
        assert len(noted) == ranks and len(set(noted)) == 1, f"exit statuses {noted}: {result.stderr[-2000:]}"
        result.returncode = noted[0]
    return result


@functools.cache
def jobs_place():
    """The folder of a dispatcher of jobs (tests/jobs): ctest's, or one that ends with this process."""
    place = os.environ.get("POUNDING_JOBS", "")
    if not place or not os.path.exists(os.path.join(place, "jobs")):
        place = tempfile.mkdtemp(prefix="jobs-")
        served = subprocess.Popen(["/usr/bin/python3", os.path.join(SOURCE, "tests", "jobs", "dispatcher.py"), place],
                                  stdin=subprocess.PIPE, env={**os.environ, "POUNDING_BUILD": os.path.abspath(BUILD)})
        atexit.register(lambda: (served.stdin.close(), served.wait()))
        while not os.path.exists(os.path.join(place, "jobs")):
            assert served.poll() is None, "the dispatcher of jobs ended"
            time.sleep(0.02)
    return place


def run(arguments, ranks=RANKS, timeout=900, folder=SOURCE, environment=None):
    """Runs `pounding` to its end on ranks that wait for jobs, or in processes of its own (run/test --all). The exit status
    is that of every rank, or it raises AssertionError."""
    if ALL or ranks > 3 or not "".join(words(arguments, ranks)).isascii():
        return launch(arguments, ranks, timeout, folder, environment)
    return job(arguments, ranks, timeout, folder, environment)


def job(arguments, ranks=RANKS, timeout=900, folder=SOURCE, environment=None):
    """`run` on ranks that wait for jobs, also with --all: for thousands of runs of milliseconds."""
    line = words(arguments, ranks)
    given = environment or ENVIRONMENT
    variables = {name: given.get(name) for name in {*ENVIRONMENT, *given} if given.get(name) != ENVIRONMENT.get(name)}
    wanted = {"ranks": ranks, "words": line[line.index(PROGRAM) + 1:], "folder": os.path.abspath(folder), "timeout": timeout,
           "environment": variables}
    with socket.socket(socket.AF_UNIX) as asked:
        asked.connect(os.path.join(jobs_place(), "jobs"))
        asked.sendall(json.dumps(wanted).encode() + b"\n")
        answer = json.loads(asked.makefile("rb").readline())
    if "late" in answer:
        raise subprocess.TimeoutExpired(line, timeout)
    statuses = answer.get("statuses", [134])
    assert len(set(statuses)) == 1, f"exit statuses {statuses}: {answer['stderr'][-2000:]}"
    return subprocess.CompletedProcess(line, statuses[0], answer["stdout"], answer["stderr"])


def command(name, *words, timeout=900, cwd=None):
    """Runs one of the commands in run/, from any folder or from `cwd`, on the programs of this build."""
    return subprocess.run([os.path.join(SOURCE, "run", name), *map(str, words)], cwd=cwd or tempfile.gettempdir(),
                          env={**os.environ, "POUNDING_BUILD": os.path.abspath(BUILD)},
                          capture_output=True, text=True, timeout=timeout)


def error_lines(result):
    """What the program itself said on stderr (mpirun adds lines of its own)."""
    return [line for line in result.stderr.splitlines() if line.startswith("pounding: ")]


def summary(folder):
    with open(os.path.join(folder, "summary.json")) as file:
        return json.load(file)


def well_ended(test, result):
    """A program or command that ended; fails the test unless its exit status is 0."""
    test.assertEqual(result.returncode, 0, result.stdout[-2000:] + result.stderr[-2000:])
    return result


def must_end(test, *arguments, **options):
    """`run` that ends with exit status 0."""
    return well_ended(test, run(*arguments, **options))


def must_do(test, *words, **options):
    """`command` that ends with exit status 0."""
    return well_ended(test, command(*words, **options))


def must_run(test, arguments, ranks=RANKS, timeout=900):
    """Runs into a fresh folder and returns it with the summary; fails the test on an error. Numbers in tables have all
    their digits unless the arguments say otherwise."""
    folder = tempfile.mkdtemp(prefix="pounding-")
    must_end(test, ["-csv_digits", 17, *arguments, "-output", folder], ranks, timeout)
    return folder, summary(folder)


def must_refuse(test, arguments, *parts, ranks=RANKS, timeout=900):
    """A run that ends with exit status 1 and one line that holds all the parts; returns the line."""
    result = run(arguments, ranks, timeout)
    test.assertEqual(result.returncode, 1, result.stdout[-2000:] + result.stderr[-2000:])
    lines = error_lines(result)
    test.assertEqual(len(lines), 1, result.stderr)
    for part in parts:
        test.assertIn(part, lines[0])
    return lines[0]


def rows_of(path):
    """Lines of a CSV file as dictionaries of text."""
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def read_csv(path):
    """Columns of one of the program's CSV files, as lists of text."""
    with open(path) as file:
        lines = [line.rstrip("\n") for line in file if not line.startswith("#")]
    names = lines[0].split(",")
    rows = [line.split(",") for line in lines[1:]]
    return {name: [row[i] for row in rows] for i, name in enumerate(names)}


# The two-storey pair on a coarse mesh: the same physics, a hundred times cheaper.
COARSE_PAIR = ["-options_file", "petsc-options/azalee/gap2.yaml",
               "-s1_mesh_set", "cells_x=7,cells_y=5,column_elements=2",
               "-s2_mesh_set", "cells_x=5,cells_y=5,column_elements=2"]


def write_samples(values, step):
    """A record [m/s2] in a file of its own, which is returned."""
    handle, path = tempfile.mkstemp(suffix=".txt")
    with os.fdopen(handle, "w") as file:
        for i, value in enumerate(values):
            file.write(f"{i * step:.9f} {value:.17g}\n")
    return path
