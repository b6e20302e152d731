#include "motion/oscillator_peaks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/batch_value.h"
#include "common/memory.h"
#include "motion/oscillator_step.h"

namespace pounding {
namespace {

using namespace oscillator;

enum class Quantity { displacement, velocity, absolute_acceleration, relative_acceleration };

/// Displacement u, h u' and h^2 times the ground's acceleration at a sample; h the time step.
struct Sample {
  double u = 0, v = 0, a = 0;
};

/// A quantity at a sample with its derivatives with respect to s, the part of the step.
struct Local {
  double value, slope, curvature;
};

double stiffness_of(const Oscillator& o) {
  return o.theta * o.theta;
}
double damping_of(const Oscillator& o) {
  return 2 * o.xi * o.theta;
}

/// The quantity at an end of a step over which h^2 a changes by `change`.
template <Quantity quantity>
Local local_at(const Oscillator& o, const Sample& at, double change) {
  const double d = damping_of(o), k = stiffness_of(o);
  const double w = -(at.a + d * at.v + k * at.u);  // h^2 u''
  if (quantity == Quantity::displacement) return {at.u, at.v, w};
  const double third = -(d * w + k * at.v + change);
  if (quantity == Quantity::velocity) return {at.v, w, third};
  const double fourth = -(d * third + k * w);
  if (quantity == Quantity::relative_acceleration) return {w, third, fourth};
  return {d * at.v + k * at.u, d * w + k * at.v, -fourth};  // -h^2 (u'' + a)
}

/// A quantity within a step, from the displacement there.
template <Quantity quantity, class Step>
Step motion_of(const Oscillator& o, const Step& displacement) {
  if (quantity == Quantity::displacement) return displacement;
  const Step velocity = derivative_of(displacement);
  if (quantity == Quantity::velocity) return velocity;
  if (quantity == Quantity::relative_acceleration) return derivative_of(velocity);
  return sum(stiffness_of(o), displacement, damping_of(o), velocity);
}

/// Below series_limit the second derivatives of all quantities within a step are free vibrations
/// that turn by less than a radian, and so at most 1.2 times as large as at its ends. An extremum
/// lies within half a step of one end: beyond both by at most an eighth of that.
constexpr double beyond_ends = 1.2 / 8;

/// Raises the peak of a quantity by its values behind one sample up to the next one.
template <Quantity quantity>
void raise_peak(double& peak, const Oscillator& o, const Sample& from, const Sample& to) {
  const Local start = local_at<quantity>(o, from, to.a - from.a);
  const Local end = local_at<quantity>(o, to, to.a - from.a);
  peak = std::max(peak, std::abs(end.value));
  if (o.theta >= series_limit) {
    const auto motion = motion_of<quantity>(o, StepClosedForm(o, from.u, from.v, from.a, to.a));
    if (motion.bound(0) > peak) peak = interior_peak(motion, peak);
    return;
  }
  const bool turns = start.slope * end.slope <= 0;
  const bool turns_twice = start.slope * start.curvature < 0 && end.slope * end.curvature > 0;
  const double bound = std::max(std::abs(start.value), std::abs(end.value)) +
                       beyond_ends * std::max(std::abs(start.curvature), std::abs(end.curvature));
  if (bound <= peak || !(turns || turns_twice)) return;
  const auto motion = motion_of<quantity>(o, StepSeries(o, from.u, from.v, from.a, to.a));
  peak = std::max(peak, interior_peak(motion));
}

/// Below it an oscillator is at rest: subnormal numbers would only cost time.
constexpr double rest = 1e-250;

/// Steps of one oscillator.
class Stepper {
 public:
  explicit Stepper(const Oscillator& o) : step_(oscillator_step(o.theta, o.xi)) {}

  /// The sample behind one, `a` there.
  Sample after(const Sample& at, double a) const {
    const auto& [A, B] = step_;
    const Sample next{A[0][0] * at.u + (A[0][1] * at.v + (B[0][0] * at.a + B[0][1] * a)),
                      A[1][0] * at.u + (A[1][1] * at.v + (B[1][0] * at.a + B[1][1] * a)), a};
    const bool still = std::abs(next.u) + std::abs(next.v) + std::abs(a) < rest;
    return still ? Sample{0, 0, a} : next;
  }

 private:
  OscillatorStep step_;
};

/// Peaks of some quantities of an oscillator under samples of h^2 a, looked at in every step.
template <Quantity... quantities>
std::array<double, sizeof...(quantities)> peaks_of(std::span<const double> load,
                                                   const Oscillator& o, AfterRecord after) {
  const Stepper stepper(o);
  Sample at{0, 0, load[0]};
  std::array peaks{std::abs(local_at<quantities>(o, at, 0).value)...};
  const auto each = [&](const auto& raise) {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (raise.template operator()<quantities>(peaks[i]), ...);
    }
    (std::make_index_sequence<sizeof...(quantities)>());
  };
  for (std::size_t n = 1; n < load.size(); ++n) {
    const Sample next = stepper.after(at, load[n]);
    each([&]<Quantity quantity>(double& peak) { raise_peak<quantity>(peak, o, at, next); });
    at = next;
  }
  if (after == AfterRecord::ignored) return peaks;
  at.a = 0;
  each([&]<Quantity quantity>(double& peak) {
    const Local end = local_at<quantity>(o, at, 0);
    peak = std::max(peak, free_vibration_peak(o, end.value, end.slope));
  });
  return peaks;
}

/// Angle per step beyond which an oscillator follows the load and its own swing, which the first
/// sample sets off, but for 4 / theta of it: nobody waits for the look at every turn.
constexpr double follows_load = 1e5;

/// Largest |u| of an oscillator that turns that fast.
double followed_load(std::span<const double> load, const Oscillator& o) {
  const double decay = o.xi / std::sqrt((1 - o.xi) * (1 + o.xi));
  const double fading = std::exp(-o.xi * o.theta);
  double swing = std::abs(load[0]) * std::exp(-std::numbers::pi * decay), largest = 0;
  for (const double sample : load) {
    largest = std::max(largest, std::abs(sample) + swing);
    swing *= fading;
  }
  return (1 + 4 / o.theta) * largest / stiffness_of(o);
}

/// Oscillators side by side: their chains of sums hide each other's latency.
constexpr std::size_t vectors = 3;
constexpr std::size_t together = vectors * batch_size;
using Vector = BatchValue[vectors];

/// A step of oscillators side by side over `stride` samples at once, which the state before and the
/// samples of h^2 a from the first to the last determine.
template <std::size_t stride>
class Stride {
 public:
  explicit Stride(std::span<const Oscillator> oscillators) {
    for (std::size_t i = 0; i < together; ++i) {
      const Oscillator& o = oscillators[std::min(i, oscillators.size() - 1)];  // the last fills up
      const auto [A, B] = oscillator_step(o.theta, o.xi);
      std::array<std::array<double, 2>, stride + 3> columns{{{1, 0}, {0, 1}}};
      for (std::size_t n = 0; n < stride; ++n) {
        for (auto& [u, v] : columns) {
          const double u1 = A[0][0] * u + A[0][1] * v;
          v = A[1][0] * u + A[1][1] * v;
          u = u1;
        }
        for (std::size_t r = 0; r < 2; ++r) {
          columns[n + 2][r] += B[r][0];
          columns[n + 3][r] += B[r][1];
        }
      }
      for (std::size_t c = 0; c < columns.size(); ++c) {
        for (std::size_t r = 0; r < 2; ++r) {
          effect_[c][r][i / batch_size][i % batch_size] = columns[c][r];
        }
      }
    }
  }

  void go(const double* load, Vector& u, Vector& v) const {
    for (std::size_t b = 0; b < vectors; ++b) {
      auto u1 = effect_[2][0][b] * all_eight(load[0]), v1 = effect_[2][1][b] * all_eight(load[0]);
      for (std::size_t n = 1; n <= stride; ++n) {
        add_product(effect_[n + 2][0][b], all_eight(load[n]), u1);
        add_product(effect_[n + 2][1][b], all_eight(load[n]), v1);
      }
      add_product(effect_[1][0][b], v[b], u1);
      add_product(effect_[1][1][b], v[b], v1);
      add_product(effect_[0][0][b], u[b], u1);
      add_product(effect_[0][1][b], u[b], v1);
      u[b] = u1;
      v[b] = v1;
    }
  }

 private:
  Vector effect_[stride + 3][2];  ///< of u, v and the samples on u and v
};

/// Largest |u| between samples that are `stride` apart: with U the largest |u| there, V the largest
/// |h u'| and a the largest |h^2 a| of all samples it is of_displacement U + of_velocity V +
/// of_load a. In units of the stride, an extremum lies within half of one of a sample, so
/// |u| <= U + W / 8, W the largest |u''|; and |u'| <= 2 U + W, as it is |u1 - u0| somewhere
/// between; the equation of motion bounds W by a + d (2 U + W) + k (U + W / 8). From series_limit
/// on it is the particular solution and the amplitude of the free vibration, see StepClosedForm.
struct BetweenSamples {
  BetweenSamples(const Oscillator& o, std::size_t stride) {
    if (o.theta >= series_limit) {
      const double q = std::sqrt((1 - o.xi) * (1 + o.xi));
      const double beta = 2 / stiffness_of(o), alpha = (1 + 4 * o.xi / o.theta) / stiffness_of(o);
      of_displacement = 1 + o.xi / q;
      of_velocity = 1 / (o.theta * q);
      of_load = 1.001 * (alpha * (1 + of_displacement) + beta * of_velocity);
      return;
    }
    const double steps = static_cast<double>(stride);
    const double d = damping_of(o) * steps, k = stiffness_of(o) * steps * steps;
    left = 1 - d - k / 8;
    of_load = left > 0.1 ? 1.001 * steps * steps / (8 * left) : 1e100;  // else nothing is known
    of_displacement = 1 + of_load * (2 * d + k) / (steps * steps);
  }
  double left = 0, of_load, of_displacement, of_velocity = 0;
};

/// Peaks of oscillators side by side.
class Block {
 public:
  /// `some`: one to `together` of them; they must outlive this object.
  explicit Block(std::span<const Oscillator> some)
      : oscillators_(some), single_(some), coarse_(some) {
    const bool coarsely = std::ranges::all_of(
        some, [](const Oscillator& o) { return BetweenSamples(o, coarse_stride).left > 0.8; });
    if (coarsely) stride_ = coarse_stride;
    is_fast_ =
        std::ranges::any_of(some, [](const Oscillator& o) { return o.theta >= series_limit; });
  }

  /// Largest |u| of each under samples of h^2 a.
  std::vector<double> peaks(std::span<const double> load, AfterRecord after);

 private:
  /// Some steps that follow each other, from sample `first` to `last`.
  struct Passage {
    std::size_t first, last;
    double load;     ///< largest |h^2 a|
    Vector u, v;     ///< at the first sample
    Vector largest;  ///< |u| at the samples that were looked at
    Vector fastest;  ///< |h u'| there, of oscillators that need it
  };
  static constexpr std::size_t coarse_stride = 8, passage_size = 256;

  /// Goes from (u, v) at the first sample of a passage to those at its last.
  void pass(std::span<const double> load, Passage& passage, Vector& u, Vector& v) const;
  /// Raises the peak of an oscillator by the extrema between those samples.
  void look_between(std::span<const double> load, std::size_t i, double& peak) const;

  std::span<const Oscillator> oscillators_;
  Stride<1> single_;
  Stride<coarse_stride> coarse_;
  std::size_t stride_ = 1;
  bool is_fast_ = false;
  std::vector<Passage, LargePageAllocator<Passage>> passages_;
};

void Block::pass(std::span<const double> load, Passage& passage, Vector& u, Vector& v) const {
  Vector largest;
  Vector fastest;
  for (std::size_t b = 0; b < vectors; ++b) {
    largest[b] = magnitude(u[b]);
    fastest[b] = magnitude(v[b]);
  }
  const auto go = [&](const auto& stride, std::size_t n) {
    stride.go(&load[n], u, v);
    for (std::size_t b = 0; b < vectors; ++b) largest[b] = larger(largest[b], magnitude(u[b]));
    for (std::size_t b = 0; is_fast_ && b < vectors; ++b) {
      fastest[b] = larger(fastest[b], magnitude(v[b]));
    }
  };
  std::size_t n = passage.first;
  if (stride_ > 1) {
    for (; n + coarse_stride <= passage.last; n += coarse_stride) go(coarse_, n);
  }
  for (; n < passage.last; ++n) go(single_, n);
  passage.load = 0;
  for (n = passage.first; n <= passage.last; ++n) {
    passage.load = std::max(passage.load, std::abs(load[n]));
  }
  for (std::size_t b = 0; b < vectors; ++b) {
    passage.largest[b] = largest[b];
    passage.fastest[b] = fastest[b];
    const BatchMask still =
        magnitude(u[b]) + magnitude(v[b]) + all_eight(passage.load) < all_eight(rest);
    u[b] = choose(still, BatchValue{}, u[b]);
    v[b] = choose(still, BatchValue{}, v[b]);
  }
}

void Block::look_between(std::span<const double> load, std::size_t i, double& peak) const {
  const Oscillator& o = oscillators_[i];
  const Stepper stepper(o);
  const BetweenSamples bound(o, stride_);
  const std::size_t b = i / batch_size, l = i % batch_size;
  for (const Passage& passage : passages_) {
    if (bound.of_displacement * passage.largest[b][l] + bound.of_velocity * passage.fastest[b][l] +
            bound.of_load * passage.load <=
        peak) {
      continue;
    }
    Sample at{passage.u[b][l], passage.v[b][l], load[passage.first]};
    for (std::size_t n = passage.first + 1; n <= passage.last; ++n) {
      const Sample next = stepper.after(at, load[n]);
      raise_peak<Quantity::displacement>(peak, o, at, next);
      at = next;
    }
  }
}

std::vector<double> Block::peaks(std::span<const double> load, AfterRecord after) {
  Vector u{}, v{}, largest{};
  passages_.reserve(load.size() / passage_size + 1);
  for (std::size_t first = 0; first + 1 < load.size(); first += passage_size) {
    Passage& passage = passages_.emplace_back();
    passage.first = first;
    passage.last = std::min(first + passage_size, load.size() - 1);
    std::ranges::copy(u, passage.u);
    std::ranges::copy(v, passage.v);
    pass(load, passage, u, v);
    for (std::size_t b = 0; b < vectors; ++b) largest[b] = larger(largest[b], passage.largest[b]);
  }
  std::vector<double> peaks;
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    const std::size_t b = i / batch_size, l = i % batch_size;
    double peak = largest[b][l];
    look_between(load, i, peak);
    if (after == AfterRecord::free_vibration) {
      peak = std::max(peak, free_vibration_peak(oscillators_[i], u[b][l], v[b][l]));
    }
    peaks.push_back(peak);
  }
  return peaks;
}

std::vector<double> loads_of(std::span<const double> acceleration, double time_step) {
  std::vector<double> load(acceleration.begin(), acceleration.end());
  for (double& value : load) value *= time_step * time_step;
  return load;
}

}  // namespace

std::vector<double> peak_displacements(std::span<const double> acceleration, double time_step,
                                       std::span<const Oscillator> oscillators, AfterRecord after) {
  const std::vector<double> load = loads_of(acceleration, time_step);
  const auto swings = [](const Oscillator& o) { return o.theta <= follows_load; };
  std::vector<double> peaks;
  while (peaks.size() < oscillators.size()) {
    const auto left = oscillators.subspan(peaks.size());
    const auto end = std::ranges::find_if_not(left.first(std::min(left.size(), together)), swings);
    const auto count = static_cast<std::size_t>(end - left.begin());
    if (count > 0) {
      std::ranges::copy(Block(left.first(count)).peaks(load, after), std::back_inserter(peaks));
    } else {
      peaks.push_back(followed_load(load, left[0]));
    }
  }
  return peaks;
}

std::array<double, 3> true_peaks(std::span<const double> acceleration, double time_step,
                                 const Oscillator& oscillator, AfterRecord after) {
  return peaks_of<Quantity::velocity, Quantity::absolute_acceleration,
                  Quantity::relative_acceleration>(loads_of(acceleration, time_step), oscillator,
                                                   after);
}

}  // namespace pounding
