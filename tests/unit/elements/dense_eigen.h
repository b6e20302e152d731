#pragma once

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

/// Dense symmetric algebra for tests, by LAPACK. Matrices are full, so row- and column-major are
/// the same thing.
extern "C" {
void dsyev_(const char* jobz, const char* uplo, const int* n, double* a, const int* lda, double* w,
            double* work, const int* lwork, int* info);
void dposv_(const char* uplo, const int* n, const int* nrhs, double* a, const int* lda, double* b,
            const int* ldb, int* info);
void dsygv_(const int* itype, const char* jobz, const char* uplo, const int* n, double* a,
            const int* lda, double* b, const int* ldb, double* w, double* work, const int* lwork,
            int* info);
}

namespace pounding::testing_support {

/// Eigenvalues, ascending, of a symmetric matrix of shape (n, n).
inline std::vector<double> symmetric_eigenvalues(std::vector<double> matrix, std::size_t n) {
  std::vector<double> values(n), work(64 * n + 64);
  const int order = static_cast<int>(n);
  const int length = static_cast<int>(work.size());
  int info = 0;
  dsyev_("N", "L", &order, matrix.data(), &order, values.data(), work.data(), &length, &info);
  if (info != 0) throw std::runtime_error("dsyev failed");
  return values;
}

/// Eigenvalues, ascending, of K x = lambda M x, shape (n, n), M positive definite.
inline std::vector<double> generalized_eigenvalues(std::vector<double> stiffness,
                                                   std::vector<double> mass, std::size_t n) {
  std::vector<double> values(n), work(64 * n + 64);
  const int order = static_cast<int>(n);
  const int length = static_cast<int>(work.size());
  const int type = 1;
  int info = 0;
  dsygv_(&type, "N", "L", &order, stiffness.data(), &order, mass.data(), &order, values.data(),
         work.data(), &length, &info);
  if (info != 0) throw std::runtime_error("dsygv failed");
  return values;
}

/// Circular frequencies squared, ascending, of K x = omega^2 M x with M diagonal and positive.
inline std::vector<double> squared_circular_frequencies(std::vector<double> stiffness,
                                                        const std::vector<double>& lumped_mass) {
  const std::size_t n = lumped_mass.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      stiffness[i * n + j] /= std::sqrt(lumped_mass[i] * lumped_mass[j]);
  return symmetric_eigenvalues(std::move(stiffness), n);
}

/// Solution of K u = f, K symmetric positive definite.
inline std::vector<double> solve_positive_definite(std::vector<double> matrix,
                                                   std::vector<double> right_hand_side) {
  const int order = static_cast<int>(right_hand_side.size());
  const int one = 1;
  int info = 0;
  dposv_("L", &order, &one, matrix.data(), &order, right_hand_side.data(), &order, &info);
  if (info != 0) throw std::runtime_error("dposv failed");
  return right_hand_side;
}

}  // namespace pounding::testing_support
