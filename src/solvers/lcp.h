#pragma once

#include <span>
#include <vector>

namespace pounding::interactions {

/// How an LCP was solved.
enum class LcpMethod {
  separated,   ///< b >= 0: no impulse
  diagonal,    ///< H diagonal: closed form
  active_set,  ///< sweeps, then the exact finish; complementarity holds to round-off
  stalled,     ///< the same, stopped by its limit of iterations: look at the residual
  not_finite   ///< H, b or the answer is not a finite number: the impulse is set to zero
};

struct LcpResult {
  LcpMethod method = LcpMethod::separated;
  int sweeps = 0;           ///< projected Gauss-Seidel
  int iterations = 0;       ///< linear solves of the exact finish
  int dependent_rows = 0;   ///< closed rows that follow from other closed rows (singular H)
  int infeasible_rows = 0;  ///< zero rows of H with b < 0: no impulse can open them
  double free_rate = 0;     ///< max |b| [m/s], 0 where b is not finite
  double residual = 0;      ///< complementarity_residual of the answer [-]
  /// Round-off of H lambda over max |b| [-], which a double cannot resolve. Above 1e-12 (mass
  /// ratios beyond 1e3) LcpSolver::correct() brings the gap rates down to round-off.
  double roundoff = 0;
};

/// How far `impulse` is from 0 <= lambda _|_ w = H lambda + b >= 0:
/// max_i |min(lambda_i H_ii, w_i)| / max |b|, zero at a solution; negative impulses and negative
/// gap rates both show; infinity if a number is not finite. Sums in extended precision, apart from
/// the algorithm that found the impulse. Delassus H, shape (n, n) row-major [1/kg]; free gap rate b
/// [m/s] and impulse [N s], shape (n).
double complementarity_residual(std::span<const double> delassus, std::span<const double> free_rate,
                                std::span<const double> impulse);

/// L D L^T of the rows and columns of H named one after the other; rows that depend on the earlier
/// ones are refused, so that a semi-definite H does no harm. No square roots: a scaling of H by
/// powers of two scales every number exactly.
class PrincipalFactor {
 public:
  explicit PrincipalFactor(int max_size);
  /// Start anew on H, shape (n, n) row-major, which must outlive the use.
  void reset(std::span<const double> delassus, int n);
  /// Add a row; false, and nothing added, if its pivot is round-off of the elimination.
  bool append(int row);
  /// After a refusal: the position of the row that weighs most in the combination, if it weighs at
  /// least twice the refused row; else -1.
  int weak_position() const { return weak_position_; }
  /// `row` instead of the row at `position`; rows that are no longer accepted go to `refused`.
  void exchange(int position, int row, std::vector<int>& refused);
  /// Keep the first `size` rows.
  void truncate(int size) { size_ = size; }
  int size() const { return size_; }
  int row(int k) const { return rows_[k]; }
  std::span<const int> rows() const { return {rows_.data(), static_cast<std::size_t>(size_)}; }
  /// x := (H on the rows)^-1 x, shape (size()).
  void solve(std::span<double> x) const;

 private:
  void back_substitute(std::span<double> x) const;
  double roundoff_of_pivot(double diagonal);
  const double* factor_row(int k) const { return &lower_[static_cast<std::size_t>(k) * stride_]; }

  std::size_t stride_;
  std::vector<double> lower_;  // unit lower triangle, row k in lower_[k * stride_ ...]
  std::vector<double> pivot_, diagonal_, work_;
  std::vector<int> rows_;
  std::span<const double> delassus_;
  int n_ = 0, size_ = 0, weak_position_ = -1;
};

/// The contact impulses of one step: 0 <= lambda _|_ H lambda + b >= 0 with H = L M^-1 L^T
/// symmetric positive semi-definite and b = L v_free.
///
/// 1. b >= 0, or H diagonal: closed form.
/// 2. Projected Gauss-Seidel sweeps from the given impulse, until the set of positive impulses
///    rests; it converges slowly at large mass ratios, so only this set is of interest.
/// 3. Exact finish, the primal active-set method on  min 1/2 l^T H l + b^T l,  l >= 0
///    (Lawson & Hanson 1974, ch. 23, started from 2. and adding all violated rows at once): solve
///    w = 0 on the rows in contact, go there as far as no impulse turns negative, take out those
///    that reach zero; at the full step add the rows with w < 0; end when there is none. The
///    objective falls in every round, so it ends whatever the mass ratio or the rank of H.
///
/// H singular: lambda is not unique (it depends on the start); L v+ and L^T lambda are. Rows that
/// differ by less than about 1e-7 of their size are dependent ones for H. Every tolerance is
/// relative; b is first scaled by a power of two. So the same input gives the same bits, and
/// scaling b, or H, by a power of two scales the impulse exactly. Not collective, no allocation
/// after construction.
class LcpSolver {
 public:
  explicit LcpSolver(int max_size);

  /// `impulse`, shape (n): in, a guess (that of the last step, or zeros); out, the solution [N s].
  /// `delassus` shape (n, n) row-major [1/kg], `free_rate` b shape (n) [m/s]; n <= max_size.
  /// Throws std::invalid_argument on shapes that do not fit. Bad numbers do not throw: see
  /// LcpMethod.
  LcpResult solve(std::span<const double> delassus, std::span<const double> free_rate,
                  std::span<double> impulse);

  /// Removes the round-off of the last solve(). `gap_rate` = L v+ with v+ = v_free + M^-1 L^T
  /// impulse; `increment` [N s], of either sign, is added to `impulse` and to be applied by the
  /// caller: v+ += M^-1 L^T increment. The delassus of the last solve() must still be there. An
  /// impulse does not turn negative.
  void correct(std::span<const double> gap_rate, std::span<double> impulse,
               std::span<double> increment);

 private:
  void sweep_until_set_rests(std::span<double> impulse, LcpResult& result);
  void finish_exactly(std::span<double> impulse, LcpResult& result);
  void start_set(std::span<const double> impulse);
  bool enter(int row);
  bool has_new_row() const;
  bool add_violated(int iteration);
  void compute_step();
  void refine(std::span<double> impulse);
  double step_to_boundary(std::span<double> impulse);
  void remove_marked();
  void update_gap_rate(std::span<const double> impulse);

  std::size_t max_size_;
  int size_ = 0;  // of the last solve()
  PrincipalFactor factor_;
  std::span<const double> delassus_;
  std::vector<double> free_rate_;  // b over 2^k, max |b| in [1, 2)
  std::vector<double> gap_rate_;   // w = b + H lambda
  std::vector<double> noise_;      // |b_i| + sum_j |H_ij| lambda_j
  std::vector<double> step_;       // of the impulse, in the order of the factor
  std::vector<int> dependent_;     // rows with an impulse that the factor refused
  std::vector<int> kept_;
  std::vector<char> in_contact_;  // per row: in the factor or in dependent_
  std::vector<char> is_new_;      // per row: added in this round
  std::vector<char> leaves_;      // per row of the factor
};

}  // namespace pounding::interactions
