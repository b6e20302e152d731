#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/petsc.h"

/// Sparse matrices in files: Matrix Market (text, coordinate or array, real or integer, general or
/// symmetric) and PETSc's binary format.
namespace pounding {

/// One entry, numbered from 0.
struct MatrixEntry {
  PetscInt row = 0;
  PetscInt column = 0;
  double value = 0;
};

struct MatrixSize {
  PetscInt rows = 0;
  PetscInt columns = 0;
};

/// Hands every stored entry of a file over, those that a symmetric file leaves out included. A
/// file that ends in .mtx is Matrix Market, any other PETSc binary. Throws UserError with the line.
MatrixSize read_matrix(const std::string& path,
                       const std::function<void(const MatrixEntry&)>& receive);

/// Writes Matrix Market, coordinate, real, general, every digit. `comment` is one line. Throws
/// std::runtime_error if it cannot be written.
void write_matrix(const std::string& path, const std::string& comment, const MatrixSize& size,
                  const std::vector<MatrixEntry>& entries);

}  // namespace pounding
