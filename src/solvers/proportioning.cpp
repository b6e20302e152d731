#include "solvers/proportioning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/array_reductions.h"
#include "common/wide_lanes.h"

namespace pounding::interactions {
namespace {

/// Length of projected steps times the bound of |A|; any length below 2 makes the objective fall.
constexpr double step_times_norm = 1.9;
/// Residuals in round-offs: where the steps end, and where the answer is believed.
constexpr double wanted_roundoffs = 1;
constexpr double believed_roundoffs = 8;
/// Below so many round-offs, steps end that make the residual no smaller in so many products: where
/// H is singular they go on along impulses that nothing feels, ever further.
constexpr double near_roundoffs = 1e3;
constexpr int most_in_vain = 100;
/// How often the gap rates are formed anew, and products with H between: where H is singular they
/// drift from their recurrence.
constexpr int most_rounds = 10;
constexpr int most_products = 400;
/// Products of a correction.
constexpr int most_corrections = 4000;
/// Part of the gap rates that a correction may leave.
constexpr double correction_accuracy = 1e-8;
/// Powers of two by which rates are scaled: those beyond have no reciprocal.
constexpr int most_exponent = 1000;

WideLanes lanes_at(const double* from) {
  WideLanes lanes;
  load(from, lanes);
  return lanes;
}

WideLanes lesser(const WideLanes& a, const WideLanes& b) {
  return b < a ? b : a;
}

/// Values at columns, one for each lane; the vector unit's own instruction takes longer.
WideLanes values_at(const double* values, const int* columns) {
  const auto at = [&](int lane) { return values[static_cast<unsigned>(columns[lane])]; };
#ifdef __AVX512F__
  return WideLanes{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
#else
  return WideLanes{at(0), at(1), at(2), at(3)};
#endif
}

/// The least of the lanes.
double least_of(const WideLanes& lanes) {
  double least = lanes[0];
  for (int lane = 1; lane < wide_lane_count; ++lane) least = std::min(least, lanes[lane]);
  return least;
}

/// How the objective falls along p: p . A p and p . gradient, and the length at which the first
/// impulse is zero.
struct Slope {
  std::array<double, 2> sums{};
  std::array<double, 1> most{};
};

/// Slope of the rows of a rank; arrays from its first row on.
Slope slope_along(std::span<const std::size_t> groups, const double* p, const double* product,
                  const double* gradient, const double* x) {
  const WideLanes zero = all_wide(0);
  WideLanes most = all_wide(infinity);
  WideLanes curvature = zero, fall = zero;
  for (const std::size_t i : groups) {
    const WideLanes along = lanes_at(p + i);
    curvature += along * lanes_at(product + i);
    fall += along * lanes_at(gradient + i);
    most = lesser(most, along > zero ? lanes_at(x + i) / along : most);
  }
  return {{add_up(curvature), add_up(fall)}, {least_of(most)}};
}

}  // namespace

ProportioningSolver::ProportioningSolver(SparseRows delassus, std::size_t first,
                                         std::size_t numbers, RowShare* share)
    : delassus_(std::move(delassus)), first_(first), share_(share) {
  const std::size_t rows = delassus_.rows();
  active_.reserve(rows);
  groups_.reserve(rows);
  for (auto* const room : {&root_, &acts_, &rate_, &gradient_, &free_, &product_, &best_}) {
    room->assign(rows + most_lanes, 0.0);
  }
  for (auto* const room : {&x_, &direction_, &values_}) {
    room->assign(std::max(numbers, first + rows) + most_lanes, 0.0);
  }
  scale();
}

void ProportioningSolver::scale() {
  for (std::size_t i = 0; i < delassus_.rows(); ++i) {
    values_[first_ + i] =
        std::sqrt(std::max(0.0, delassus_.entry(i, static_cast<int>(first_ + i))));
    root_[i] = values_[first_ + i];
  }
  bring(values_);
  std::array<double, 1> norm{-1};
  for (std::size_t group = 0; group < delassus_.rows(); group += wide_lane_count) {
    const std::size_t begin = value_.size();
    begin_.push_back(begin);
    for (std::size_t lane = 0; lane < wide_lane_count; ++lane) {
      const std::size_t i = group + lane;
      if (i == delassus_.rows()) break;
      const std::size_t end = begin + wide_lane_count * delassus_.columns(i).size();
      value_.resize(std::max(value_.size(), end), 0.0);
      column_.resize(value_.size(), static_cast<int>(first_));
      double sum = 0;
      for (std::size_t k = 0; k < delassus_.columns(i).size(); ++k) {
        const std::size_t column = delassus_.columns(i)[k];
        const std::size_t at = begin + wide_lane_count * k + lane;
        const double roots = root_[i] * values_[column];
        value_[at] = roots > 0 ? delassus_.values(i)[k] / roots : 0;
        column_[at] = static_cast<int>(column);
        sum += std::abs(value_[at]);
      }
      norm[0] = std::min(norm[0], -sum);
    }
  }
  begin_.push_back(value_.size());
  agree({}, norm);
  step_length_ = step_times_norm / -norm[0];
}

void ProportioningSolver::start(std::span<const double> free_rate, std::span<const double> impulse,
                                double factor, LcpResult& result) {
  for (auto* const room : {&acts_, &rate_, &gradient_, &product_}) std::ranges::fill(*room, 0.0);
  for (auto* const room : {&x_, &direction_, &values_}) std::ranges::fill(*room, 0.0);
  groups_.clear();
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const std::size_t i = active_[k];
    const std::size_t group = i - i % wide_lane_count;
    if (groups_.empty() || groups_.back() != group) groups_.push_back(group);
    if (!(root_[i] > 0)) {
      if (free_rate[k] < 0) ++result.infeasible_rows;
      continue;
    }
    acts_[i] = 1;
    rate_[i] = free_rate[k] * factor / root_[i];
    const double guess = impulse[k] * factor * root_[i];
    if (std::isfinite(guess) && guess > 0) x_[first_ + i] = guess;
  }
}

void ProportioningSolver::multiply(std::span<double> p) {
  bring(p);
  for (const std::size_t i : groups_) {
    const std::size_t end = begin_[i / wide_lane_count + 1];
    WideLanes sum = all_wide(0);
    for (std::size_t k = begin_[i / wide_lane_count]; k < end; k += wide_lane_count) {
      sum += lanes_at(&value_[k]) * values_at(p.data(), &column_[k]);
    }
    store(&product_[i], sum * lanes_at(&acts_[i]));
  }
}

void ProportioningSolver::form_gradient() {
  bring(x_);
  WideLanes largest = all_wide(0);
  for (const std::size_t i : groups_) {
    const std::size_t end = begin_[i / wide_lane_count + 1];
    const WideLanes rate = lanes_at(&rate_[i]);
    WideLanes sum = all_wide(0);
    WideLanes noise = lesser(rate, -rate);
    for (std::size_t k = begin_[i / wide_lane_count]; k < end; k += wide_lane_count) {
      const WideLanes term = lanes_at(&value_[k]) * values_at(x_.data(), &column_[k]);
      sum += term;
      noise += lesser(term, -term);
    }
    const WideLanes acts = lanes_at(&acts_[i]);
    store(&gradient_[i], sum * acts + rate);
    largest = lesser(largest, noise * lanes_at(&root_[i]) * acts);
  }
  roundoff_ = -epsilon * least_of(largest);
  split_gradient();
}

void ProportioningSolver::split_gradient() {
  const WideLanes zero = all_wide(0);
  const WideLanes length = all_wide(1 / step_length_);
  WideLanes violated = zero, reduced = zero, along = zero, residual = zero;
  const double* const x_here = x_.data() + first_;
  for (const std::size_t i : groups_) {
    const WideLanes x = lanes_at(x_here + i), g = lanes_at(&gradient_[i]);
    const WideLanes held = x > zero ? g : zero;
    const WideLanes open = x > zero ? zero : lesser(g, zero);
    store(&free_[i], held);
    violated += open * open;
    reduced += held * lesser(x * length, held);
    along += held * lanes_at(&product_[i]);
    const WideLanes left = lesser(x, g);
    residual = lesser(residual, lanes_at(&root_[i]) * lesser(left, -left));
  }
  std::array<double, 3> sums{add_up(violated), add_up(reduced), add_up(along)};
  std::array<double, 2> least{least_of(residual), -roundoff_};
  agree(sums, least);
  violated_square_ = sums[0];
  reduced_square_ = sums[1];
  free_product_ = sums[2];
  residual_ = -least[0];
  roundoff_ = -least[1];
}

void ProportioningSolver::restart_direction() {
  for (const std::size_t i : groups_) store(&direction_[first_ + i], lanes_at(&free_[i]));
}

void ProportioningSolver::move(const std::vector<double>& p, double length, double ends) {
  const WideLanes zero = all_wide(0);
  for (const std::size_t i : groups_) {
    const WideLanes x = lanes_at(&x_[first_ + i]), d = lanes_at(&p[first_ + i]);
    WideLanes moved = x - length * d;
    moved = moved > zero ? moved : zero;
    if (ends < infinity) moved = ((d > zero) & (x / d <= ends)) ? zero : moved;
    store(&x_[first_ + i], moved);
    store(&gradient_[i], lanes_at(&gradient_[i]) - length * lanes_at(&product_[i]));
  }
  split_gradient();
}

bool ProportioningSolver::conjugate_gradient_step(LcpResult& result) {
  multiply(direction_);
  ++result.iterations;
  auto [sums, first] =
      slope_along(groups_, &direction_[first_], product_.data(), gradient_.data(), &x_[first_]);
  agree(sums, first);
  const double best = sums[0] > 0 && sums[1] > 0 ? sums[1] / sums[0] : infinity;
  const double length = std::min(best, first[0]);
  if (!std::isfinite(length)) return false;
  move(direction_, length, best <= first[0] ? infinity : length);
  if (best <= first[0]) {
    const double part = free_product_ / sums[0];
    for (const std::size_t i : groups_) {
      double* const p = &direction_[first_ + i];
      store(p, lanes_at(&free_[i]) - part * lanes_at(p));
    }
    return true;
  }
  const WideLanes zero = all_wide(0);
  for (const std::size_t i : groups_) {
    const WideLanes x = lanes_at(&x_[first_ + i]) - step_length_ * lanes_at(&free_[i]);
    store(&x_[first_ + i], x > zero ? x : zero);
  }
  form_gradient();
  ++result.iterations;
  restart_direction();
  return true;
}

void ProportioningSolver::proportioning_step(LcpResult& result) {
  const WideLanes zero = all_wide(0);
  for (const std::size_t i : groups_) {
    const WideLanes open = lesser(lanes_at(&gradient_[i]), zero);
    store(&values_[first_ + i], lanes_at(&x_[first_ + i]) > zero ? zero : open);
  }
  multiply(values_);
  ++result.iterations;
  auto [sums, first] =
      slope_along(groups_, &values_[first_], product_.data(), gradient_.data(), &x_[first_]);
  agree(sums, {});
  // No curvature, no product: such rows open only with others.
  move(values_, sums[0] > 0 ? sums[1] / sums[0] : 0, infinity);
  restart_direction();
}

void ProportioningSolver::iterate(double wanted, LcpResult& result) {
  const int most = result.iterations + most_products;
  const double near = near_roundoffs * roundoff_;
  const auto x_here = x_.begin() + static_cast<std::ptrdiff_t>(first_);
  double least = near;
  int found = most;  // products when it was
  while (residual_ > wanted && result.iterations < most) {
    if (residual_ < least) {
      least = residual_;
      found = result.iterations;
      std::copy_n(x_here, delassus_.rows(), best_.begin());
    }
    if (result.iterations - found > most_in_vain) break;
    if (violated_square_ > reduced_square_) {
      proportioning_step(result);
    } else if (!conjugate_gradient_step(result)) {
      break;
    }
  }
  if (least < near && residual_ > least) std::copy_n(best_.begin(), delassus_.rows(), x_here);
}

LcpResult ProportioningSolver::solve(std::span<const std::size_t> active,
                                     std::span<const double> free_rate, std::span<double> impulse) {
  LcpResult result;
  active_.assign(active.begin(), active.end());
  const auto give_up = [&] {
    std::ranges::fill(impulse, 0.0);
    result.method = LcpMethod::not_finite;
    result.residual = infinity;
    return result;
  };
  const bool closes = std::ranges::any_of(free_rate, [](double b) { return b < 0; });
  std::array<double, 3> found{all_finite(free_rate) ? 1.0 : 0.0, closes ? -1.0 : 0.0,
                              -largest_magnitude(free_rate)};
  agree({}, found);
  if (found[0] == 0) return give_up();
  result.free_rate = -found[2];
  if (found[1] == 0) {
    std::ranges::fill(impulse, 0.0);
    return result;
  }
  const int exponent = std::clamp(std::ilogb(result.free_rate), -most_exponent, most_exponent);
  const double factor = std::scalbn(1.0, -exponent);
  start(free_rate, impulse, factor, result);
  result.method = LcpMethod::stalled;
  form_gradient();
  for (int round = 0; round < most_rounds && result.method == LcpMethod::stalled; ++round) {
    const double last = residual_;
    restart_direction();
    iterate(wanted_roundoffs * roundoff_, result);
    form_gradient();
    if (residual_ <= believed_roundoffs * roundoff_) result.method = LcpMethod::active_set;
    if (residual_ > last / 2 && last <= near_roundoffs * roundoff_) break;
  }
  result.roundoff = roundoff_ / (result.free_rate * factor);
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const std::size_t i = active_[k];
    impulse[k] = root_[i] > 0 ? x_[first_ + i] / root_[i] / factor : 0;
    values_[first_ + i] = impulse[k];
  }
  result.residual = residual(free_rate, result.free_rate);
  return std::isfinite(result.residual) ? result : give_up();
}

double ProportioningSolver::residual(std::span<const double> free_rate, double largest) {
  bring(values_);
  std::array<double, 1> worst{0};
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const std::size_t i = active_[k];
    const auto rate =
        static_cast<double>(free_rate[k] + row_product<long double>(delassus_, i, values_));
    const double closing = delassus_.entry(i, static_cast<int>(first_ + i)) * values_[first_ + i];
    const double left = std::abs(std::min(closing, rate));
    worst[0] =
        std::min(worst[0], std::isfinite(closing) && std::isfinite(rate) ? -left : -infinity);
  }
  agree({}, worst);
  return -worst[0] / largest;
}

void ProportioningSolver::correct(std::span<const double> gap_rate, std::span<double> impulse,
                                  std::span<double> increment) {
  const auto held = [&](std::size_t k) { return impulse[k] > 0 && root_[active_[k]] > 0; };
  const auto slope = [&](const double* p) {
    auto [sums, most] = slope_along(groups_, p, product_.data(), gradient_.data(), &x_[first_]);
    agree(sums, {});
    return sums;
  };
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const std::size_t i = active_[k];
    acts_[i] = held(k) ? 1 : 0;
    x_[first_ + i] = 0;
    gradient_[i] = held(k) ? gap_rate[k] / root_[i] : 0;
    direction_[first_ + i] = gradient_[i];
  }
  double square = slope(gradient_.data())[1];
  const double enough = correction_accuracy * correction_accuracy * square;
  for (int step = 0; step < most_corrections && square > enough; ++step) {
    multiply(direction_);
    const double curvature = slope(&direction_[first_])[0];
    if (!(curvature > 0)) break;
    const double length = square / curvature;
    for (const std::size_t i : active_) {
      x_[first_ + i] -= length * direction_[first_ + i];
      gradient_[i] -= length * product_[i];
    }
    const double next = slope(gradient_.data())[1];
    for (const std::size_t i : active_) {
      direction_[first_ + i] = gradient_[i] + next / square * direction_[first_ + i];
    }
    square = next;
  }
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const std::size_t i = active_[k];
    increment[k] = held(k) ? std::max(x_[first_ + i] / root_[i], -impulse[k]) : 0.0;
    impulse[k] += increment[k];
  }
}

}  // namespace pounding::interactions
