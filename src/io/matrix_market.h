#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/petsc.h"

namespace pounding {

/// One entry of a matrix, numbered from 0.
struct MatrixEntry {
  PetscInt row = 0;
  PetscInt column = 0;
  double value = 0;
};

/// Rows and columns of a matrix.
struct MatrixSize {
  PetscInt rows = 0;
  PetscInt columns = 0;
};

/// Sparse matrices in files: Matrix Market (text, coordinate or array, real or integer, general or
/// symmetric) and PETSc's binary format.

/// Hands every stored entry of a file over, those that a symmetric file leaves out included. A
/// file that ends in .mtx is Matrix Market, any other PETSc binary. Every entry lies inside of the
/// matrix and is finite. Throws UserError with the line, or with row and column.
MatrixSize read_matrix(const std::string& path,
                       const std::function<void(const MatrixEntry&)>& receive);

/// Writes Matrix Market, coordinate, real, general, every digit. `comment` is one line. Throws
/// UserError if it cannot be written.
void write_matrix(const std::string& path, const std::string& comment, const MatrixSize& size,
                  const std::vector<MatrixEntry>& entries);

/// Hands every entry of a sparse matrix in PETSc's binary format over, row by row, and says how
/// large the matrix is. The format, big-endian, 32-bit indices: class id 1211216, rows, columns,
/// number of entries; number of entries of every row; their columns; their values. Nothing of the
/// file is believed before it is checked: PETSc's own reader takes a column outside of the matrix
/// for a place in memory. Throws UserError naming the file, and row and column of a wrong entry.
MatrixSize read_petsc_binary(const std::string& path,
                             const std::function<void(const MatrixEntry&)>& receive);

}  // namespace pounding
