#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "motion/oscillator_step.h"
#include "motion/response_spectrum.h"

namespace pounding {
namespace true_spectrum_test {

using std::numbers::pi;

std::vector<double> noise(std::size_t size) {
  std::mt19937_64 generator(11);
  std::vector<double> values(size);
  for (double& value : values) value = static_cast<double>(generator() >> 11) * 0x1p-52 - 1;
  return values;
}

TrueSpectrumPoint peaks(const std::vector<double>& a, double step, double frequency, double xi,
                        AfterRecord after = AfterRecord::free_vibration) {
  const std::vector<double> frequencies{frequency};
  return true_response_spectrum(a, step, frequencies, xi, after)[0];
}

/// The same peaks from samples alone, many of them per step of the record.
TrueSpectrumPoint sampled(const std::vector<double>& a, double step, double frequency, double xi) {
  const int parts = 400;
  const double h = step / parts, omega = 2 * pi * frequency;
  const auto [A, B] = oscillator_step(omega * h, xi);
  double u = 0, v = 0;
  TrueSpectrumPoint peak{frequency, 0, 0, std::abs(a[0])};
  for (std::size_t n = 0; n + 1 < a.size(); ++n)
    for (int k = 0; k < parts; ++k) {
      const double a0 = h * h * (a[n] + (a[n + 1] - a[n]) * k / parts);
      const double a1 = h * h * (a[n] + (a[n + 1] - a[n]) * (k + 1) / parts);
      const double next = A[0][0] * u + A[0][1] * v + B[0][0] * a0 + B[0][1] * a1;
      v = A[1][0] * u + A[1][1] * v + B[1][0] * a0 + B[1][1] * a1;
      u = next;
      const double absolute = omega * omega * u + 2 * xi * omega * v / h;
      peak.velocity = std::max(peak.velocity, std::abs(v) / h);
      peak.absolute_acceleration = std::max(peak.absolute_acceleration, std::abs(absolute));
      peak.relative_acceleration =
          std::max(peak.relative_acceleration, std::abs(absolute + a1 / (h * h)));
    }
  return peak;
}

TEST(TrueSpectrum, AgreesWithManySamplesPerStep) {
  const auto a = noise(120);
  for (const double xi : {0.0, 0.05, 0.6})
    for (const double f : {0.05, 0.7, 4.0, 15.0, 15.95, 40.0, 160.0}) {
      const TrueSpectrumPoint exact = peaks(a, 0.01, f, xi, AfterRecord::ignored);
      const TrueSpectrumPoint other = sampled(a, 0.01, f, xi);
      const double missed = std::pow(2 * pi * f * 0.01 / 400, 2) / 8 + 1e-5;
      const auto compare = [&](double found, double expected) {
        EXPECT_GE(found, expected * (1 - 1e-11)) << xi << " " << f;
        EXPECT_LE(found, expected * (1 + 2 * missed)) << xi << " " << f;
      };
      compare(exact.velocity, other.velocity);
      compare(exact.absolute_acceleration, other.absolute_acceleration);
      compare(exact.relative_acceleration, other.relative_acceleration);
    }
}

TEST(TrueSpectrum, StepOfAcceleration) {
  // From rest under a = A: |u'| is largest where omega_d t = acos(xi).
  const std::vector<double> step(4000, 2.0);
  for (const double xi : {0.0, 0.02, 0.1})
    for (const double f : {0.7, 30.0}) {
      const double omega = 2 * pi * f;
      const TrueSpectrumPoint found = peaks(step, 1e-3, f, xi, AfterRecord::ignored);
      const double q = std::sqrt(1 - xi * xi);
      EXPECT_NEAR(found.velocity * omega / 2, std::exp(-xi * std::acos(xi) / q), 1e-11);
      EXPECT_NEAR(found.relative_acceleration, 2, 1e-11);  // at the first instant
    }
}

TEST(TrueSpectrum, PseudoAndAbsoluteAccelerationAreOneWithoutDamping) {
  const auto a = noise(200);
  for (const double f : {0.3, 5.0, 33.0, 200.0}) {
    const std::vector<double> frequencies{f};
    EXPECT_NEAR(peaks(a, 0.01, f, 0).absolute_acceleration /
                    response_spectrum(a, 0.01, frequencies, 0)[0].pseudo_acceleration,
                1, 1e-10)
        << f;
  }
}

TEST(TrueSpectrum, FreeVibrationAfterAnImpulse) {
  // u' = J at once; u'' + a = -(2 xi omega u' + omega^2 u) begins with 2 xi omega J.
  const double h = 1e-7;
  const std::vector<double> pulse{0, 1 / h, 0};
  for (const double xi : {0.0, 0.05, 0.7}) {
    const TrueSpectrumPoint found = peaks(pulse, h, 10, xi);
    EXPECT_NEAR(found.velocity, 1, 2e-5);
    // The largest of exp(-xi t) (2 xi cos(q t) + (1 - 2 xi^2) / q sin(q t)), t = omega times time
    double largest = 0;
    const double q = std::sqrt(1 - xi * xi);
    for (double t = 0; t < 4; t += 1e-5)
      largest = std::max(
          largest, std::abs(std::exp(-xi * t) *
                            (2 * xi * std::cos(q * t) + (1 - 2 * xi * xi) / q * std::sin(q * t))));
    EXPECT_NEAR(found.absolute_acceleration / (20 * pi), largest, 3e-5) << xi;
  }
}

TEST(TrueSpectrum, LimitsOfStiffAndSoftOscillators) {
  auto a = noise(300);
  a.front() = a.back() = 0;
  double peak = 0;
  for (const double value : a) peak = std::max(peak, std::abs(value));
  EXPECT_NEAR(peaks(a, 0.01, 1e5, 0.05).absolute_acceleration / peak, 1, 1e-3);
  EXPECT_NEAR(peaks(a, 0.01, 1e-5, 0.05).relative_acceleration / peak, 1, 1e-5);
  EXPECT_LT(peaks(a, 0.01, 1e-5, 0.05).absolute_acceleration, 1e-4 * peak);
  EXPECT_EQ(peaks(a, 0.01, 0, 0.05).absolute_acceleration, 0);
}

}  // namespace true_spectrum_test
}  // namespace pounding
