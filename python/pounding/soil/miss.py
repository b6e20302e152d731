"""Impedances in the text layout of MISS3D, as Code_Aster's command LIRE_IMPE_MISS (TYPE='ASCII') reads it: a line of title, then
for each term of the matrix, rows fastest, a line that begins with CHA and a line per frequency with the frequency in Hz, the real
and the imaginary part, of motions exp(-i omega t). Modes are taken to be the six rigid motions of each mat, along and about x, y
and z, mat by mat."""

import math
from pathlib import Path

import numpy

from pounding.soil.impedances import MOST_MATS, Impedances, TableError, check_matrix, text_of


def is_miss(path: Path) -> bool:
    lines = text_of(path)
    return len(lines) > 1 and lines[1].lstrip().startswith("CHA")


def numbers_of(text: str) -> list:
    """Frequency, real and imaginary part of a line, where it has them."""
    try:
        values = [float(word.upper().replace("D", "E")) for word in text.split()[:3]]
    except ValueError:
        values = []
    if len(values) < 3 or not all(abs(value) <= 1e30 for value in values):
        raise TableError(f"'{text.strip()}' where frequency, real and imaginary part belong")
    return values


def read(path: Path) -> Impedances:
    """Throws TableError with the line: what is no number, terms with other frequencies than the first, a number of terms that is
    no square of six motions per mat, a matrix that impedances.read refuses as well."""
    terms = []
    for number, text in enumerate(text_of(path)[1:], 2):
        try:
            if text.lstrip().startswith("CHA"):
                terms.append([])
            elif text.strip():
                terms[-1].append((number, *numbers_of(text)))
                place = len(terms[-1]) - 1
                if terms[0][place:place + 1] == [] or terms[-1][place][1] != terms[0][place][1]:
                    raise TableError("a frequency that the first term has not there")
                if len(terms) == 1 and place and not terms[0][place][1] > terms[0][place - 1][1]:
                    raise TableError("the frequency does not increase")
        except TableError as error:
            raise TableError(f"{path}, line {number}: {error}") from None
    size = math.isqrt(len(terms))
    if size**2 != len(terms) or size % 6 or size > 6 * MOST_MATS:
        raise TableError(f"{path}: {len(terms)} terms, and 36 n^2 belong to n mats with six motions each")
    if any(len(term) != len(terms[0]) for term in terms):
        raise TableError(f"{path}: terms of {len(terms[0])} frequencies and of {min(map(len, terms))}")
    values = numpy.array(terms)
    matrix = (values[..., 2] - 1j * values[..., 3]).T.reshape(-1, size, size).transpose(0, 2, 1).copy()
    for row, (number, frequency, *_) in enumerate(terms[0]):
        try:
            check_matrix(frequency, matrix[row], first=row == 0)
        except TableError as error:
            raise TableError(f"{path}, line {number} and likewise in other terms: {error}") from None
    return Impedances(values[0, :, 1], matrix)
