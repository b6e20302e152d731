#include "common/dense_solver.h"

#include <cstddef>

#include <petscsys.h>
// LAPACK declarations need the types above.
#include <petscblaslapack.h>

namespace pounding {

bool solve_dense(std::vector<double>& matrix, std::vector<double>& values) {
  const std::size_t n = values.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) std::swap(matrix[i * n + j], matrix[j * n + i]);
  }
  auto order = static_cast<PetscBLASInt>(n);
  PetscBLASInt one = 1;
  PetscBLASInt info = 0;
  std::vector<PetscBLASInt> pivots(n);
  LAPACKgesv_(&order, &one, matrix.data(), &order, pivots.data(), values.data(), &order, &info);
  return info == 0;
}

}  // namespace pounding
