#include "common/dense_solver.h"

#include <cmath>
#include <cstddef>
#include <new>
#include <sys/mman.h>

#include <petscsys.h>
// LAPACK declarations need the types above.
#include <petscblaslapack.h>

namespace pounding {

void take_blas_memory() {
  constexpr std::size_t wanted = 132 << 20;
  void* const trial =
      mmap(nullptr, wanted, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (trial == MAP_FAILED) throw std::bad_alloc();
  munmap(trial, wanted);
  std::vector<double> matrix{1};
  std::vector<double> values{1};
  solve_dense(matrix, values);
}

bool solve_dense(std::vector<double>& matrix, std::vector<double>& values) {
  std::vector<int> pivots(values.size());
  return solve_dense(matrix, values, pivots);
}

bool solve_dense(std::span<double> matrix, std::span<double> values, std::span<int> pivots) {
  const std::size_t n = values.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) std::swap(matrix[i * n + j], matrix[j * n + i]);
  }
  auto order = static_cast<PetscBLASInt>(n);
  PetscBLASInt one = 1;
  PetscBLASInt info = 0;
  static_assert(sizeof(PetscBLASInt) == sizeof(int));
  LAPACKgesv_(&order, &one, matrix.data(), &order, pivots.data(), values.data(), &order, &info);
  return info == 0;
}

bool invert_definite(std::vector<double>& matrix) {
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(matrix.size())));
  auto order = static_cast<PetscBLASInt>(n);
  PetscBLASInt info = 0;
  LAPACKpotrf_("L", &order, matrix.data(), &order, &info);
  if (info == 0) LAPACKpotri_("L", &order, matrix.data(), &order, &info);
  for (std::size_t i = 0; i < n; ++i) {  // LAPACK's lower triangle is the upper one by rows
    for (std::size_t j = i + 1; j < n; ++j) matrix[j * n + i] = matrix[i * n + j];
  }
  return info == 0;
}

}  // namespace pounding
