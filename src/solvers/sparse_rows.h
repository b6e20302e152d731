#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace pounding::interactions {

/// Round-off of one operation on numbers near one.
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Residual or bound of a problem without a finite one.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Sparse matrix in compressed rows. The entries of a row are in the order in which they were
/// added, by ascending columns where `entry` or a principal part is asked for.
struct SparseRows {
  std::vector<std::size_t> begin{0};  ///< shape (rows + 1)
  std::vector<int> column;            ///< shape (entries)
  std::vector<double> value;          ///< shape (entries)

  std::size_t rows() const { return begin.size() - 1; }
  std::size_t entries() const { return begin.back(); }
  std::span<const int> columns(std::size_t row) const {
    return {column.data() + begin[row], begin[row + 1] - begin[row]};
  }
  std::span<const double> values(std::size_t row) const {
    return {value.data() + begin[row], begin[row + 1] - begin[row]};
  }
  void add(int to_column, double entry) {
    column.push_back(to_column);
    value.push_back(entry);
  }
  /// Ends a row: it has all that was added since the last end.
  void end_row() { begin.push_back(column.size()); }
  void clear() {
    begin.resize(1);
    column.clear();
    value.clear();
  }
  /// Room for a matrix, so that filling it allocates nothing.
  void reserve(std::size_t rows, std::size_t entries) {
    begin.reserve(rows + 1);
    column.reserve(entries);
    value.reserve(entries);
  }
  /// The entry at a row and column, 0 where none is stored.
  double entry(std::size_t row, int at_column) const {
    const std::span<const int> there = columns(row);
    const auto found = std::ranges::lower_bound(there, at_column);
    if (found == there.end() || *found != at_column) return 0;
    return value[begin[row] + static_cast<std::size_t>(found - there.begin())];
  }
};

/// Product of one row with x, in the order of its entries; `Real`: the precision of its sum.
template <typename Real = double>
Real row_product(const SparseRows& matrix, std::size_t row, std::span<const double> x) {
  Real sum = 0;
  for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k) {
    sum += Real(matrix.value[k]) * Real(x[static_cast<std::size_t>(matrix.column[k])]);
  }
  return sum;
}

/// The principal part of a matrix: rows and columns with number[i] >= 0, which ascend and count
/// from 0. Allocates nothing where `part` has room.
void take_principal_part(const SparseRows& whole, std::span<const int> number, SparseRows& part);

}  // namespace pounding::interactions
