#include "motion/response_spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "common/error.h"

namespace pounding {

namespace {

constexpr int max_order = 28;
constexpr double series_limit = 1;  // theta below which power series replace the closed form

struct Oscillator {
  double theta;  // omega h
  double xi;
  int order;  // of the series: theta^order / order! is below round-off
};

Oscillator make_oscillator(double theta, double xi) {
  int order = 4;
  double term = theta * theta * theta / 6;
  while (order < max_order && term > 1e-18) {
    term *= theta / order;
    ++order;
  }
  return {theta, xi, order};
}

// u(s) = sum c_k s^k over one step, s in [0, 1], from the recurrence that the equation of motion
// gives; `velocity` is h u', `a0` and `a1` are h^2 times the acceleration at both ends.
struct StepSeries {
  std::array<double, max_order + 1> c{};
  int order = 0;

  StepSeries(const Oscillator& o, double displacement, double velocity, double a0, double a1)
      : order(o.order) {
    c[0] = displacement;
    c[1] = velocity;
    for (int k = 0; k + 2 <= order; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double load = k == 0 ? a0 : (k == 1 ? a1 - a0 : 0);
      c[i + 2] = -(2 * o.xi * o.theta * (k + 1) * c[i + 1] + o.theta * o.theta * c[i] + load) /
                 ((k + 1.0) * (k + 2.0));
    }
  }

  // Derivative `d` (0, 1, 2) of u with respect to s.
  double derivative(int d, double s) const {
    double sum = 0;
    for (int k = order; k >= d; --k) {
      const double factor = d == 0 ? 1 : (d == 1 ? k : k * (k - 1.0));
      sum = sum * s + factor * c[static_cast<std::size_t>(k)];
    }
    return sum;
  }
};

// The same in closed form, for theta >= series_limit:
// u(s) = alpha + beta s + exp(-xi theta s) (c cos + d sin)(q theta s), q = sqrt(1 - xi^2).
struct StepClosedForm {
  double theta, xi, q, alpha, beta, c, d;

  StepClosedForm(const Oscillator& o, double displacement, double velocity, double a0, double a1)
      : theta(o.theta), xi(o.xi), q(std::sqrt((1 - o.xi) * (1 + o.xi))) {
    const double slope = a1 - a0;
    alpha = -(a0 - 2 * xi * slope / theta) / (theta * theta);
    beta = -slope / (theta * theta);
    c = displacement - alpha;
    d = ((velocity - beta) / theta + xi * c) / q;
  }

  double derivative(int order, double s) const {
    double cosine = c, sine = d;
    for (int k = 0; k < order; ++k) {
      const double next = theta * (-xi * cosine + q * sine);
      sine = theta * (-xi * sine - q * cosine);
      cosine = next;
    }
    const double polynomial = order == 0 ? alpha + beta * s : (order == 1 ? beta : 0);
    const double angle = q * theta * s;
    return polynomial +
           std::exp(-xi * theta * s) * (cosine * std::cos(angle) + sine * std::sin(angle));
  }

  // First zero of u'' at s > 0; the next ones follow every pi / (q theta).
  double first_inflection() const {
    const double c1 = -xi * c + q * d, d1 = -xi * d - q * c;
    double angle = std::atan2(-xi * c1 + q * d1, xi * d1 + q * c1);
    if (angle <= 0) angle += std::numbers::pi;
    return angle / (q * theta);
  }

  // max |u| over [s, 1] is at most this.
  double bound(double s) const {
    return std::max(std::abs(alpha + beta * s), std::abs(alpha + beta)) +
           std::hypot(c, d) * std::exp(-xi * theta * s);
  }
};

// Zero of the derivative `d` of u between `low` and `high`, where it changes sign once: Newton's
// method kept inside the bracket by bisection.
template <class Step>
double find_zero(const Step& step, int d, double low, double high) {
  const bool rising = step.derivative(d, high) > 0;
  const double width = high - low;
  double s = 0.5 * (low + high);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double value = step.derivative(d, s);
    if (value == 0) break;
    ((value > 0) == rising ? high : low) = s;
    double next = s - value / step.derivative(d + 1, s);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double change = std::abs(next - s);
    s = next;
    if (change <= 1e-10 * width) break;
  }
  return s;
}

// max |u| where u' changes sign between two places with no inflection between them; else 0.
template <class Step>
double extremum_between(const Step& step, double low, double high) {
  if (!(step.derivative(1, low) * step.derivative(1, high) < 0)) return 0;
  return std::abs(step.derivative(0, find_zero(step, 1, low, high)));
}

// Below series_limit a step holds at most one inflection, and so at most two extrema.
double interior_peak(const StepSeries& step) {
  double inflection = 1;
  if (step.derivative(2, 0) * step.derivative(2, 1) < 0) inflection = find_zero(step, 2, 0, 1);
  const double first = extremum_between(step, 0, inflection);
  return inflection < 1 ? std::max(first, extremum_between(step, inflection, 1)) : first;
}

double interior_peak(const StepClosedForm& step, double peak) {
  const double spacing = std::numbers::pi / (step.q * step.theta);
  const double first = step.first_inflection();
  double low = 0;
  for (int k = 0; low < 1 && step.bound(low) > peak; ++k) {
    const double high = std::min(1.0, first + k * spacing);
    peak = std::max(peak, extremum_between(step, low, high));
    low = high;
  }
  return peak;
}

// max |u| of the free vibration from (u, h u') on: its first extremum, in closed form.
double free_vibration_peak(const Oscillator& o, double displacement, double velocity) {
  if (o.theta == 0) return std::abs(displacement);
  const double q = std::sqrt((1 - o.xi) * (1 + o.xi));
  const double y = velocity / o.theta, z = displacement * o.xi + y;
  double angle = std::atan2(y * q, displacement + o.xi * y);
  if (angle < 0) angle += std::numbers::pi;
  const double extremum =
      std::exp(-o.xi * angle / q) * (displacement * std::cos(angle) + z / q * std::sin(angle));
  return std::max(std::abs(displacement), std::abs(extremum));
}

double peak_displacement(std::span<const double> acceleration, double time_step,
                         const Oscillator& o, AfterRecord after) {
  const double h2 = time_step * time_step;
  const auto [A, B] = oscillator_step(o.theta, o.xi);
  const double k = o.theta * o.theta, damping = 2 * o.xi * o.theta;
  const bool use_series = o.theta < series_limit;
  double u = 0, v = 0, a = h2 * acceleration[0], w = -a, peak = 0;
  for (std::size_t n = 1; n < acceleration.size(); ++n) {
    const double a1 = h2 * acceleration[n];
    double u1 = A[0][0] * u + (A[0][1] * v + (B[0][0] * a + B[0][1] * a1));
    double v1 = A[1][0] * u + (A[1][1] * v + (B[1][0] * a + B[1][1] * a1));
    peak = std::max(peak, std::abs(u1));
    const double w1 = -(a1 + damping * v1 + k * u1);  // h^2 u''
    if (!use_series) {
      const StepClosedForm step(o, u, v, a, a1);
      if (step.bound(0) > peak) peak = interior_peak(step, peak);
    } else if (v * v1 <= 0 || (v * w < 0 && v1 * w1 > 0)) {
      // An extremum lies within half a step of an end, so it cannot exceed this.
      const double bound = std::max(std::abs(u), std::abs(u1)) + std::abs(v) + std::abs(v1) +
                           std::abs(w) + std::abs(w1);
      if (bound > peak) peak = std::max(peak, interior_peak(StepSeries(o, u, v, a, a1)));
      // Rest after a long silence: subnormal numbers would only cost time.
      if (bound < 1e-250) u1 = v1 = 0;
    }
    u = u1, v = v1, w = w1, a = a1;
  }
  if (after == AfterRecord::ignored) return peak;
  return std::max(peak, free_vibration_peak(o, u, v));
}

void check(bool ok, const char* what, double seen) {
  if (!ok)
    throw UserError("response spectrum: " + std::string(what) + ", not " + std::to_string(seen));
}

}  // namespace

OscillatorStep oscillator_step(double theta, double damping_ratio) {
  const Oscillator o = make_oscillator(theta, damping_ratio);
  OscillatorStep result;
  const auto column = [&](std::size_t j, auto& matrix, const auto& step) {
    matrix[0][j] = step.derivative(0, 1);
    matrix[1][j] = step.derivative(1, 1);
  };
  const auto all = [&]<class Step>(const Step*) {
    column(0, result.state, Step(o, 1, 0, 0, 0));
    column(1, result.state, Step(o, 0, 1, 0, 0));
    column(0, result.load, Step(o, 0, 0, 1, 0));
    column(1, result.load, Step(o, 0, 0, 0, 1));
  };
  if (theta < series_limit)
    all(static_cast<const StepSeries*>(nullptr));
  else
    all(static_cast<const StepClosedForm*>(nullptr));
  return result;
}

std::vector<SpectrumPoint> response_spectrum(std::span<const double> acceleration, double time_step,
                                             std::span<const double> frequencies,
                                             double damping_ratio, AfterRecord after) {
  check(std::isfinite(time_step) && time_step > 0, "time step must be positive", time_step);
  check(damping_ratio >= 0 && damping_ratio < 1, "damping ratio must be in [0, 1)", damping_ratio);
  for (const double f : frequencies)
    check(std::isfinite(f) && f >= 0, "frequencies must be finite and not negative", f);
  for (const double a : acceleration) check(std::isfinite(a), "accelerations must be finite", a);

  std::vector<SpectrumPoint> spectrum;
  spectrum.reserve(frequencies.size());
  for (const double frequency : frequencies) {
    const double omega = 2 * std::numbers::pi * frequency;
    double displacement = 0;
    if (!acceleration.empty())
      displacement = peak_displacement(acceleration, time_step,
                                       make_oscillator(omega * time_step, damping_ratio), after);
    spectrum.push_back(
        {frequency, displacement, omega * displacement, omega * omega * displacement});
  }
  return spectrum;
}

}  // namespace pounding
