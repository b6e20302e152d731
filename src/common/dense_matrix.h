#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "common/memory.h"

namespace pounding {

/// A dense matrix in columns, as LAPACK wants it.
struct DenseMatrix {
  std::size_t rows = 0;
  std::size_t columns = 0;
  LargeArray values;  ///< shape (columns, rows)

  DenseMatrix() = default;
  DenseMatrix(std::size_t row_count, std::size_t column_count)
      : rows(row_count), columns(column_count), values(row_count * column_count, 0.0) {}
  double* column(std::size_t j) { return values.data() + j * rows; }
  const double* column(std::size_t j) const { return values.data() + j * rows; }
  /// One more column.
  void append(std::span<const double> column) {
    values.insert(values.end(), column.begin(), column.end());
    ++columns;
  }
  /// All columns of a matrix of as many rows.
  void append_columns(const DenseMatrix& other) {
    values.insert(values.end(), other.values.begin(), other.values.end());
    columns += other.columns;
  }
  /// The numbers, one column behind the other.
  std::vector<double> numbers() const { return {values.begin(), values.end()}; }
  /// Takes a column out; the last one takes its place.
  void remove(std::size_t j) {
    std::copy_n(column(columns - 1), rows, column(j));
    --columns;
    values.resize(columns * rows);
  }
};

/// A^T B of the columns of A from `first` on.
DenseMatrix transposed_product(const DenseMatrix& a, const DenseMatrix& b, std::size_t first = 0);

/// C += factor A B of the columns of A from `first` on.
void add_product(double factor, const DenseMatrix& a, const DenseMatrix& b, DenseMatrix& c,
                 std::size_t first = 0);

/// A := A S, in the place of A, of at most as many columns as it has.
void combine_columns(DenseMatrix& a, const DenseMatrix& s);

/// Squared length of each column.
std::vector<double> squared_norms(const DenseMatrix& a);

/// Eigenvalues of a symmetric matrix, increasing; its eigenvectors take the matrix' place. Throws
/// std::runtime_error if LAPACK fails.
std::vector<double> symmetric_eigenvalues(DenseMatrix& matrix);

/// Largest eigenvalue of M^-1 K for one element: symmetric K, shape (n, n), and diagonal M > 0,
/// shape (n), in K's unit over M's unit. Rows without mass are left out. LAPACK dsyev.
double largest_eigenvalue(std::span<const double> stiffness, std::span<const double> mass);

/// Makes the BLAS take the memory that it works in. OpenBLAS asks for 128 MB of addresses at its
/// first product and, where a limit refuses them, for ever again. Throws std::bad_alloc in place of
/// that.
void take_blas_memory();

/// Solution of A x = b for a full matrix, shape (n, n) by rows, which is destroyed; `values`, shape
/// (n), holds b and receives x. False, and b lost, if A is singular. LAPACK dgesv.
bool solve_dense(std::vector<double>& matrix, std::vector<double>& values);

/// Solution of A x = b without allocation: `pivots`, shape (n), is scratch.
bool solve_dense(std::span<double> matrix, std::span<double> values, std::span<int> pivots);

/// Factor L of a symmetric positive definite matrix L L^T, shape (n, n) by rows, in its place, 0
/// above the diagonal. False, and the matrix lost, if it is not definite. LAPACK dpotrf.
bool factorise_definite(std::vector<double>& matrix);

/// Inverse of a symmetric positive definite matrix, shape (n, n), in its place, symmetric to the
/// last bit. False, and the matrix lost, if it is not definite. LAPACK dpotrf, dpotri.
bool invert_definite(std::vector<double>& matrix);

}  // namespace pounding
