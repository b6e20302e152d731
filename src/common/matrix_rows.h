#pragma once

#include <cstddef>
#include <span>

#include "common/petsc.h"

namespace pounding {

/// Calls visit(row, columns, values) for each row of a matrix that this rank owns, in their order;
/// both spans of its entries last until the next call. Local.
template <typename Visit>
void for_each_row(Mat matrix, const Visit& visit) {
  PetscInt first = 0;
  PetscInt end = 0;
  POUNDING_PETSC(MatGetOwnershipRange(matrix, &first, &end));
  for (PetscInt row = first; row < end; ++row) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    POUNDING_PETSC(MatGetRow(matrix, row, &count, &columns, &values));
    const auto size = static_cast<std::size_t>(count);
    visit(row, std::span(columns, size), std::span(values, size));
    POUNDING_PETSC(MatRestoreRow(matrix, row, &count, &columns, &values));
  }
}

}  // namespace pounding
