"""Matrices of another code: files that are none, and matrices that are those of no building."""
import os
import shutil
import struct

from corpus.case import Case


def beside(edit):
    """A file of the case made from the sound one of the same name."""
    def make(path, made):
        folder = os.path.dirname(path)
        for name in os.listdir(os.path.join(made, "matrices", "left")):
            if not name.endswith(".petsc") and not os.path.exists(os.path.join(folder, name)):
                shutil.copy(os.path.join(made, "matrices", "left", name), folder)
        source = os.path.join(made, "matrices", "left", os.path.basename(path))
        with open(source, encoding="ascii") as file:
            result = edit(file.read())
        if result is None:
            os.remove(path)
            return
        with open(path, "wb") as file:
            file.write(result if isinstance(result, bytes) else result.encode())
    return make


def matrix(name, file, edit, words):
    return Case(name, ["-left_matrices", "{folder}/m"], words, {"m/" + file: beside(edit)})


SOUND = matrix("sound", "stiffness.mtx", lambda text: text, [])


def binary(name, content, words):
    """A stiffness in PETSc's format in the place of the text."""
    def make(path, made):
        stiffness = os.path.join(os.path.dirname(path), "stiffness.mtx")
        beside(lambda text: None)(stiffness, made)
        with open(path, "wb") as file:
            file.write(content)
    return Case(name, ["-left_matrices", "{folder}/m"], words, {"m/stiffness.petsc": make})


def replaced(before, after):
    def edit(text):
        if before not in text:
            raise ValueError(f"{before!r} is not in the file")
        return text.replace(before, after, 1)
    return edit


def entries(change):
    """The lines of numbers after the sizes, changed by `change(list of [row, column, value])`."""
    def edit(text):
        lines = text.splitlines()
        first = next(i for i, line in enumerate(lines) if not line.startswith("%"))
        sizes = lines[first].split()
        rows = change([[int(a), int(b), float(c)] for a, b, c in (line.split() for line in lines[first + 1:])])
        body = [f"{row} {column} {value!r}" for row, column, value in rows]
        return "\n".join([*lines[:first], f"{sizes[0]} {sizes[1]} {len(body)}", *body, ""])
    return edit


def first_value(value):
    def change(rows):
        rows[0][2] = value
        return rows
    return entries(change)


def diagonal(factor):
    """The first entry on the diagonal multiplied."""
    def change(rows):
        entry = next(row for row in rows if row[0] == row[1])
        entry[2] *= factor
        return rows
    return entries(change)


def petsc(rows, columns, counts, indices, values):
    return struct.pack(f">4i{len(counts)}i{len(indices)}i{len(values)}d", 1211216, rows, columns, len(values),
                       *counts, *indices, *values)


K, M, DOFS = "stiffness.mtx", "mass.mtx", "dofs.csv"
BANNER = "%%MatrixMarket matrix coordinate real general"

FILES = [
    Case("no folder of matrices", ["-left_matrices", "{folder}/none"], ["{folder}/none"]),
    Case("a file as the folder of matrices", ["-left_matrices", "{folder}/record.csv"], ["{folder}/record.csv"]),
    matrix("no stiffness", K, lambda text: None, ["neither stiffness.mtx nor stiffness.petsc"]),
    matrix("no mass", M, lambda text: None, ["neither mass.mtx nor mass.petsc"]),
    matrix("no rows' places", DOFS, lambda text: None, ["dofs.csv", "no such file"]),
    matrix("an empty stiffness", K, lambda text: "", [K, "line 1"]),
    matrix("no banner", K, replaced("%%MatrixMarket", "%MatrixMarket"), [K, "line 1", "%%MatrixMarket"]),
    matrix("a complex matrix", K, replaced("real", "complex"), [K, "line 1", "complex"]),
    matrix("a pattern without values", K, replaced("real", "pattern"), [K, "line 1", "pattern"]),
    matrix("a skew matrix", K, replaced("general", "skew-symmetric"), [K, "line 1", "skew-symmetric"]),
    matrix("a matrix of bytes", K, lambda text: bytes(range(256)), [K, "line 1"]),
    matrix("a stiffness cut in the middle", K, lambda text: text[:len(text) // 2], [K]),
    matrix("an entry announced but not there", K, lambda text: text[:text.rindex("\n", 0, -1) + 1],
           [K, "ends too early"]),
    matrix("a negative count of rows", K, lambda text: f"{BANNER}\n-3 3 1\n1 1 1\n", [K, "line 2"]),
    matrix("half a row", K, lambda text: f"{BANNER}\n3.5 3 1\n1 1 1\n", [K, "line 2"]),
    matrix("two sizes instead of three", K, lambda text: f"{BANNER}\n3 3\n1 1 1\n", [K, "line 2", "3 numbers"]),
    matrix("9e18 entries", K, lambda text: f"{BANNER}\n3 3 9000000000000000000\n1 1 1\n", [K, "line 2"]),
    matrix("a column of 1e10 in an entry", K, entries(lambda rows: [[1, 10 ** 10, 1.0]]), [K]),
]

ENTRIES = [
    matrix("a stiffness with a nan", K, first_value(float("nan")), [K, "not finite"]),
    matrix("a stiffness with an inf", K, first_value(float("inf")), [K, "not finite"]),
    matrix("a row of zero", K, entries(lambda rows: [[0, 1, 1.0]] + rows[1:]), [K, "outside the matrix"]),
    matrix("a column beyond the last", K, entries(lambda rows: [[1, 9999, 1.0]] + rows[1:]),
           [K, "outside the matrix"]),
    matrix("a stiffness of another size", K, lambda text: f"{BANNER}\n3 3 1\n1 1 1\n", [K, "3 x 3", "dofs.csv"]),
    matrix("a mass of another size", M, lambda text: f"{BANNER}\n3 3 1\n1 1 1\n", [M, "3 x 3", "dofs.csv"]),
    matrix("a word for a value", K, lambda text: f"{BANNER}\n3 3 1\n1 1 stiff\n", [K, "line 3", "3 numbers"]),
    matrix("an unsymmetric stiffness", K, entries(
        lambda rows: [[a, b, c * (1.5 if a < b else 1)] for a, b, c in rows]), ["symmetric"]),
    matrix("half a stiffness", K, entries(lambda rows: [row for row in rows if row[0] >= row[1]]), ["symmetric"]),
    matrix("a dof without mass", M, entries(lambda rows: rows[:-1]), ["no mass"]),
    matrix("a mass of zero", M, first_value(0.0), ["row 1", "no mass"]),
    matrix("a negative mass", M, first_value(-100.0), ["row 1", "mass"]),
    matrix("a mass that is nan", M, first_value(float("nan")), [M, "not finite"]),
]

PLACES = [
    matrix("a place that is no node", DOFS, lambda text: text.replace("-1,0,1,", "-1,0.3,1,"), [DOFS, "no node"]),
    matrix("a component that is none", DOFS, replaced(",ux", ",vx"), [DOFS, "line", "ux, uy, uz"]),
    matrix("a line that is short", DOFS, replaced(",ux", ""), [DOFS, "line", "x,y,z,component"]),
    matrix("places that are words", DOFS, lambda text: "x,y,z,component\nhere,there,0,ux\n", [DOFS, "line 2"]),
    matrix("no places", DOFS, lambda text: "x,y,z,component\n", [DOFS, "no rows"]),
    matrix("a row of a component twice", DOFS, replaced(",uy", ",ux"), [DOFS, "row for"]),
    matrix("rotations of bricks", DOFS, replaced(",ux", ",rx"), [DOFS, "no row for ux"]),
]

BINARY = [
    binary("an empty file in PETSc's format", b"", ["stiffness.petsc", "PETSc's binary format"]),
    binary("text in PETSc's format", b"%%MatrixMarket matrix\n1 1 1\n1 1 1\n", ["stiffness.petsc"]),
    binary("a vector in PETSc's format", struct.pack(">2i3d", 1211214, 3, 1, 1, 1), ["stiffness.petsc"]),
    binary("a matrix that is cut", petsc(3, 3, [1, 1, 1], [0, 1, 2], [1, 1, 1])[:40], ["stiffness.petsc"]),
    binary("a matrix of another size in PETSc's format", petsc(3, 3, [1, 1, 1], [0, 1, 2], [1, 1, 1]),
           ["stiffness.petsc", "3 x 3", "dofs.csv"]),
    binary("a negative count in PETSc's format", petsc(3, 3, [1, -1, 3], [0, 1, 2], [1, 1, 1]),
           ["stiffness.petsc"]),
    binary("counts that do not add up", petsc(3, 3, [1, 1, 7], [0, 1, 2], [1, 1, 1]), ["stiffness.petsc"]),
]

CASES = FILES + ENTRIES + PLACES + BINARY
