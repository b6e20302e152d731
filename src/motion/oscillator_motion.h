#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

/// The motion of an oscillator within one step of its load, and where it is largest. Shared by the
/// response spectra; see motion/response_spectrum.h for the equation and its variables.
namespace pounding::oscillator {

inline constexpr int max_order = 28;
inline constexpr double series_limit = 1;  // theta below which power series replace the closed form

struct Oscillator {
  double theta;  // omega h
  double xi;
  int order;  // of the series: theta^order / order! is below round-off
};

inline Oscillator make_oscillator(double theta, double xi) {
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

  StepSeries() = default;

  StepSeries(const Oscillator& o, double displacement, double velocity, double a0, double a1)
      : order(o.order) {
    c[0] = displacement;
    c[1] = velocity;
    for (int k = 0; k + 2 <= order; ++k) {
      const std::size_t i = k;
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
      sum = sum * s + factor * c[k];
    }
    return sum;
  }
};

// Closed form of the coefficients, for theta >= series_limit:
// u(s) = alpha + beta s + exp(-xi theta s) (c cos + d sin)(q theta s), q = sqrt(1 - xi^2).
struct StepClosedForm {
  double theta = 0, xi = 0, q = 0, alpha = 0, beta = 0, c = 0, d = 0;

  StepClosedForm() = default;

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
           std::sqrt(c * c + d * d) * std::exp(-xi * theta * s);
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
inline double interior_peak(const StepSeries& step) {
  double inflection = 1;
  if (step.derivative(2, 0) * step.derivative(2, 1) < 0) inflection = find_zero(step, 2, 0, 1);
  const double first = extremum_between(step, 0, inflection);
  return inflection < 1 ? std::max(first, extremum_between(step, inflection, 1)) : first;
}

inline double interior_peak(const StepClosedForm& step, double peak) {
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
inline double free_vibration_peak(const Oscillator& o, double displacement, double velocity) {
  if (o.theta == 0) return std::abs(displacement);
  const double q = std::sqrt((1 - o.xi) * (1 + o.xi));
  const double y = velocity / o.theta, z = displacement * o.xi + y;
  double angle = std::atan2(y * q, displacement + o.xi * y);
  if (angle < 0) angle += std::numbers::pi;
  const double extremum =
      std::exp(-o.xi * angle / q) * (displacement * std::cos(angle) + z / q * std::sin(angle));
  return std::max(std::abs(displacement), std::abs(extremum));
}

// Motions differentiated with respect to s, and added with factors: velocity and
// acceleration have no more inflections in a step than the displacement has.
inline StepSeries derivative_of(const StepSeries& u) {
  StepSeries v;
  v.order = u.order - 1;
  for (int k = 0; k <= v.order; ++k) v.c[k] = (k + 1) * u.c[k + 1];
  return v;
}

inline StepSeries sum(double a, const StepSeries& u, double b, const StepSeries& v) {
  StepSeries w;
  w.order = std::min(u.order, v.order);
  for (std::size_t k = 0; k <= static_cast<std::size_t>(w.order); ++k) {
    w.c[k] = a * u.c[k] + b * v.c[k];
  }
  return w;
}

inline StepClosedForm derivative_of(const StepClosedForm& u) {
  StepClosedForm v = u;
  v.alpha = u.beta;
  v.beta = 0;
  v.c = u.theta * (-u.xi * u.c + u.q * u.d);
  v.d = u.theta * (-u.xi * u.d - u.q * u.c);
  return v;
}

inline StepClosedForm sum(double a, const StepClosedForm& u, double b, const StepClosedForm& v) {
  StepClosedForm w = u;
  w.alpha = a * u.alpha + b * v.alpha;
  w.beta = a * u.beta + b * v.beta;
  w.c = a * u.c + b * v.c;
  w.d = a * u.d + b * v.d;
  return w;
}

}  // namespace pounding::oscillator
