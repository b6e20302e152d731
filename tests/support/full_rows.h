#pragma once

#include <cmath>
#include <vector>

#include "solvers/sparse_rows.h"

namespace pounding {

/// All entries of a square matrix, row-major, as sparse rows.
inline interactions::SparseRows full_rows(const std::vector<double>& matrix) {
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(matrix.size())));
  interactions::SparseRows rows;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) rows.add(static_cast<int>(j), matrix[i * n + j]);
    rows.end_row();
  }
  return rows;
}

}  // namespace pounding
