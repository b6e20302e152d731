#include "scene/uniform_damping.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "common/dense_matrix.h"

namespace pounding {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr int most_iterations = 60;

/// z on the ray of free motions whose damping ratio is sin(lag).
std::complex<double> on_ray(double omega, double lag) {
  return std::polar(omega, std::numbers::pi / 2 + lag);
}

std::complex<double> modulus(const std::vector<DampingFilter>& filters, std::complex<double> z) {
  std::complex<double> sum = 1;
  for (const DampingFilter& filter : filters) sum += filter.weight * z / (filter.rate + z);
  return sum;
}

/// The lag of free motions with |z| = omega: z^2 = -omega_0^2 s G(z) says that it is half the phase
/// of G, which changes slowly along the arc.
double lag_at(const std::vector<DampingFilter>& filters, double omega) {
  double lag = 0;
  for (int i = 0; i < most_iterations; ++i) {
    const double next = std::arg(modulus(filters, on_ray(omega, lag))) / 2;
    const bool done = std::abs(next - lag) <= 1e-16;
    lag = next;
    if (done) break;
  }
  return lag;
}

/// Fit of the filters, in the logarithms of weights and rates, on points of the band that are
/// equally spaced in the logarithm of the frequency.
class Fit {
 public:
  Fit(double ratio, double lowest, double highest, std::size_t count)
      : ratio_(ratio), count_(count), error_(points), slope_(points * 2 * count) {
    const double length = std::log(highest / lowest);
    // The power z^gamma, of constant phase, has gamma = 4/pi asin(xi), nearly.
    const double weight = 4 / std::numbers::pi * std::asin(ratio) * length;
    const double n = static_cast<double>(count);
    for (std::size_t k = 0; k < points; ++k) {
      omega_.push_back(two_pi * lowest * std::exp(length * static_cast<double>(k) / (points - 1)));
    }
    for (std::size_t i = 0; i < count; ++i) unknowns_.push_back(std::log(weight / n));
    for (std::size_t i = 0; i < count; ++i) {
      unknowns_.push_back(std::log(two_pi * lowest) + length * (static_cast<double>(i) + 0.5) / n);
    }
    evaluate();
  }

  /// Levenberg and Marquardt.
  void minimise_mean() {
    const std::size_t n = unknowns_.size();
    double trust = 1e-3;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      std::vector<double> matrix(n * n, 0.0);
      std::vector<double> change(n, 0.0);
      for (std::size_t k = 0; k < points; ++k) {
        const double* const row = &slope_[k * n];
        for (std::size_t i = 0; i < n; ++i) {
          change[i] -= row[i] * error_[k];
          for (std::size_t j = 0; j < n; ++j) matrix[i * n + j] += row[i] * row[j];
        }
      }
      for (std::size_t i = 0; i < n; ++i) matrix[i * n + i] *= 1 + trust;
      const double before = mean();
      const std::vector<double> start = unknowns_;
      if (!solve_dense(matrix, change)) return;
      move(change, 1);
      const double after = mean();
      if (after < before) {
        trust = std::max(trust / 5, 1e-9);
        if (before - after < 1e-8 * before) return;
      } else {
        trust *= 5;
        unknowns_ = start;
        evaluate();
      }
    }
  }

  /// Remez: errors of +-r, sign by sign, at the points of the alternation, by Newton's method with
  /// r as one more unknown.
  void equalise_ripple() {
    const std::size_t n = unknowns_.size();
    std::vector<double> best = unknowns_;
    double least = ripple();
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const std::vector<std::size_t> places = alternation();
      if (places.size() < n + 1) {
        break;  // round-off: the errors are that small
      }
      std::vector<double> matrix((n + 1) * (n + 1));
      std::vector<double> change(n + 1);
      for (std::size_t j = 0; j <= n; ++j) {
        std::copy_n(&slope_[places[j] * n], n, &matrix[j * (n + 1)]);
        matrix[j * (n + 1) + n] = error_[places[j]] > 0 ? -1 : 1;
        change[j] = -error_[places[j]];
      }
      if (!solve_dense(matrix, change)) break;
      move(change, 0.3);
      const double now = ripple();
      if (now < least) {
        best = unknowns_;
        least = now;
      }
      if (std::abs(std::abs(change[n]) - now) < 1e-9 * now) break;
    }
    unknowns_ = best;
    evaluate();
  }

  double ripple() const {
    return std::abs(*std::ranges::max_element(error_, {}, [](double e) { return std::abs(e); }));
  }

  std::vector<DampingFilter> filters() const {
    std::vector<DampingFilter> result;
    for (std::size_t i = 0; i < count_; ++i) {
      result.push_back({std::exp(unknowns_[i]), std::exp(unknowns_[count_ + i])});
    }
    return result;
  }

 private:
  static constexpr std::size_t points = 801;

  /// Relative errors of the damping ratio, shape (points), and their slopes, shape (points, 2 n).
  void evaluate() {
    const std::vector<DampingFilter> now = filters();
    const std::size_t unknowns = 2 * count_;
    for (std::size_t k = 0; k < points; ++k) {
      const double lag = lag_at(now, omega_[k]);
      const std::complex<double> z = on_ray(omega_[k], lag);
      const std::complex<double> g = modulus(now, z);
      error_[k] = std::sin(lag) / ratio_ - 1;
      // The phase of G by the filters' numbers, and by the lag itself.
      double by_lag = 0;
      for (std::size_t i = 0; i < count_; ++i) {
        const auto [weight, rate] = now[i];
        const std::complex<double> passed = weight * z / (rate + z);
        const std::complex<double> bent = passed * rate / (rate + z);
        slope_[k * unknowns + i] = (passed / g).imag();
        slope_[k * unknowns + count_ + i] = -(bent / g).imag();
        by_lag += (std::complex<double>(0, 1) * bent / g).imag();
      }
      const double scale = std::cos(lag) / ratio_ / (2 - by_lag);
      for (std::size_t i = 0; i < unknowns; ++i) slope_[k * unknowns + i] *= scale;
    }
  }

  void move(const std::vector<double>& change, double largest) {
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      unknowns_[i] += std::clamp(change[i], -largest, largest);
    }
    evaluate();
  }

  double mean() const {
    double sum = 0;
    for (const double e : error_) sum += e * e;
    return sum;
  }

  /// Points of the largest errors of alternating sign; fewer than 2 n + 1 if there are no more.
  std::vector<std::size_t> alternation() const {
    std::vector<std::size_t> found{0};
    for (std::size_t k = 1; k < points; ++k) {
      if ((error_[k] > 0) != (error_[found.back()] > 0)) {
        found.push_back(k);
      } else if (std::abs(error_[k]) > std::abs(error_[found.back()])) {
        found.back() = k;
      }
    }
    while (found.size() > 2 * count_ + 1) {
      const bool first = std::abs(error_[found.front()]) < std::abs(error_[found.back()]);
      found.erase(first ? found.begin() : found.end() - 1);
    }
    return found;
  }

  double ratio_;
  std::size_t count_;
  std::vector<double> omega_;
  std::vector<double> unknowns_;
  std::vector<double> error_;
  std::vector<double> slope_;
};

}  // namespace

double UniformDamping::at_rest() const {
  const double omega = two_pi * reference;
  return reference > 0 ? 1 / std::abs(modulus(filters, on_ray(omega, lag_at(filters, omega)))) : 1;
}

double UniformDamping::at_once() const {
  double sum = 1;
  for (const DampingFilter& filter : filters) sum += filter.weight;
  return at_rest() * sum;
}

double UniformDamping::ratio_at(double omega) const {
  return std::sin(lag_at(filters, omega));
}

double UniformDamping::moved(double frequency) const {
  const double rest = at_rest();
  double result = frequency;
  for (int i = 0; i < most_iterations; ++i) {  // |G| rises slowly
    const double omega = two_pi * result;
    result = frequency *
             std::sqrt(rest * std::abs(modulus(filters, on_ray(omega, lag_at(filters, omega)))));
  }
  return result;
}

UniformDamping fit_uniform_damping(double ratio, double lowest, double highest, int filters) {
  UniformDamping damping{ratio, lowest, highest, 0, {}, 0};
  if (ratio > 0) {
    Fit fit(ratio, lowest, highest, static_cast<std::size_t>(filters));
    fit.minimise_mean();
    fit.equalise_ripple();
    damping.filters = fit.filters();
    damping.ripple = fit.ripple();
  }
  return damping;
}

}  // namespace pounding
