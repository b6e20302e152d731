#include "solvers/friction_solver.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/array_reductions.h"
#include "common/dense_matrix.h"
#include "solvers/friction_point.h"
#include "solvers/sparse_rows.h"

namespace pounding::interactions {
namespace {

/// Residual that is wanted, and how far above the round-off of v it may end.
constexpr double wanted_residual = 1e-14;
constexpr double above_noise = 4;
/// Times the residual that is wanted: within it a round ends the search that does not halve it.
constexpr double near_wanted = 10;
constexpr std::size_t most_newton_rounds = 40;
constexpr int first_sweeps = 10;
constexpr int most_cheap_sweeps = 500;
constexpr int most_sweeps = 200;
/// Cost of an entry of H in a sweep, in multiply-adds of an elimination.
constexpr double sweep_cost = 4;
constexpr std::array<double, 4> relaxations{1, 1, 0.5, 0.2};
constexpr int most_newton = 20;
/// Shortest part of a Newton step that is tried.
constexpr double least_part = 1.0 / 16;
/// Points from which on sweeps are mixed: they are slow where many lie on each other.
constexpr std::size_t least_mixed_points = 65;
/// Sweeps after which those with momentum and mixed ones stop that have not come closer by half,
/// and all of them.
constexpr int most_idle_sweeps_with_momentum = 1000;
constexpr int most_idle_sweeps = 400;
constexpr int most_sweeps_of_all = 20000;
/// Sweeps with momentum or mixed ones between two looks at the residual.
constexpr int stretch = 25;
/// Momentum of a round: the largest part of the last step that is added, and the growth of the
/// changes over those of the last sweep that ends it. Where one does not arrive another may.
struct MomentumOfRound {
  double most;
  double growth;
};
constexpr std::array<MomentumOfRound, 3> momenta{{{0.95, infinity}, {0.99, 1.1}, {0.9, infinity}}};
/// Growth of the changes over the least ones since momentum began that ends it.
constexpr double grown = 10;
/// Growth of the changes over the least ones from which on mixing begins anew there.
constexpr double too_far = 4;
/// Points above which Newton's matrix would cost more than sweeps.
constexpr std::size_t most_newton_points = 256;
/// Share of H_nn, h_t that keeps Newton's matrix regular where H is not.
constexpr double regular_share = 1e-10;

/// One point alone without coupling of its normal and tangents.
void solve_alone(const FrictionProblem& problem, const FrictionPoint& point,
                 std::span<double> impulse) {
  const std::span<const double> b = problem.free_rate;
  impulse[0] = point.normal() > 0 ? std::max(0.0, -b[0]) / point.normal() : 0;
  const Tangents tangential = point.slide({b[1], b[2]}, problem.coefficient[0] * impulse[0]);
  impulse[1] = tangential[0];
  impulse[2] = tangential[1];
}

/// Sweeps that take about as long as one iteration of Newton.
int sweeps_for_one_newton(const FrictionProblem& problem) {
  const auto n = static_cast<double>(problem.delassus.rows());
  const double elimination = n * n * n / 3;
  const double sweep = sweep_cost * static_cast<double>(problem.delassus.entries());
  return static_cast<int>(std::min(elimination / sweep, 1.0 * most_cheap_sweeps));
}

template <typename Real>
Real row_rate(const FrictionProblem& problem, std::size_t row, std::span<const double> impulse) {
  const SparseRows& h = problem.delassus;
  Real rate = problem.free_rate[row];
  for (std::size_t k = h.begin[row]; k < h.begin[row + 1]; ++k) {
    rate += Real(h.value[k]) * Real(impulse[static_cast<std::size_t>(h.column[k])]);
  }
  return rate;
}

}  // namespace

double friction_residual(const FrictionProblem& problem, std::span<const double> impulse) {
  double worst = 0;
  for (std::size_t i = 0; 3 * i < impulse.size(); ++i) {
    const FrictionPoint point(problem.delassus, i);
    std::array<double, 3> rate{};
    for (std::size_t d = 0; d < 3; ++d) {
      rate[d] = static_cast<double>(row_rate<long double>(problem, 3 * i + d, impulse));
    }
    const double map = point.natural_map(problem.coefficient[i], rate.data(), &impulse[3 * i]);
    if (!std::isfinite(map)) return infinity;
    worst = std::max(worst, map);
  }
  const double scale = largest_magnitude(problem.free_rate);
  return worst > 0 ? worst / scale : 0;
}

FrictionSolver::FrictionSolver(std::size_t max_points)
    : max_newton_(std::min(max_points, most_newton_points)),
      rate_(3 * max_points),
      trial_(3 * max_points),
      jacobian_(9 * max_newton_ * max_newton_),
      step_(3 * max_newton_),
      pivots_(3 * max_newton_),
      weight_(3 * max_points),
      image_(3 * max_points),
      least_(3 * max_points),
      best_(3 * max_points),
      mixing_(max_points < least_mixed_points ? 0 : 3 * max_points) {}

double FrictionSolver::measure(const FrictionProblem& problem, std::span<const double> impulse) {
  const std::size_t n = impulse.size();
  double worst = 0;
  noise_ = 0;
  for (std::size_t row = 0; row < n; ++row) {
    rate_[row] = row_rate<double>(problem, row, impulse);
    const SparseRows& h = problem.delassus;
    double terms = std::abs(problem.free_rate[row]);
    for (std::size_t k = h.begin[row]; k < h.begin[row + 1]; ++k) {
      terms += std::abs(h.value[k] * impulse[h.column[k]]);
    }
    noise_ = std::max(noise_, epsilon * terms / largest_free_rate_);
  }
  for (std::size_t i = 0; 3 * i < n; ++i) {
    const double map = FrictionPoint(problem.delassus, i)
                           .natural_map(problem.coefficient[i], &rate_[3 * i], &impulse[3 * i]);
    worst = std::max(worst, map);
  }
  return worst / largest_free_rate_;
}

double FrictionSolver::sweep(const FrictionProblem& problem, double relaxation,
                             std::span<double> impulse) {
  double change = 0;
  for (std::size_t i = 0; 3 * i < impulse.size(); ++i) {
    const FrictionPoint point(problem.delassus, i);
    double* const lambda = &impulse[point.first];
    const std::array<double, 3> before{lambda[0], lambda[1], lambda[2]};
    const double h = point.normal();
    if (h > 0) {
      const double rate = row_rate<double>(problem, point.first, impulse);
      lambda[0] = std::max(0.0, lambda[0] - rate / h);
    }
    Tangents free{};
    for (std::size_t a = 0; a < 2; ++a) {
      free[a] = row_rate<double>(problem, point.first + 1 + a, impulse) -
                point.h(1 + a, 1) * lambda[1] - point.h(1 + a, 2) * lambda[2];
    }
    const Tangents tangential = point.slide(free, problem.coefficient[i] * lambda[0]);
    lambda[1] = tangential[0];
    lambda[2] = tangential[1];
    for (std::size_t d = 0; d < 3; ++d) {
      lambda[d] = before[d] + relaxation * (lambda[d] - before[d]);
    }
    change = std::max({change, h * std::abs(lambda[0] - before[0]),
                       point.tangential() * size(lambda[1] - before[1], lambda[2] - before[2])});
  }
  return change;
}

void FrictionSolver::linearise(const FrictionProblem& problem, std::span<const double> impulse,
                               std::size_t number) {
  const std::size_t n = impulse.size();
  const FrictionPoint point(problem.delassus, number);
  const double* const lambda = &impulse[point.first];
  const double* const v = &rate_[point.first];
  const auto row = [&](std::size_t d) { return jacobian_.data() + (point.first + d) * n; };
  const auto add_delassus = [&](std::size_t d, double factor, double* out) {
    const SparseRows& h = problem.delassus;
    for (std::size_t k = h.begin[point.first + d]; k < h.begin[point.first + d + 1]; ++k) {
      out[h.column[k]] += factor * h.value[k];
    }
  };
  const auto wants_rate = [&](std::size_t d, double h) {  // v_d = 0
    add_delassus(d, 1, row(d));
    row(d)[point.first + d] += regular_share * h;
    step_[point.first + d] = -v[d];
  };
  const auto wants_no_impulse = [&](std::size_t d, double h) {
    row(d)[point.first + d] = h;
    step_[point.first + d] = -h * lambda[d];
  };
  const double h = point.normal() > 0 ? point.normal() : 1;
  const double t = point.tangential() > 0 ? point.tangential() : 1;
  for (std::size_t d = 0; d < 3; ++d) std::fill(row(d), row(d) + n, 0.0);
  const bool closed = point.normal() > 0 && lambda[0] - v[0] / h > 0;
  const double radius = problem.coefficient[number] * std::max(0.0, lambda[0]);
  if (!closed || !(point.tangential() > 0) || !(radius > 0)) {
    closed ? wants_rate(0, h) : wants_no_impulse(0, h);
    wants_no_impulse(1, t);
    wants_no_impulse(2, t);
    return;
  }
  wants_rate(0, h);
  const Tangents d{lambda[1] - v[1] / t, lambda[2] - v[2] / t};
  const double length = size(d[0], d[1]);
  if (length <= radius) {
    wants_rate(1, t);
    wants_rate(2, t);
    return;
  }
  // t (lambda_t - radius e) = 0 with e = d / |d|, d = lambda_t - v_t / t.
  const Tangents e{d[0] / length, d[1] / length};
  for (std::size_t a = 0; a < 2; ++a) {
    const double across[2] = {(a == 0 ? 1.0 : 0.0) - e[a] * e[0],
                              (a == 1 ? 1.0 : 0.0) - e[a] * e[1]};
    double* const out = row(1 + a);
    for (std::size_t b = 0; b < 2; ++b) {
      const double part = radius / length * across[b];
      add_delassus(1 + b, part, out);
      out[point.first + 1 + b] -= t * part;
    }
    out[point.first + 1 + a] += t;
    out[point.first] -= t * problem.coefficient[number] * e[a];
    step_[point.first + 1 + a] = -t * (lambda[1 + a] - radius * e[a]);
  }
}

bool FrictionSolver::try_newton(const FrictionProblem& problem, std::span<const double> impulse) {
  const std::size_t n = impulse.size();
  for (std::size_t i = 0; 3 * i < n; ++i) linearise(problem, impulse, i);
  if (!solve_dense({jacobian_.data(), n * n}, {step_.data(), n}, {pivots_.data(), n})) return false;
  return all_finite({step_.data(), n});
}

double FrictionSolver::iterate(const FrictionProblem& problem, std::span<double> impulse,
                               double residual, FrictionResult& result) {
  const std::size_t n = impulse.size();
  for (int i = 0; i < most_newton && try_newton(problem, impulse); ++i) {
    ++result.iterations;
    double reached = infinity;
    for (double part = 1; part >= least_part && !(reached < residual); part /= 2) {
      for (std::size_t row = 0; row < n; ++row) trial_[row] = impulse[row] + part * step_[row];
      for (std::size_t row = 0; row < n; row += 3) trial_[row] = std::max(0.0, trial_[row]);
      reached = measure(problem, {trial_.data(), n});
    }
    if (!(reached < residual)) break;
    std::copy_n(trial_.begin(), n, impulse.begin());
    residual = reached;
    if (residual <= wanted_residual) break;
  }
  return residual;
}

void FrictionSolver::add_momentum(std::size_t round, std::span<const double> image,
                                  std::span<double> impulse) {
  const auto& [most, growth] = momenta[round % momenta.size()];
  const std::size_t n = impulse.size();
  double size = 0;
  double against = 0;  // of the last step and of the present change
  for (std::size_t i = 0; i < n; ++i) {
    const double change = weight_[i] * (image[i] - impulse[i]);
    size += change * change;
    against -= change * (image[i] - trial_[i]);
  }
  size = std::sqrt(size);
  momentum_.least = std::min(momentum_.least, size);
  if (against > 0 || size > growth * momentum_.last || size > grown * momentum_.least) {
    momentum_ = {0, infinity, size};
  } else {
    momentum_.last = size;
  }
  const double part = std::min(most, momentum_.steps / (momentum_.steps + 3.0));
  ++momentum_.steps;
  for (std::size_t i = 0; i < n; ++i) impulse[i] = image[i] + part * (image[i] - trial_[i]);
  std::ranges::copy(image, trial_.begin());
}

double FrictionSolver::hasten(const FrictionProblem& problem, std::optional<std::size_t> round,
                              double enough, std::span<double> impulse, FrictionResult& result) {
  const std::size_t n = impulse.size();
  for (std::size_t i = 0; 3 * i < n; ++i) {
    const FrictionPoint point(problem.delassus, i);
    for (std::size_t d = 0; d < 3; ++d) weight_[3 * i + d] = point.h(d, d);
  }
  const std::span<double> image(image_.data(), n);
  const int most_idle = round ? most_idle_sweeps_with_momentum : most_idle_sweeps;
  double least = infinity;  // change of a sweep
  double mark = infinity;
  int idle = 0;
  mixing_.forget();
  momentum_ = {};
  std::ranges::copy(impulse, least_.begin());
  std::ranges::copy(impulse, trial_.begin());
  for (; idle < most_idle && result.sweeps < most_sweeps_of_all; ++idle) {
    ++result.sweeps;
    std::ranges::copy(impulse, image.begin());
    const double change = sweep(problem, 1, image);
    if (change < least) {
      least = change;
      std::ranges::copy(image, least_.begin());
    }
    if (least < mark / 2) {
      mark = least;
      idle = 0;
    }
    if (change <= epsilon * largest_free_rate_) break;
    if (result.sweeps % stretch == 0 && measure(problem, image) <= enough) {
      std::ranges::copy(image, impulse.begin());
      return measure(problem, impulse);
    }
    if (round) {
      add_momentum(*round, image, impulse);
    } else if (change > too_far * least) {
      std::copy_n(least_.begin(), n, impulse.begin());
      least = infinity;
      mixing_.forget();
    } else {
      mixing_.mix({weight_.data(), n}, image, impulse);
    }
  }
  // Momentum goes on from where it is: near its best place the next one would come back there.
  if (round) {
    std::ranges::copy(image, impulse.begin());
  } else {
    std::copy_n(least_.begin(), n, impulse.begin());
  }
  return measure(problem, impulse);
}

void FrictionSolver::solve_coupled(const FrictionProblem& problem, std::span<double> impulse,
                                   FrictionResult& result) {
  const std::size_t n = impulse.size();
  int sweeps = first_sweeps;
  double last = infinity;
  double best = infinity;
  const auto keep = [&](double residual) {
    if (!(residual < best)) return;
    best = residual;
    std::ranges::copy(impulse, best_.begin());
  };
  const int cheap = sweeps_for_one_newton(problem);
  for (std::size_t round = 0; round < most_newton_rounds && result.sweeps < most_sweeps_of_all;) {
    // Sweeps that go round in circles are led out of them by shorter steps.
    const double relaxation = relaxations[round % relaxations.size()];
    for (int i = 0; i < sweeps; ++i) {
      ++result.sweeps;
      if (sweep(problem, relaxation, impulse) <= epsilon * largest_free_rate_) break;
    }
    double residual = measure(problem, impulse);
    const double enough = std::max(wanted_residual, above_noise * noise_);
    if (residual <= enough) return;
    const bool falls = residual < last / 2;
    last = residual;
    const bool many = n >= 3 * least_mixed_points;
    if (falls && !many && result.sweeps < cheap) continue;
    if (many) {
      keep(residual);
      residual = hasten(problem, round, enough, impulse, result);
      keep(residual);
      if (residual > enough) residual = hasten(problem, std::nullopt, enough, impulse, result);
    }
    if (residual > enough && n <= 3 * max_newton_) {
      residual = iterate(problem, impulse, residual, result);
    }
    if (residual <= enough) return;
    // The free rates of points of one rigid body may lie beside the range of H by rounding: no
    // impulses come closer then.
    const bool stays = residual <= near_wanted * enough && residual > best / 2;
    keep(residual);
    if (stays) break;
    ++round;
    sweeps = std::min(2 * sweeps, most_sweeps);
  }
  if (best < infinity) std::copy_n(best_.begin(), n, impulse.begin());
}

FrictionResult FrictionSolver::solve(const FrictionProblem& problem, std::span<double> impulse) {
  const std::size_t n = impulse.size();
  FrictionResult result;
  largest_free_rate_ = largest_magnitude(problem.free_rate);
  if (!all_finite(problem.free_rate) || !all_finite(problem.delassus.value) ||
      !all_finite(impulse)) {
    std::ranges::fill(impulse, 0.0);
    return {0, 0, false, infinity};
  }
  if (largest_free_rate_ == 0) {
    std::ranges::fill(impulse, 0.0);
    return result;
  }
  const FrictionPoint first(problem.delassus, 0);
  if (n == 3 && first.uncoupled()) {
    solve_alone(problem, first, impulse);
  } else {
    solve_coupled(problem, impulse, result);
  }
  result.residual = friction_residual(problem, impulse);
  result.finite = all_finite(impulse);
  if (!result.finite) std::ranges::fill(impulse, 0.0);
  return result;
}

}  // namespace pounding::interactions
