#pragma once

#include <span>
#include <utility>
#include <vector>

#include <mpi.h>

#include "common/dense_matrix.h"

namespace pounding {

/// Orthonormal columns W over dofs that ranks share out; every rank has the rows of those that it
/// owns, and so of whatever is multiplied with them.
class OrthonormalSpace {
 public:
  /// `dofs`: owned ones.
  OrthonormalSpace(MPI_Comm comm, std::size_t dofs) : comm_(comm), columns_(dofs, 0) {}

  std::size_t size() const { return columns_.columns; }
  const DenseMatrix& columns() const { return columns_; }
  const double* column(std::size_t j) const { return columns_.column(j); }

  /// Takes memory for so many columns at once.
  void reserve(std::size_t columns) { columns_.values.reserve(columns * columns_.rows); }
  /// Adds a column of length 1 that is orthogonal to the others.
  void append(std::span<const double> column) { columns_.append(column); }
  /// Adds such columns that are orthogonal to each other as well.
  void append_columns(const DenseMatrix& columns) { columns_.append_columns(columns); }
  /// Keeps the columns of these increasing numbers, as `keep_first` does.
  void choose(const std::vector<std::size_t>& numbers);
  /// Keeps so many columns and gives all memory beyond them back; `reserve` still holds.
  void keep_first(std::size_t count);
  /// W := W S, S with orthonormal columns.
  void combine(const DenseMatrix& s) { combine_columns(columns_, s); }
  /// Takes other columns, orthonormal among themselves, in place of all.
  void replace(DenseMatrix&& columns) { columns_ = std::move(columns); }
  /// Gives all columns away.
  DenseMatrix release() { return std::exchange(columns_, DenseMatrix(columns_.rows, 0)); }

  /// W^T X, the same on all ranks, of the columns of W from `first` on. Collective.
  DenseMatrix parts(const DenseMatrix& x, std::size_t first = 0) const;
  /// X := (I - W W^T) X, of the columns of W from `first` on; returns W^T X. Collective.
  DenseMatrix project(DenseMatrix& x, std::size_t first = 0) const;
  /// Length of each column of X. Collective.
  std::vector<double> norms(const DenseMatrix& x) const;
  /// Scales the columns of X to length 1, but for those that are zero. Collective.
  void normalise(DenseMatrix& x) const;

  /// Adds the columns of X to the space, that with the largest remainder first, as long as this is
  /// above `least`; X is used up. Collective.
  void take_in(DenseMatrix& x, double least);

 private:
  MPI_Comm comm_;
  DenseMatrix columns_;
};

/// A^T B of matrices whose rows ranks share out, the same on all ranks, of the columns of A from
/// `first` on. Collective.
DenseMatrix product_over_ranks(MPI_Comm comm, const DenseMatrix& a, const DenseMatrix& b,
                               std::size_t first = 0);

}  // namespace pounding
