#include "modal/mumps_factor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "common/dense_matrix.h"
#include "common/parallel.h"

namespace pounding {
namespace mumps_factor_test {

constexpr PetscInt size = 150;

/// Springs between neighbours and between every seventh, all against a ground; rows are shared out
/// unevenly, and a rank may have none.
class Matrix {
 public:
  explicit Matrix(bool last_rank_has_none) {
    int ranks = 1;
    int rank = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const int holders = last_rank_has_none ? std::max(1, ranks - 1) : ranks;
    const auto end_of = [&](int r) {
      return r + 1 >= holders ? size : (r + 1) * size / holders - 9;
    };
    first = rank == 0 ? 0 : end_of(rank - 1);
    end = end_of(rank);
    POUNDING_PETSC(MatCreateAIJ(MPI_COMM_WORLD, end - first, end - first, size, size, 5, nullptr, 5,
                                nullptr, handle.out()));
    for (PetscInt row = first; row < end; ++row) {
      for (PetscInt column = 0; column < size; ++column) {
        if (const double value = at(row, column); value != 0) {
          POUNDING_PETSC(MatSetValue(handle.get(), row, column, value, INSERT_VALUES));
        }
      }
    }
    POUNDING_PETSC(MatAssemblyBegin(handle.get(), MAT_FINAL_ASSEMBLY));
    POUNDING_PETSC(MatAssemblyEnd(handle.get(), MAT_FINAL_ASSEMBLY));
  }

  static double at(PetscInt row, PetscInt column) {
    const PetscInt apart = std::abs(row - column);
    if (apart == 1 || apart == 7) return -1.0 / static_cast<double>(apart);
    return apart == 0 ? 2.5 + 0.01 * static_cast<double>(row) : 0;
  }

  PetscInt first = 0, end = 0;
  MatHandle handle;
};

double solution_at(PetscInt row, std::size_t column) {
  return std::sin(1 + 0.37 * static_cast<double>(row) + 1.1 * static_cast<double>(column));
}

/// Largest error of `columns` solutions of A - shift I.
double largest_error(const Matrix& matrix, const MumpsFactor& factor, double shift,
                     std::size_t columns) {
  const auto rows = static_cast<std::size_t>(matrix.end - matrix.first);
  DenseMatrix x(rows, columns);
  for (std::size_t j = 0; j < columns; ++j) {
    for (std::size_t i = 0; i < rows; ++i) {
      const PetscInt row = matrix.first + static_cast<PetscInt>(i);
      double force = -shift * solution_at(row, j);
      for (PetscInt k = 0; k < size; ++k) force += Matrix::at(row, k) * solution_at(k, j);
      x.column(j)[i] = force;
    }
  }
  factor.solve(x.values.data(), columns);
  double error = 0;
  for (std::size_t j = 0; j < columns; ++j) {
    for (std::size_t i = 0; i < rows; ++i) {
      const PetscInt row = matrix.first + static_cast<PetscInt>(i);
      error = std::max(error, std::abs(x.column(j)[i] - solution_at(row, j)));
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &error, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return error;
}

TEST(MumpsFactor, SolvesForOneColumnManyAndAgain) {
  for (const bool one_has_none : {false, true}) {
    const Matrix matrix(one_has_none);
    const MumpsFactor factor(matrix.handle.get(), -0.4);
    for (const std::size_t columns : {1, 3, 32, 70, 2}) {
      EXPECT_LT(largest_error(matrix, factor, -0.4, columns), 1e-13) << columns << one_has_none;
    }
  }
}

TEST(MumpsFactor, CountsTheEigenvaluesBelowItsShift) {
  const Matrix matrix(false);
  DenseMatrix whole(size, size);
  for (PetscInt j = 0; j < size; ++j) {
    for (PetscInt i = 0; i < size; ++i) {
      whole.column(static_cast<std::size_t>(j))[i] = Matrix::at(i, j);
    }
  }
  const std::vector<double> values = symmetric_eigenvalues(whole);
  for (const std::size_t below : {0, 1, 40, 149}) {
    const double shift = below == 0 ? values[0] - 1 : (values[below - 1] + values[below]) / 2;
    const MumpsFactor factor(matrix.handle.get(), shift);
    EXPECT_EQ(factor.negative_pivots(), static_cast<int>(below));
    EXPECT_LT(largest_error(matrix, factor, shift, 2), 1e-9);  // beside an eigenvalue
  }
}

TEST(MumpsFactor, SingularMatricesHaveNoSolution) {
  MatHandle nothing;
  const Matrix like(false);
  POUNDING_PETSC(MatDuplicate(like.handle.get(), MAT_DO_NOT_COPY_VALUES, nothing.out()));
  const MumpsFactor factor(nothing.get(), 0);
  std::vector<double> x(static_cast<std::size_t>(like.end - like.first), 1.0);
  EXPECT_THROW(factor.solve(x.data(), 1), std::runtime_error);
}

}  // namespace mumps_factor_test
}  // namespace pounding
