#include "solvers/proportioning.h"

#include <algorithm>
#include <cmath>

#include "common/array_reductions.h"
#include "solvers/sparse_rows.h"

namespace pounding::interactions {
namespace {

/// Length of projected steps times the bound of |A|; any length below 2 makes the objective fall.
constexpr double step_times_norm = 1.9;
/// Residuals in round-offs: where the steps end, and where the answer is believed.
constexpr double wanted_roundoffs = 1;
constexpr double believed_roundoffs = 8;
/// How often the gap rates are formed anew, and products with H between.
constexpr int most_rounds = 5;
constexpr int most_products = 4000;
/// Part of the gap rates that a correction may leave.
constexpr double correction_accuracy = 1e-8;

double dot(std::span<const double> a, std::span<const double> b) {
  return dot_product(a.data(), b.data(), a.size());
}

}  // namespace

double complementarity_residual(const SparseRows& delassus, std::span<const double> free_rate,
                                std::span<const double> impulse) {
  double worst = 0;
  for (std::size_t i = 0; i < free_rate.size(); ++i) {
    const auto rate =
        static_cast<double>(free_rate[i] + row_product<long double>(delassus, i, impulse));
    const double closing = delassus.entry(i, static_cast<int>(i)) * impulse[i];
    if (!std::isfinite(closing) || !std::isfinite(rate)) return infinity;
    worst = std::max(worst, std::abs(std::min(closing, rate)));
  }
  const double largest = largest_magnitude(free_rate);
  return largest > 0 ? worst / largest : worst;
}

ProportioningSolver::ProportioningSolver(std::size_t max_rows, std::size_t max_entries)
    : root_(max_rows),
      rate_(max_rows),
      x_(max_rows),
      gradient_(max_rows),
      free_(max_rows),
      violated_(max_rows),
      direction_(max_rows),
      product_(max_rows) {
  matrix_.reserve(max_rows, max_entries);
}

void ProportioningSolver::scale(const SparseRows& delassus) {
  for (std::size_t i = 0; i < size_; ++i) {
    root_[i] = std::sqrt(std::max(0.0, delassus.entry(i, static_cast<int>(i))));
  }
  matrix_.begin.assign(delassus.begin.begin(), delassus.begin.end());
  matrix_.column.assign(delassus.column.begin(), delassus.column.end());
  matrix_.value.assign(delassus.value.begin(), delassus.value.end());
  double largest = 1;
  for (std::size_t i = 0; i < size_; ++i) {
    double sum = 0;
    for (std::size_t k = matrix_.begin[i]; k < matrix_.begin[i + 1]; ++k) {
      const double roots = root_[i] * root_[matrix_.column[k]];
      matrix_.value[k] = roots > 0 ? matrix_.value[k] / roots : 0;
      sum += std::abs(matrix_.value[k]);
    }
    largest = std::max(largest, sum);
  }
  step_length_ = step_times_norm / largest;
}

void ProportioningSolver::start(std::span<const double> free_rate, std::span<const double> impulse,
                                int exponent, LcpResult& result) {
  for (std::size_t i = 0; i < size_; ++i) {
    rate_[i] = 0;
    x_[i] = 0;
    if (!(root_[i] > 0)) {
      if (free_rate[i] < 0) ++result.infeasible_rows;
      continue;
    }
    rate_[i] = std::scalbn(free_rate[i], -exponent) / root_[i];
    const double guess = std::scalbn(impulse[i], -exponent) * root_[i];
    if (std::isfinite(guess) && guess > 0) x_[i] = guess;
  }
}

double ProportioningSolver::multiply(std::span<const double> p) {
  for (std::size_t i = 0; i < size_; ++i) product_[i] = row_product(matrix_, i, p);
  return dot(p, {product_.data(), size_});
}

void ProportioningSolver::form_gradient() {
  for (std::size_t i = 0; i < size_; ++i) gradient_[i] = row_product(matrix_, i, x_) + rate_[i];
  split_gradient();
}

void ProportioningSolver::split_gradient() {
  residual_ = violated_square_ = reduced_square_ = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    const double g = gradient_[i];
    const bool held = x_[i] > 0;
    free_[i] = held ? g : 0;
    violated_[i] = held ? 0 : std::min(g, 0.0);
    violated_square_ += violated_[i] * violated_[i];
    reduced_square_ += free_[i] * std::min(x_[i] / step_length_, free_[i]);
    residual_ = std::max(residual_, root_[i] * std::abs(std::min(x_[i], g)));
  }
}

void ProportioningSolver::restart_direction() {
  std::copy_n(free_.begin(), size_, direction_.begin());
}

double ProportioningSolver::roundoff() const {
  double worst = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    double sum = std::abs(rate_[i]);
    for (std::size_t k = matrix_.begin[i]; k < matrix_.begin[i + 1]; ++k) {
      sum += std::abs(matrix_.value[k]) * x_[matrix_.column[k]];
    }
    worst = std::max(worst, root_[i] * sum);
  }
  return epsilon * worst;
}

bool ProportioningSolver::conjugate_gradient_step(LcpResult& result) {
  const std::span<const double> p(direction_.data(), size_);
  const double curvature = multiply(p);
  ++result.iterations;
  double most = infinity;  // length at which the first impulse is zero
  for (std::size_t i = 0; i < size_; ++i) {
    if (p[i] > 0) most = std::min(most, x_[i] / p[i]);
  }
  const double fall = dot(p, {gradient_.data(), size_});
  const double best = curvature > 0 && fall > 0 ? fall / curvature : infinity;
  const double length = std::min(best, most);
  if (!std::isfinite(length)) return false;
  for (std::size_t i = 0; i < size_; ++i) {
    const bool ends = p[i] > 0 && x_[i] / p[i] <= length;
    x_[i] = ends ? 0.0 : x_[i] - length * p[i];
    gradient_[i] -= length * product_[i];
  }
  split_gradient();
  if (best <= most) {
    const double part = dot({free_.data(), size_}, {product_.data(), size_}) / curvature;
    for (std::size_t i = 0; i < size_; ++i) direction_[i] = free_[i] - part * direction_[i];
    return true;
  }
  for (std::size_t i = 0; i < size_; ++i) x_[i] = std::max(0.0, x_[i] - step_length_ * free_[i]);
  form_gradient();
  ++result.iterations;
  restart_direction();
  return true;
}

void ProportioningSolver::proportioning_step(LcpResult& result) {
  const std::span<const double> d(violated_.data(), size_);
  const double curvature = multiply(d);
  ++result.iterations;
  // No curvature, no product: such rows open only with others.
  const double length = curvature > 0 ? dot(d, {gradient_.data(), size_}) / curvature : 0;
  for (std::size_t i = 0; i < size_; ++i) {
    x_[i] -= length * d[i];
    gradient_[i] -= length * product_[i];
  }
  split_gradient();
  restart_direction();
}

void ProportioningSolver::iterate(double wanted, LcpResult& result) {
  while (residual_ > wanted && result.iterations < most_products) {
    if (violated_square_ > reduced_square_) {
      proportioning_step(result);
    } else if (!conjugate_gradient_step(result)) {
      return;
    }
  }
}

LcpResult ProportioningSolver::solve(const SparseRows& delassus, std::span<const double> free_rate,
                                     std::span<double> impulse) {
  LcpResult result;
  size_ = free_rate.size();
  const auto give_up = [&] {
    std::ranges::fill(impulse, 0.0);
    result.method = LcpMethod::not_finite;
    result.residual = infinity;
    return result;
  };
  if (!all_finite(free_rate)) return give_up();
  if (std::ranges::all_of(free_rate, [](double b) { return b >= 0; })) {
    std::ranges::fill(impulse, 0.0);
    return result;
  }
  const double largest = largest_magnitude(free_rate);
  const int exponent = std::ilogb(largest);
  scale(delassus);
  start(free_rate, impulse, exponent, result);
  result.method = LcpMethod::stalled;
  form_gradient();
  for (int round = 0; round < most_rounds && result.method == LcpMethod::stalled; ++round) {
    restart_direction();
    iterate(wanted_roundoffs * roundoff(), result);
    form_gradient();
    if (residual_ <= believed_roundoffs * roundoff()) result.method = LcpMethod::active_set;
  }
  for (std::size_t i = 0; i < size_; ++i) {
    impulse[i] = root_[i] > 0 ? std::scalbn(x_[i] / root_[i], exponent) : 0;
  }
  if (!all_finite(impulse)) return give_up();
  result.roundoff = roundoff() / std::scalbn(largest, -exponent);
  result.residual = complementarity_residual(delassus, free_rate, impulse);
  return result;
}

void ProportioningSolver::correct(std::span<const double> gap_rate, std::span<double> impulse,
                                  std::span<double> increment) {
  const auto held = [&](std::size_t i) { return impulse[i] > 0 && root_[i] > 0; };
  std::fill_n(x_.begin(), size_, 0.0);
  for (std::size_t i = 0; i < size_; ++i) free_[i] = held(i) ? gap_rate[i] / root_[i] : 0;
  restart_direction();
  double square = dot({free_.data(), size_}, {free_.data(), size_});
  const double enough = correction_accuracy * correction_accuracy * square;
  for (int i = 0; i < most_products && square > enough; ++i) {
    const double curvature = multiply({direction_.data(), size_});
    if (!(curvature > 0)) break;
    const double length = square / curvature;
    for (std::size_t k = 0; k < size_; ++k) {
      x_[k] -= length * direction_[k];
      if (held(k)) free_[k] -= length * product_[k];
    }
    const double next = dot({free_.data(), size_}, {free_.data(), size_});
    for (std::size_t k = 0; k < size_; ++k) {
      direction_[k] = free_[k] + next / square * direction_[k];
    }
    square = next;
  }
  for (std::size_t i = 0; i < size_; ++i) {
    increment[i] = held(i) ? std::max(x_[i] / root_[i], -impulse[i]) : 0.0;
    impulse[i] += increment[i];
  }
}

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
