"""Reads matrices and vectors that PETSc wrote in its binary format (big-endian)."""

from pathlib import Path

import numpy as np
from scipy.sparse import csr_matrix

MATRIX, VECTOR = 1211216, 1211214


def read_matrix(path: Path) -> csr_matrix:
    with open(path, "rb") as file:
        kind, rows, columns, entries = np.fromfile(file, ">i4", 4)
        if kind != MATRIX:
            raise ValueError(f"{path} holds no matrix of PETSc")
        lengths = np.fromfile(file, ">i4", rows).astype(np.int32)
        places = np.fromfile(file, ">i4", entries).astype(np.int32)
        values = np.fromfile(file, ">f8", entries).astype(float)
    first = np.concatenate([[0], np.cumsum(lengths)]).astype(np.int32)
    return csr_matrix((values, places, first), shape=(rows, columns))


def read_vector(path: Path) -> np.ndarray:
    with open(path, "rb") as file:
        kind, length = np.fromfile(file, ">i4", 2)
        if kind != VECTOR:
            raise ValueError(f"{path} holds no vector of PETSc")
        return np.fromfile(file, ">f8", length).astype(float)
