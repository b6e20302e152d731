"""Tables of impedances of a mat over the frequency, and soil fitted to them, for tests."""
import math
import os
import sys
import tempfile
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))
from pounding.soil import fit, impedances, soil_file  # noqa: E402

MOTIONS = ("x", "y", "z", "rx", "ry", "rz")
FREQUENCIES = numpy.arange(0.25, 20.01, 0.25)


def write_table(impedance, frequencies=FREQUENCIES):
    """A table of S(omega), shape (6, 6), in a file of its own, which is returned: the diagonals, and what couples."""
    values = [impedance(2 * math.pi * f) for f in frequencies]
    pairs = [(i, j) for i in range(6) for j in range(6) if i == j or any(value[i, j] != 0 for value in values)]
    handle, path = tempfile.mkstemp(suffix=".csv")
    with os.fdopen(handle, "w") as file:
        file.write("# impedances of a mat\n")
        file.write(",".join(["frequency"] + [f"k{MOTIONS[i]}{MOTIONS[j]}_{part}" for i, j in pairs
                                             for part in ("re", "im")]) + "\n")
        for f, value in zip(frequencies, values):
            numbers = [number for i, j in pairs for number in (value[i, j].real, value[i, j].imag)]
            file.write(",".join(f"{number:.17g}" for number in [f] + numbers) + "\n")
    return path


def write_soil(impedance, frequencies=FREQUENCIES):
    """The file of the soil that run/soil fits to such a table, which is returned."""
    path = write_table(impedance, frequencies)
    table = impedances.read(Path(path))
    soil, blocks, _ = fit.fit(table)
    soil_file.write(Path(path), soil, table, blocks, "a table")
    return path


def cell(omega, spring, dashpot, inner_dashpot=0, inner_mass=0, moving_mass=0, inner_stiffness=0):
    """Impedance of a spring and a dashpot to the ground, a mass on the mat, and a dashpot, a spring and a mass in
    series; what is 0 is missing."""
    inner = 0
    if inner_dashpot > 0 and omega > 0:
        slip = 1 / inner_dashpot
        if inner_mass > 0:
            slip += 1 / (1j * omega * inner_mass)
        if inner_stiffness > 0:
            slip += 1j * omega / inner_stiffness
        inner = 1 / slip
    return spring + 1j * omega * (dashpot + inner) - omega**2 * moving_mass


def coupled(omega):
    """Sliding coupled with rocking, as under an embedded mat: a Maxwell body and two resonant parts act 3 m above the
    middle and below it, the rest along and about the axes."""
    matrix = numpy.diag([cell(omega, 2e9, 3e7), cell(omega, 2.5e9, 3e7), cell(omega, 3e9, 8e7, 2e7, 4e5),
                         cell(omega, 3e11, 5e8, 2e9, 1e8), cell(omega, 2e11, 5e8, 1e9, 5e7), cell(omega, 4e11, 2e9)])
    for (i, j), arm, part in (((0, 4), 3, cell(omega, 1e9, 0, 2e7, 0, 0, 6e8)), ((0, 4), -2, cell(omega, 5e8, 1e7)),
                              ((1, 3), -4, cell(omega, 1e9, 0, 1.5e7, 3e5, 1e5, 9e8))):
        direction = numpy.zeros(6)
        direction[i], direction[j] = 1, arm
        matrix = matrix + part * numpy.outer(direction, direction)
    return matrix
