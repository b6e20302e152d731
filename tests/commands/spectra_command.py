"""Runs pounding-spectra and reads the tables it writes."""
import csv
import io
import math
import os
import subprocess
import tempfile

import numpy

import program

SPECTRA = os.path.join(program.BUILD, "pounding-spectra")


def spectra(*words):
    return subprocess.run([SPECTRA, *map(str, words)], capture_output=True, text=True, timeout=300)


def read(text):
    """Columns of a table: numbers where every value is one, else text."""
    rows = list(csv.DictReader(line for line in io.StringIO(text) if not line.startswith("#")))
    table = {}
    for name in rows[0]:
        values = [row[name] for row in rows]
        try:
            table[name] = numpy.array(values, dtype=float)
        except ValueError:
            table[name] = numpy.array(values)
    return table


def computed(test, *words):
    """The table that the program prints, with all digits; it must end well and say nothing else."""
    result = spectra("--digits", 17, *words)
    test.assertEqual((result.returncode, result.stderr), (0, ""))
    return read(result.stdout)


def write_record(test, values, step):
    """A record [m/s2] of one column in a file that lives as long as the test."""
    handle, path = tempfile.mkstemp(suffix=".txt")
    with os.fdopen(handle, "w") as file:
        file.writelines(f"{value:.17g}\n" for value in values)
    return [path, "--unit", "m/s2", "--time-step", repr(step)]


def frequencies(values):
    return ["--frequencies", ",".join(map(repr, map(float, values)))]


def overshoot(ratio):
    """PSA of a step of 1: 1 + exp(-pi xi / sqrt(1 - xi^2))."""
    return 1 + math.exp(-math.pi * ratio / math.sqrt(1 - ratio**2))


def impulse_factor(ratio):
    """PSA of an impulse of 1 over omega: exp(-xi acos(xi) / sqrt(1 - xi^2))."""
    return math.exp(-ratio * math.acos(ratio) / math.sqrt(1 - ratio**2))
