#pragma once

#include <functional>
#include <string>

#include "io/matrix_entry.h"

namespace pounding {

/// Hands every entry of a sparse matrix in PETSc's binary format over, row by row, and says how
/// large the matrix is. The format, big-endian, 32-bit indices: class id 1211216, rows, columns,
/// number of entries; number of entries of every row; their columns; their values. Nothing of the
/// file is believed before it is checked: PETSc's own reader takes a column outside of the matrix
/// for a place in memory. Throws UserError naming the file, and row and column of a wrong entry.
MatrixSize read_petsc_binary(const std::string& path,
                             const std::function<void(const MatrixEntry&)>& receive);

}  // namespace pounding
