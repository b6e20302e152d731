#include "common/dense_eigenvalues.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <petscsys.h>
// LAPACK declarations need the types above.
#include <petscblaslapack.h>

namespace pounding {

double largest_eigenvalue(std::span<const double> stiffness, std::span<const double> mass) {
  const std::size_t n = mass.size();
  std::vector<double> scaled(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (mass[i] > 0 && mass[j] > 0) {
        scaled[i * n + j] = stiffness[i * n + j] / std::sqrt(mass[i] * mass[j]);
      }
    }
  }
  std::vector<double> eigenvalues(n);
  std::vector<double> work(8 * n);
  auto order = static_cast<PetscBLASInt>(n);
  auto work_size = static_cast<PetscBLASInt>(work.size());
  PetscBLASInt info = 0;
  LAPACKsyev_("N", "U", &order, scaled.data(), &order, eigenvalues.data(), work.data(), &work_size,
              &info);
  if (info != 0) throw std::runtime_error("dsyev failed with info " + std::to_string(info));
  return eigenvalues.back();
}

}  // namespace pounding
