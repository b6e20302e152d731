#include "common/dense_matrix.h"

#include <cmath>
#include <new>
#include <stdexcept>
#include <string>
#include <sys/mman.h>

#include <petscsys.h>
#include <slepceps.h>
// LAPACK declarations need the types above.
#include <petscblaslapack.h>
#include <slepcblaslapack.h>

namespace pounding {

DenseMatrix transposed_product(const DenseMatrix& a, const DenseMatrix& b, std::size_t first) {
  DenseMatrix c(a.columns - first, b.columns);
  const auto m = static_cast<PetscBLASInt>(a.columns - first);
  const auto n = static_cast<PetscBLASInt>(b.columns);
  const auto k = static_cast<PetscBLASInt>(a.rows);
  const double one = 1;
  const double zero = 0;
  if (m > 0 && n > 0 && k > 0) {
    BLASgemm_("T", "N", &m, &n, &k, &one, a.column(first), &k, b.values.data(), &k, &zero,
              c.values.data(), &m);
  }
  return c;
}

void add_product(double factor, const DenseMatrix& a, const DenseMatrix& b, DenseMatrix& c,
                 std::size_t first) {
  const auto m = static_cast<PetscBLASInt>(a.rows);
  const auto n = static_cast<PetscBLASInt>(b.columns);
  const auto k = static_cast<PetscBLASInt>(a.columns - first);
  const double one = 1;
  if (m > 0 && n > 0 && k > 0) {
    BLASgemm_("N", "N", &m, &n, &k, &factor, a.column(first), &m, b.values.data(), &k, &one,
              c.values.data(), &m);
  }
}

void combine_columns(DenseMatrix& a, const DenseMatrix& s) {
  constexpr std::size_t panel = 4096;  // rows
  const auto n = static_cast<PetscBLASInt>(s.columns);
  const auto k = static_cast<PetscBLASInt>(a.columns);
  const auto stride = static_cast<PetscBLASInt>(a.rows);
  const double one = 1;
  const double zero = 0;
  DenseMatrix part(std::min(panel, a.rows), s.columns);
  for (std::size_t first = 0; n > 0 && first < a.rows; first += panel) {
    const std::size_t count = std::min(panel, a.rows - first);
    const auto m = static_cast<PetscBLASInt>(count);
    BLASgemm_("N", "N", &m, &n, &k, &one, a.column(0) + first, &stride, s.values.data(), &k, &zero,
              part.values.data(), &m);
    for (std::size_t j = 0; j < s.columns; ++j) {
      std::copy_n(part.values.data() + j * count, count, a.column(j) + first);
    }
  }
  a.columns = s.columns;
  a.values.resize(a.columns * a.rows);
}

std::vector<double> squared_norms(const DenseMatrix& a) {
  std::vector<double> squares;
  const auto n = static_cast<PetscBLASInt>(a.rows);
  const PetscBLASInt stride = 1;
  for (std::size_t j = 0; j < a.columns; ++j) {
    squares.push_back(BLASdot_(&n, a.column(j), &stride, a.column(j), &stride));
  }
  return squares;
}

std::vector<double> symmetric_eigenvalues(DenseMatrix& matrix) {
  auto order = static_cast<PetscBLASInt>(matrix.rows);
  std::vector<double> eigenvalues(matrix.rows);
  PetscBLASInt info = 0;
  PetscBLASInt asked = -1;
  double work_size = 0;
  PetscBLASInt integer_size = 0;
  const auto decompose = [&](double* work, PetscBLASInt* size, PetscBLASInt* integers,
                             PetscBLASInt* integer_count) {
    LAPACKsyevd_("V", "U", &order, matrix.values.data(), &order, eigenvalues.data(), work, size,
                 integers, integer_count, &info);
  };
  decompose(&work_size, &asked, &integer_size, &asked);
  std::vector<double> work(static_cast<std::size_t>(work_size));
  std::vector<PetscBLASInt> integers(static_cast<std::size_t>(integer_size));
  auto size = static_cast<PetscBLASInt>(work.size());
  decompose(work.data(), &size, integers.data(), &integer_size);
  if (info != 0) throw std::runtime_error("dsyevd failed with info " + std::to_string(info));
  return eigenvalues;
}

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

bool factorise_definite(std::vector<double>& matrix) {
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(matrix.size())));
  auto order = static_cast<PetscBLASInt>(n);
  PetscBLASInt info = 0;
  LAPACKpotrf_("U", &order, matrix.data(), &order, &info);  // LAPACK's columns are the rows
  for (std::size_t i = 0; i < n; ++i) {
    std::fill(&matrix[i * n] + i + 1, &matrix[i * n] + n, 0.0);
  }
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
