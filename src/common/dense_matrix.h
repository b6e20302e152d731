#pragma once

#include <vector>

namespace pounding {

/// A dense matrix in columns, as LAPACK wants it.
struct DenseMatrix {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> values;  ///< shape (columns, rows)

  DenseMatrix() = default;
  DenseMatrix(std::size_t row_count, std::size_t column_count)
      : rows(row_count), columns(column_count), values(row_count * column_count, 0.0) {}
  double* column(std::size_t j) { return values.data() + j * rows; }
  const double* column(std::size_t j) const { return values.data() + j * rows; }
  /// One more column.
  void append(const std::vector<double>& column) {
    values.insert(values.end(), column.begin(), column.end());
    ++columns;
  }
};

/// A^T B.
DenseMatrix transposed_product(const DenseMatrix& a, const DenseMatrix& b);

/// Eigenvalues of a symmetric matrix, increasing; its eigenvectors take the matrix' place. Throws
/// std::runtime_error if LAPACK fails.
std::vector<double> symmetric_eigenvalues(DenseMatrix& matrix);

}  // namespace pounding
