#pragma once

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

}  // namespace pounding
