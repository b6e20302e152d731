#pragma once

#include <memory>
#include <span>
#include <vector>

#include "interactions/solvers/lcp.h"
#include "interactions/solvers/proportioning.h"
#include "interactions/solvers/sparse_rows.h"

namespace pounding::interactions {

/// Contact impulses of coupled rows by the solver that suits their number: the exact one of a dense
/// H for a few (LcpSolver), the one whose cost grows like the nonzeros of H for many
/// (ProportioningSolver). Not collective, no allocation after construction.
class CoupledLcp {
 public:
  /// Rows up to which the dense solver serves.
  static constexpr std::size_t most_dense_rows = 96;

  /// `max_rows`, `max_entries`: of the largest H.
  CoupledLcp(std::size_t max_rows, std::size_t max_entries);

  /// See ProportioningSolver::solve.
  LcpResult solve(const SparseRows& delassus, std::span<const double> free_rate,
                  std::span<double> impulse);
  /// See LcpSolver::correct, after solve().
  void correct(std::span<const double> gap_rate, std::span<double> impulse,
               std::span<double> increment);

 private:
  LcpSolver dense_solver_;
  std::unique_ptr<ProportioningSolver> sparse_solver_;  ///< null: all are few
  bool is_dense_ = true;                                ///< in the last solve()
  std::vector<double> matrix_;                          ///< H, row-major
};

}  // namespace pounding::interactions
