#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solvers/lcp.h"
#include "solvers/sparse_rows.h"

namespace pounding::interactions {

/// complementarity_residual of a sparse H.
double complementarity_residual(const SparseRows& delassus, std::span<const double> free_rate,
                                std::span<const double> impulse);

/// Contact impulses of one step where many rows are coupled: 0 <= lambda _|_ H lambda + b >= 0 with
/// H sparse, symmetric, positive semi-definite, in time and memory that grow like its nonzeros.
///
/// Proportioning with reduced gradient projections (MPRGP: Dostal and Schoeberl, Comput. Optim.
/// Appl. 30 (2005) 23) on  min 1/2 l^T H l + b^T l,  l >= 0,  scaled by the square roots of the
/// diagonal of H: conjugate gradients on the rows with an impulse, a projected step of fixed length
/// where an impulse would turn negative, a step along the violated rows where these weigh more. The
/// number of products with H depends on how H is conditioned (the masses that meet, the ratio of
/// the meshes), not on how many rows there are; the objective falls in every step. The gap rates
/// are formed anew before the answer is believed.
///
/// H singular: lambda is not unique (it depends on the start); L v+ and L^T lambda are. b is first
/// scaled by a power of two. The same input gives the same bits. Not collective, no allocation
/// after construction.
class ProportioningSolver {
 public:
  /// `max_rows`, `max_entries`: of the largest H.
  ProportioningSolver(std::size_t max_rows, std::size_t max_entries);

  /// `impulse`, shape (n): in, a guess (that of the last step, or zeros); out, the solution [N s].
  /// `free_rate` b shape (n) [m/s]. Bad numbers do not throw: see LcpMethod. `iterations` of the
  /// result counts products with H.
  LcpResult solve(const SparseRows& delassus, std::span<const double> free_rate,
                  std::span<double> impulse);

  /// Correction as by LcpSolver::correct, for the H of the last solve().
  void correct(std::span<const double> gap_rate, std::span<double> impulse,
               std::span<double> increment);

 private:
  /// A := D^-1/2 H D^-1/2 and its largest sum of magnitudes of a row.
  void scale(const SparseRows& delassus);
  /// b and the guess, scaled; counts rows that nothing can open in `result`.
  void start(std::span<const double> free_rate, std::span<const double> impulse, int exponent,
             LcpResult& result);
  /// gradient_ := A x + b, and its parts.
  void form_gradient();
  /// Free and violated parts of the gradient at x, and their sizes.
  void split_gradient();
  /// product_ := A p; returns p . A p.
  double multiply(std::span<const double> p);
  /// Round-off of H lambda [m/s], with b scaled.
  double roundoff() const;
  /// Steps until the residual is below `wanted`, nothing moves or there were too many.
  void iterate(double wanted, LcpResult& result);
  /// A step along direction_, with a projected one where an impulse would turn negative; false if
  /// nothing can move along it.
  bool conjugate_gradient_step(LcpResult& result);
  void proportioning_step(LcpResult& result);
  void restart_direction();

  std::size_t size_ = 0;        ///< of the last solve()
  double step_length_ = 0;      ///< of projected steps, below 2 / |A|
  double residual_ = 0;         ///< of complementarity [m/s], with b scaled
  double violated_square_ = 0;  ///< of the violated rows' gradient
  double reduced_square_ = 0;   ///< reduced free gradient times the free gradient
  SparseRows matrix_;           ///< A
  std::vector<double> root_;    ///< sqrt of H_ii; 0: a row that no impulse moves
  std::vector<double> rate_;    ///< b, scaled
  std::vector<double> x_;       ///< lambda, scaled
  std::vector<double> gradient_;
  std::vector<double> free_;
  std::vector<double> violated_;
  std::vector<double> direction_;
  std::vector<double> product_;
};

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
