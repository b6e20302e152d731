#include "interactions/solvers/coupled_lcp.h"

#include <algorithm>

namespace pounding::interactions {

CoupledLcp::CoupledLcp(std::size_t max_rows, std::size_t max_entries)
    : dense_solver_(static_cast<int>(std::min(max_rows, most_dense_rows))) {
  const std::size_t dense = std::min(max_rows, most_dense_rows);
  matrix_.resize(dense * dense);
  if (max_rows > most_dense_rows) {
    sparse_solver_ = std::make_unique<ProportioningSolver>(max_rows, max_entries);
  }
}

LcpResult CoupledLcp::solve(const SparseRows& delassus, std::span<const double> free_rate,
                            std::span<double> impulse) {
  const std::size_t n = delassus.rows();
  is_dense_ = n <= most_dense_rows;
  if (!is_dense_) return sparse_solver_->solve(delassus, free_rate, impulse);
  std::fill_n(matrix_.begin(), n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = delassus.begin[i]; k < delassus.begin[i + 1]; ++k) {
      matrix_[i * n + static_cast<std::size_t>(delassus.column[k])] = delassus.value[k];
    }
  }
  return dense_solver_.solve({matrix_.data(), n * n}, free_rate, impulse);
}

void CoupledLcp::correct(std::span<const double> gap_rate, std::span<double> impulse,
                         std::span<double> increment) {
  is_dense_ ? dense_solver_.correct(gap_rate, impulse, increment)
            : sparse_solver_->correct(gap_rate, impulse, increment);
}

}  // namespace pounding::interactions
