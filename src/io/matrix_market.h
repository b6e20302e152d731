#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/matrix_entry.h"

/// Sparse matrices in files: Matrix Market (text, coordinate or array, real or integer, general or
/// symmetric) and PETSc's binary format.
namespace pounding {

/// Hands every stored entry of a file over, those that a symmetric file leaves out included. A
/// file that ends in .mtx is Matrix Market, any other PETSc binary. Every entry lies inside of the
/// matrix and is finite. Throws UserError with the line, or with row and column.
MatrixSize read_matrix(const std::string& path,
                       const std::function<void(const MatrixEntry&)>& receive);

/// Writes Matrix Market, coordinate, real, general, every digit. `comment` is one line. Throws
/// UserError if it cannot be written.
void write_matrix(const std::string& path, const std::string& comment, const MatrixSize& size,
                  const std::vector<MatrixEntry>& entries);

}  // namespace pounding
