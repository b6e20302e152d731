#include <algorithm>

#include "solvers/proportioning.h"

namespace pounding::interactions {

CoupledLcp::CoupledLcp(std::size_t max_rows)
    : dense_solver_(static_cast<int>(std::min(max_rows, most_dense_rows))), number_(max_rows, -1) {
  const std::size_t dense = std::min(max_rows, most_dense_rows);
  matrix_.resize(dense * dense);
}

LcpResult CoupledLcp::solve(const SparseRows& delassus, ProportioningSolver* many,
                            std::span<const std::size_t> active, std::span<const double> free_rate,
                            std::span<double> impulse) {
  const std::size_t n = active.size();
  const bool dense = n <= most_dense_rows && (many == nullptr || !many->shared());
  sparse_solver_ = dense ? nullptr : many;
  if (!dense) return many->solve(active, free_rate, impulse);
  const SparseRows& rows = many != nullptr ? many->delassus() : delassus;
  for (std::size_t i = 0; i < n; ++i) number_[active[i]] = static_cast<int>(i);
  std::fill_n(matrix_.begin(), n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = rows.begin[active[i]]; k < rows.begin[active[i] + 1]; ++k) {
      const int column = number_[rows.column[k]];
      if (column >= 0) matrix_[i * n + static_cast<std::size_t>(column)] = rows.value[k];
    }
  }
  for (const std::size_t row : active) number_[row] = -1;
  return dense_solver_.solve({matrix_.data(), n * n}, free_rate, impulse);
}

void CoupledLcp::correct(std::span<const double> gap_rate, std::span<double> impulse,
                         std::span<double> increment) {
  sparse_solver_ == nullptr ? dense_solver_.correct(gap_rate, impulse, increment)
                            : sparse_solver_->correct(gap_rate, impulse, increment);
}

}  // namespace pounding::interactions
