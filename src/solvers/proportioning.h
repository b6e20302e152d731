#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solvers/lcp.h"
#include "solvers/sparse_rows.h"

namespace pounding::interactions {

/// Link of a rank that solves some rows of H to the ranks that solve the others. Numbers of rows
/// are those of all ranks together. Collective over them.
class RowShare {
 public:
  RowShare() = default;
  RowShare(const RowShare&) = delete;
  RowShare& operator=(const RowShare&) = delete;
  virtual ~RowShare() = default;
  /// Brings the values at columns of this rank's rows that others have; `values`: per number.
  virtual void bring(std::span<double> values) = 0;
  /// Adds up `sums` over the ranks and takes the least of `least`, to the same bits on all.
  virtual void agree(std::span<double> sums, std::span<double> least) = 0;
};

/// Contact impulses of one step where many rows are coupled: 0 <= lambda _|_ H lambda + b >= 0 with
/// H sparse, symmetric, positive semi-definite, in time and memory that grow like its nonzeros.
///
/// Proportioning with reduced gradient projections (MPRGP: Dostal and Schoeberl, Comput. Optim.
/// Appl. 30 (2005) 23) on  min 1/2 l^T H l + b^T l,  l >= 0,  scaled by the square roots of the
/// diagonal of H: conjugate gradients on the rows with an impulse, a projected step of fixed length
/// where an impulse would turn negative, a step along the violated rows where these weigh more. The
/// number of products with H depends on how H is conditioned (the masses that meet, the ratio of
/// the meshes), not on how many rows there are; the objective falls in every step. The gap rates
/// are formed anew now and then, and before the answer is believed.
///
/// Several ranks may have a share of the rows each: they solve together, from numbers that they
/// agree on. H singular: lambda is not unique (it depends on the start); L v+ and L^T lambda are. b
/// is first scaled by a power of two. The same input on the same ranks gives the same bits.
/// Collective over the ranks of the share; no allocation after construction.
class ProportioningSolver {
 public:
  /// `delassus`: rows of H, columns ascending, whose numbers begin at `first`, a multiple of eight;
  /// `numbers`: of all ranks' rows, with those left out between two ranks, 0: of these rows.
  /// `share` must outlive the solver; null: there are no other ranks. Collective over its ranks.
  explicit ProportioningSolver(SparseRows delassus, std::size_t first = 0, std::size_t numbers = 0,
                               RowShare* share = nullptr);

  const SparseRows& delassus() const { return delassus_; }
  /// Other ranks have rows as well.
  bool shared() const { return share_ != nullptr; }

  /// Solves for the active rows, `active`: places among the rows here, ascending. `impulse`, shape
  /// (active): in, a guess (that of the last step, or zeros); out, the solution [N s]. `free_rate`
  /// b shape (active) [m/s]. Bad numbers do not throw: see LcpMethod. `iterations` of the result
  /// counts products with H; its numbers are those of all ranks.
  LcpResult solve(std::span<const std::size_t> active, std::span<const double> free_rate,
                  std::span<double> impulse);

  /// Correction as by LcpSolver::correct, for the rows of the last solve().
  void correct(std::span<const double> gap_rate, std::span<double> impulse,
               std::span<double> increment);

 private:
  /// A := D^-1/2 H D^-1/2 and its largest sum of magnitudes of a row.
  void scale();
  /// The active rows, b and the guess, scaled; counts rows that nothing can open in `result`.
  void start(std::span<const double> free_rate, std::span<const double> impulse, double factor,
             LcpResult& result);
  /// gradient_ := A x + b, its parts, and the round-off of A x.
  void form_gradient();
  /// Free part of the gradient at x, and the sizes of both parts.
  void split_gradient();
  /// product_ := A p, where p is zero for rows that are not active.
  void multiply(std::span<double> p);
  /// x += -length p and the gradient with it; rows with x / p <= `ends` get zero.
  void move(const std::vector<double>& p, double length, double ends);
  /// The answer's residual of complementarity over max |b|, infinite if a number is not finite.
  double residual(std::span<const double> free_rate, double largest);
  /// Steps until the residual is below `wanted`, nothing moves or there were too many; near
  /// round-off x is then that of the least residual.
  void iterate(double wanted, LcpResult& result);
  /// A step along direction_, with a projected one where an impulse would turn negative; false if
  /// nothing can move along it.
  bool conjugate_gradient_step(LcpResult& result);
  void proportioning_step(LcpResult& result);
  void restart_direction();
  void bring(std::span<double> values) {
    if (share_ != nullptr) share_->bring(values);
  }
  void agree(std::span<double> sums, std::span<double> least) {
    if (share_ != nullptr) share_->agree(sums, least);
  }

  SparseRows delassus_;
  /// A by groups of as many rows as a vector has lanes: their entries side by side, those of
  /// shorter rows filled up with zeros.
  std::vector<std::size_t> begin_;  ///< per group
  std::vector<double> value_;
  std::vector<int> column_;
  std::size_t first_;
  RowShare* share_;
  double step_length_ = 0;           ///< of projected steps, below 2 / |A|
  double residual_ = 0;              ///< of complementarity [m/s], with b scaled
  double roundoff_ = 0;              ///< of H lambda [m/s], with b scaled
  double violated_square_ = 0;       ///< of the violated rows' gradient
  double reduced_square_ = 0;        ///< reduced free gradient times the free gradient
  double free_product_ = 0;          ///< free gradient times product_
  std::vector<std::size_t> active_;  ///< places of the active rows
  std::vector<std::size_t> groups_;  ///< first places of the vectors of lanes that hold them
  std::vector<double> root_;         ///< square root of H_ii, per row
  std::vector<double> rate_;         ///< b
  std::vector<double> acts_;         ///< 1 for active rows, else 0
  std::vector<double> gradient_;     ///< A x + b
  std::vector<double> free_;         ///< of the gradient, where x > 0
  std::vector<double> product_;      ///< A p
  std::vector<double> best_;         ///< x of the least residual
  std::vector<double> x_;            ///< impulses, scaled; per number, as the next two
  std::vector<double> direction_;    ///< of the conjugate gradients
  std::vector<double> values_;       ///< violated part of the gradient; impulses
};

/// Solves any coupled rows: few that are active exactly, by LcpSolver, many by ProportioningSolver.
/// Collective over the ranks that share rows; no allocation after construction.
class CoupledLcp {
 public:
  static constexpr std::size_t most_dense_rows = 96;

  /// `max_rows`: of the largest H.
  explicit CoupledLcp(std::size_t max_rows);
  /// See ProportioningSolver::solve; `many`: the solver of a group of many rows, whose H it has in
  /// place of `delassus`, else null.
  LcpResult solve(const SparseRows& delassus, ProportioningSolver* many,
                  std::span<const std::size_t> active, std::span<const double> free_rate,
                  std::span<double> impulse);
  /// See LcpSolver::correct, after solve().
  void correct(std::span<const double> gap_rate, std::span<double> impulse,
               std::span<double> increment);

 private:
  LcpSolver dense_solver_;
  ProportioningSolver* sparse_solver_ = nullptr;  ///< of the last solve(); null: dense
  std::vector<double> matrix_;                    ///< H, row-major
  std::vector<int> number_;                       ///< per row, among the active ones; -1
};

}  // namespace pounding::interactions
