"""Tables of impedances of a mat over the frequency, and soil fitted to them, for tests."""
import math
import os
import sys
import tempfile
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))
from pounding.soil import fit, impedances, soil_file  # noqa: E402

MOTIONS = impedances.MOTIONS
FREQUENCIES = numpy.arange(0.25, 20.01, 0.25)


def write_table(impedance, frequencies=FREQUENCIES):
    """A table of S(omega), shape (6 mats, 6 mats), in a file of its own, which is returned: the diagonals, and what couples."""
    values = [impedance(2 * math.pi * f) for f in frequencies]
    size = len(values[0])
    motions = impedances.motions_of(size // 6)
    pairs = [(i, j) for i in range(size) for j in range(size) if i == j or any(value[i, j] != 0 for value in values)]
    handle, path = tempfile.mkstemp(suffix=".csv")
    with os.fdopen(handle, "w") as file:
        file.write("# impedances of a mat\n")
        file.write(",".join(["frequency"] + [f"k{motions[i]}{motions[j]}_{part}" for i, j in pairs
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


def write_parts(soil):
    """A file of soil, not fitted to anything, which is returned."""
    handle, path = tempfile.mkstemp(suffix=".csv")
    os.close(handle)
    soil_file.write(Path(path), soil, impedances.Impedances(FREQUENCIES, None), [], "nothing")
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


def two_mats():
    """Soil of two unlike mats, whose parts meet motions of both: three springs, a dashpot and a mass between them, hidden parts
    of all kinds; nothing else couples them."""
    soil = fit.Soil(2)
    for matrix, values in ((soil.stiffness, (2e9, 2.5e9, 3e9, 3e11, 2e11, 4e11)), (soil.dashpots, (3e7, 3e7, 8e7, 5e8, 4e8, 2e9)),
                           (soil.masses, (0, 0, 1e5, 1e6, 0, 0))):
        numpy.fill_diagonal(matrix, numpy.concatenate([values, 1.4 * numpy.array(values)]))

    def motion(**components):
        return numpy.array([components.get(name, 0.0) for name in impedances.motions_of(2)])
    for matrix, value, along in (
            (soil.stiffness, 1.5e9, motion(x1=1, x2=-1, ry1=3)), (soil.stiffness, 2e9, motion(y1=1, y2=-1, rz2=4)),
            (soil.stiffness, 1e9, motion(z1=1, z2=-0.8, ry1=15, ry2=14)), (soil.dashpots, 4e7, motion(x1=1, x2=0.9)),
            (soil.dashpots, 3e7, motion(z1=1, z2=-1, ry1=2)), (soil.masses, 2e5, motion(y1=1, y2=1))):
        matrix += value * numpy.outer(along, along)
    soil.hidden = [fit.Hidden(motion(x1=1, x2=-0.7, ry2=2), 3e7, 9e8, 0), fit.Hidden(motion(z1=0.8, z2=1, ry1=-5), 4e7, 0, 5e5),
                   fit.Hidden(motion(y1=1, y2=-1, rx1=3, rx2=-2), 2e7, 8e8, 3e5), fit.Hidden(motion(rz1=1, rz2=-1), 6e8, 0, 2e7)]
    return soil
