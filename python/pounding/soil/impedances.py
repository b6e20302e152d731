"""Tables of impedances of rigid mats over the frequency."""

import math
import re
from dataclasses import dataclass
from pathlib import Path

import numpy

from pounding import UserError
from pounding.files import write_text

MOTIONS = ("x", "y", "z", "rx", "ry", "rz")
UNSYMMETRIC = 0.01  # of a term, over the root of its diagonals' product
GIVES_ENERGY = 0.02  # least eigenvalue of the imaginary part, likewise
FEWEST = 4  # frequencies above 0
MOST_MATS = 20
COLUMN = re.compile(r"kr?[xyz](\d*)r?[xyz](\d*)_(re|im)")


class TableError(UserError):
    """A table of impedances that cannot be meant, in one line."""


@dataclass
class Impedances:
    """Impedance matrices of some mats, symmetric, for motions exp(i omega t)."""
    frequency: numpy.ndarray  # Hz, increasing, the first not below 0; shape (n)
    matrix: numpy.ndarray  # N/m, N, N m along and about x, y, z, mat by mat; shape (n, 6 mats, 6 mats)

    @property
    def mats(self) -> int:
        return self.matrix.shape[1] // 6


def motions_of(mats: int) -> list:
    """Names x, y, z, rx, ry, rz, of several mats x1 and so on, mat by mat."""
    return [motion + (str(mat) if mats > 1 else "") for mat in range(1, mats + 1) for motion in MOTIONS]


def names_of(mats: int) -> dict:
    """Name of a column -> row, column and factor of its values in the matrix."""
    motions = list(enumerate(motions_of(mats)))
    return {f"k{a}{b}_{part}": (i, j, factor) for i, a in motions for j, b in motions for part, factor in (("re", 1), ("im", 1j))}


def sizes_of(matrix) -> numpy.ndarray:
    """Roots of the products of the diagonals' moduli, to which terms are related."""
    root = numpy.sqrt(numpy.maximum(abs(numpy.diagonal(matrix, axis1=-2, axis2=-1)), 1e-300))
    return root[..., :, None] * root[..., None, :]


def text_of(path: Path) -> list:
    """The lines of a file."""
    try:
        return path.read_text(encoding="utf-8-sig").split("\n")
    except UnicodeDecodeError as error:
        raise TableError(f"{path}: is no text") from error


def write(path: Path, table: Impedances, source: str) -> None:
    """A table of all terms of one triangle, as `read` takes it. Throws OSError."""
    names = [(name, i, j, factor) for name, (i, j, factor) in names_of(table.mats).items() if i <= j]
    lines = [f"# {source}", ",".join(["frequency", *(name for name, *_ in names)])]
    lines += [",".join(f"{value:.17g}" for value in [f, *((matrix[i, j] / factor).real for _, i, j, factor in names)])
              for f, matrix in zip(table.frequency, table.matrix)]
    write_text(path, "\n".join(lines) + "\n")


def read(path: Path) -> Impedances:
    """Throws TableError with the line: columns that are missing or unknown, frequencies that do not increase, what is no
    number, a matrix that is not symmetric, soil without stiffness at the lowest frequency, or that gives energy."""
    columns, names, frequencies, matrices = [], {}, [], []
    lines = text_of(path)
    for number, text in enumerate(lines, 1):
        if not text.strip() or text.lstrip().startswith("#"):
            continue
        words = [word.strip() for word in text.split(",")]
        try:
            if not columns:
                names = check_columns(words)
                columns = words
                continue
            frequency, matrix = row_of(columns, names, words)
            if frequencies and not frequency > frequencies[-1]:
                raise TableError("the frequency does not increase")
            check_matrix(frequency, matrix, first=not frequencies)
        except TableError as error:
            raise TableError(f"{path}, line {number}: {error}") from None
        frequencies.append(frequency)
        matrices.append(matrix)
    if not columns:
        raise TableError(f"{path}: no line with names of columns in it")
    if sum(frequency > 0 for frequency in frequencies) < FEWEST:
        raise TableError(f"{path}: {len(frequencies)} frequencies; a fit needs {FEWEST} above 0")
    return Impedances(numpy.array(frequencies), numpy.array(matrices))


def check_columns(words: list) -> dict:
    """Names of the columns that a table of so many mats may have, as those of `words` tell."""
    numbers = {number for word in words if (found := COLUMN.fullmatch(word)) for number in found.groups()[:2]}
    mats = max((int(number) for number in numbers if number), default=1)
    if mats > MOST_MATS:
        raise TableError(f"{mats} mats; {MOST_MATS} at most")
    names = names_of(mats)
    for word in words:
        if words.count(word) > 1:
            raise TableError(f"two columns are called '{word}'")
        if word != "frequency" and word not in names:
            raise TableError(f"'{word}' where names of columns belong: frequency, in Hz, then kxx_re, kxx_im and so on of "
                             "x, y, z, rx, ry, rz, such as kxry_re; of several mats kx1x1_re, kx1ry2_re")
    if "frequency" not in words:
        raise TableError("no column 'frequency', in Hz")
    for name, (i, j, _) in names.items():
        if name not in words and (i == j or name[:-2] + "re" in words or name[:-2] + "im" in words):
            raise TableError(f"no column '{name}'" + ("; all six motions need their diagonal" if i == j else ""))
    return names


def row_of(columns: list, names: dict, words: list) -> tuple:
    """Frequency and symmetric matrix of a line."""
    if len(words) != len(columns):
        raise TableError(f"{len(words)} values for {len(columns)} columns")
    size = 1 + max(i for i, _, _ in names.values())
    frequency, matrix = 0.0, numpy.zeros((size, size), complex)
    given = numpy.zeros((size, size), bool)
    for column, word in zip(columns, words):
        try:
            value = float(word)
        except ValueError:
            value = math.nan
        if not abs(value) <= 1e30:
            raise TableError(f"'{word}' is no number of use")
        if column == "frequency":
            frequency = value
            continue
        i, j, factor = names[column]
        matrix[i, j] += value * factor
        given[i, j] = True
    if not 0 <= frequency <= 1e4:
        raise TableError("the frequency is to be in Hz, from 0 to 1e4")
    return frequency, numpy.where(given, matrix, matrix.T)


def check_matrix(frequency: float, matrix, first: bool) -> None:
    """Makes a matrix that is nearly symmetric wholly so."""
    motions = motions_of(len(matrix) // 6)
    for i, name in enumerate(motions):
        if matrix[i, i] == 0:
            raise TableError(f"k{name}{name}_re and k{name}{name}_im are 0; soil holds a mat in all six motions")
    sizes = sizes_of(matrix)
    wrong = numpy.argwhere(abs(matrix - matrix.T) > UNSYMMETRIC * sizes)
    if len(wrong):
        a, b = motions[wrong[0][0]], motions[wrong[0][1]]
        raise TableError(f"the matrix is not symmetric: k{a}{b} and k{b}{a} differ by more than 1 % of their diagonals")
    matrix[:] = (matrix + matrix.T) / 2
    if first and not numpy.linalg.eigvalsh(matrix.real / sizes)[0] > 0:
        raise TableError("the soil has no stiffness against some motion at the lowest frequency: the real part is not positive "
                         "definite; are signs and the point that the table is for right?")
    least = numpy.linalg.eigvalsh(matrix.imag / sizes)[0] if frequency > 0 else 0
    if least < -GIVES_ENERGY:
        raise TableError(f"the soil would give energy: the imaginary part is negative, by {-100 * least:.3g} % of the diagonals; "
                         "tables for motions exp(-i omega t) need the other sign")
