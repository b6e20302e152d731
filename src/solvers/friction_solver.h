#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "solvers/anderson_mixing.h"
#include "solvers/sparse_rows.h"

namespace pounding::interactions {

/// How a frictional contact problem was solved.
struct FrictionResult {
  int sweeps = 0;       ///< block Gauss-Seidel
  int iterations = 0;   ///< Newton
  bool finite = true;   ///< false: a number was not finite; the impulses are set to zero
  double residual = 0;  ///< friction_residual of the answer [-]
};

/// Frictional contact problem of one step over n points, three unknowns each, normal first and
/// then two tangents at right angles: delassus H [1/kg], three rows per point, of which every one
/// has the columns of its own point, free rates b [m/s] and impulses lambda [N s], shape (3 n),
/// friction coefficients mu >= 0, shape (n).
///
///     v = b + H lambda,   0 <= lambda_n _|_ v_n >= 0,   |lambda_t| <= mu lambda_n,
///     v_t = -kappa lambda_t,  kappa >= 0,  kappa = 0 where |lambda_t| < mu lambda_n
struct FrictionProblem {
  const SparseRows& delassus;
  std::span<const double> free_rate;
  std::span<const double> coefficient;
};

/// Natural map of the frictional contact problem: how far lambda_n is from max(0, lambda_n -
/// v_n / H_nn) and lambda_t from the projection of lambda_t - v_t / h_t on the disk of radius
/// mu lambda_n, times H_nn and h_t, over max |b|; zero at a solution, infinity if a number is not
/// finite. Sums in extended precision, apart from the algorithm that found the impulse.
double friction_residual(const FrictionProblem& problem, std::span<const double> impulse);

/// Solver of the contact problem with Coulomb's friction.
///
/// A point alone whose normal and tangents do not feel each other is solved in closed form. Others:
/// block Gauss-Seidel over the points, each with its normal impulse in closed form and its
/// tangential one by solve_on_disk; then Newton's iteration on the natural map (Alart and Curnier,
/// Comput. Methods Appl. Mech. Eng. 92 (1991) 353) from there, taken only where the residual falls;
/// sweeps and Newton take turns until round-off or a limit of rounds, and the best of these is the
/// answer. Sweeps of many points, as of a pile of blocks, have momentum that ends where it leads
/// away (Nesterov, Sov. Math. Dokl. 27 (1983) 372; O'Donoghue and Candes, Found. Comput. Math. 15
/// (2015) 715), then are mixed (AndersonMixing), in turns; beyond so many that Newton's matrix
/// would cost too much these are all. H may be singular:
/// then the impulse is not unique. The same input gives the same bits. Not collective, no
/// allocation after construction.
class FrictionSolver {
 public:
  explicit FrictionSolver(std::size_t max_points);

  /// `impulse`: in, a guess (that of the last step, or zeros); out, the solution.
  FrictionResult solve(const FrictionProblem& problem, std::span<double> impulse);

 private:
  /// One sweep, of whose changes the part `relaxation` is taken; returns the largest change of a
  /// point's rates by its own impulses [m/s].
  static double sweep(const FrictionProblem& problem, double relaxation, std::span<double> impulse);
  /// Natural map, over max |b|; keeps the rates v and their round-off.
  double measure(const FrictionProblem& problem, std::span<const double> impulse);
  /// The impulses of one Newton step into trial_; false if there is none.
  bool try_newton(const FrictionProblem& problem, std::span<const double> impulse);
  void linearise(const FrictionProblem& problem, std::span<const double> impulse,
                 std::size_t number);
  /// Sweeps with the momentum of a round, or mixed ones, until the residual is `enough` or they
  /// come no closer; returns the residual.
  double hasten(const FrictionProblem& problem, std::optional<std::size_t> round, double enough,
                std::span<double> impulse, FrictionResult& result);
  /// The impulses of the next sweep with momentum: beyond `image`, that of the last one.
  void add_momentum(std::size_t round, std::span<const double> image, std::span<double> impulse);
  void solve_coupled(const FrictionProblem& problem, std::span<double> impulse,
                     FrictionResult& result);
  double iterate(const FrictionProblem& problem, std::span<double> impulse, double residual,
                 FrictionResult& result);

  std::size_t max_newton_;  ///< points above which Newton's matrix is not formed
  std::vector<double> rate_;
  std::vector<double> trial_;
  std::vector<double> jacobian_;
  std::vector<double> step_;
  std::vector<int> pivots_;
  std::vector<double> weight_;  ///< of impulses in the change by a sweep
  std::vector<double> image_;   ///< of a mixed sweep
  std::vector<double> least_;   ///< impulses that a mixed sweep changed least
  std::vector<double> best_;    ///< impulses of the least residual of all rounds
  AndersonMixing mixing_;
  /// Steps since momentum began anew, changes of the last sweep and the least ones [m/s].
  struct Momentum {
    int steps = 0;
    double last = std::numeric_limits<double>::infinity();
    double least = std::numeric_limits<double>::infinity();
  };
  Momentum momentum_;
  double largest_free_rate_ = 0;
  double noise_ = 0;
};

}  // namespace pounding::interactions
