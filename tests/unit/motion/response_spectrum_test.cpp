#include "motion/response_spectrum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion/oscillator_step.h"
#include "motion_files.h"

namespace pounding {
namespace response_spectrum_test {

using std::numbers::pi;
using testing_support::refusal;

double pseudo_acceleration(const std::vector<double>& a, double step, double frequency, double xi) {
  const std::vector<double> frequencies{frequency};
  return response_spectrum(a, step, frequencies, xi)[0].pseudo_acceleration;
}

std::vector<double> noise(std::size_t size) {
  std::mt19937_64 generator(7);
  std::vector<double> values(size);
  for (double& value : values) value = static_cast<double>(generator() >> 11) * 0x1p-52 - 1;
  return values;
}

// The values of `coarse` and those of its linear interpolation at every `parts`-th of a step.
std::vector<double> refine(const std::vector<double>& coarse, int parts) {
  std::vector<double> fine;
  for (std::size_t i = 0; i + 1 < coarse.size(); ++i)
    for (int k = 0; k < parts; ++k)
      fine.push_back(coarse[i] + (coarse[i + 1] - coarse[i]) * k / parts);
  fine.push_back(coarse.back());
  return fine;
}

// Largest |u| of an oscillator, with every step looked at in 64 places: from below, and nearer than
// (theta / 64)^2 / 8 of it.
double looked_at_everywhere(const std::vector<double>& a, double theta, double xi) {
  constexpr int parts = 64;
  const OscillatorStep step = oscillator_step(theta / parts, xi);
  const std::vector<double> fine = refine(a, parts);
  double u = 0, v = 0, largest = 0;
  for (std::size_t n = 1; n < fine.size(); ++n) {
    const auto& [A, B] = step;
    const double u1 = A[0][0] * u + A[0][1] * v + B[0][0] * fine[n - 1] + B[0][1] * fine[n];
    v = A[1][0] * u + A[1][1] * v + B[1][0] * fine[n - 1] + B[1][1] * fine[n];
    u = u1;
    largest = std::max(largest, std::abs(u));
  }
  return largest * theta * theta / (parts * parts);  // u is in units of the fine step's square
}

TEST(ResponseSpectrum, MissesNoExtremumWhereverItLies) {
  // Records of one passage and of several, whose largest value is anywhere, also in the last step,
  // oscillators that go by one sample and by eight, and dampings of which some allow no passage to
  // be left out.
  for (const std::size_t size : {3, 9, 66, 256, 257, 700})
    for (const std::size_t shift : {0, 1, 5, 255, 256, 300, 571})
      for (const double theta : {0.003, 0.05, 0.1, 0.45, 0.97}) {
        std::vector<double> a = noise(size);
        std::rotate(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(shift % size), a.end());
        a[shift % size] *= 20;
        a[0] = 0;
        for (const double xi : {0.0, 0.02, 0.3, 0.95}) {
          const double h = 0.01, frequency = theta / (2 * pi * h);
          const std::vector<double> one{frequency};
          const double found =
              response_spectrum(a, h, one, xi, AfterRecord::ignored)[0].pseudo_acceleration;
          const double expected = looked_at_everywhere(a, theta, xi);
          EXPECT_GE(found, expected * (1 - 1e-9))
              << size << " " << shift << " " << theta << " " << xi;
          EXPECT_LE(found, expected * (1 + 1e-3))
              << size << " " << shift << " " << theta << " " << xi;
        }
      }
}

TEST(ResponseSpectrum, MissesNoPeakWherePassagesMeet) {
  // A blow whose largest response comes 31 samples later, in every place near sample 256.
  const double h = 0.01, theta = 0.05;
  const std::vector<double> one{theta / (2 * pi * h)};
  for (std::size_t blow = 215; blow < 240; ++blow) {
    std::vector<double> a(700, 0.0);
    a[blow] = 1;
    const double found =
        response_spectrum(a, h, one, 0.02, AfterRecord::ignored)[0].pseudo_acceleration;
    EXPECT_NEAR(found / looked_at_everywhere(a, theta, 0.02), 1, 1e-6) << blow;
  }
}

TEST(ResponseSpectrum, OscillatorsBesideAnotherDoNotCount) {
  // Quiet, a blow, quiet again: most passages hold no peak, and an oscillator goes by one sample or
  // by eight as those of its block do.
  std::vector<double> a = noise(5000);
  for (std::size_t n = 0; n < a.size(); ++n) a[n] *= n > 2000 && n < 2100 ? 30 : 0.3;
  std::vector<double> frequencies;
  for (int i = 0; i < 60; ++i) frequencies.push_back(0.05 * std::pow(1.12, i));
  const std::vector<double> ratios{0.3, 0, 0.02, 0.95};
  const auto together = response_spectra(a, 5e-3, frequencies, ratios);
  const auto cut = response_spectra(a, 5e-3, frequencies, ratios, AfterRecord::ignored);
  ASSERT_EQ(together.size(), ratios.size());
  for (std::size_t r = 0; r < ratios.size(); ++r)
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      EXPECT_EQ(together[r][i].frequency, frequencies[i]);
      EXPECT_NEAR(together[r][i].displacement /
                      response_spectrum(a, 5e-3, {&frequencies[i], 1}, ratios[r])[0].displacement,
                  1, 1e-13);
      const double theta = 2 * pi * frequencies[i] * 5e-3;
      if (theta < 1) {
        EXPECT_GE(cut[r][i].pseudo_acceleration,
                  looked_at_everywhere(a, theta, ratios[r]) * (1 - 1e-9))
            << frequencies[i] << " " << ratios[r];
      }
    }
}

TEST(ResponseSpectrum, StepOvershootsByTheDampedHalfCycle) {
  for (const double xi : {0.0, 0.02, 0.05, 0.1})
    for (const double f : {0.7, 5.0, 60.0}) {
      const std::vector<double> step(4000, 3.0);
      EXPECT_NEAR(pseudo_acceleration(step, 1e-3, f, xi) / 3,
                  1 + std::exp(-pi * xi / std::sqrt(1 - xi * xi)), 1e-11)
          << xi << " " << f;
    }
}

TEST(ResponseSpectrum, ShortPulseIsAnImpulse) {
  // Triangle of base 2 h and impulse J = 1: PSA = J omega exp(-xi acos(xi) / sqrt(1 - xi^2)).
  const double h = 1e-6;
  const std::vector<double> pulse{0, 1 / h, 0};
  for (const double xi : {0.0, 0.02, 0.05, 0.1})
    for (const double f : {1.0, 10.0, 50.0}) {
      const double expected = 2 * pi * f * std::exp(-xi * std::acos(xi) / std::sqrt(1 - xi * xi));
      EXPECT_NEAR(pseudo_acceleration(pulse, h, f, xi) / expected, 1, 1e-7) << xi << " " << f;
    }
}

TEST(ResponseSpectrum, UndampedRectangularPulse) {
  // A rectangle of duration d gives PSA / A = 2 sin(pi f d) while f d < 1/2; its last ramp is
  // short.
  std::vector<double> rectangle(1001, 1.0);
  rectangle.push_back(0);
  const double h = 1e-5, d = 1e-2;
  for (const double f : {5.0, 20.0, 45.0}) {
    // The mean of the rectangle and of the last ramp: a duration of d + h / 2 to second order.
    EXPECT_NEAR(pseudo_acceleration(rectangle, h, f, 0), 2 * std::sin(pi * f * (d + h / 2)), 1e-6);
  }
}

TEST(ResponseSpectrum, UndampedHalfSineAndItsOrderOfConvergence) {
  // A half sine of duration d, f d = 1/2: PSA / A = pi / 2 (resonance with its own frequency).
  const double d = 0.01;
  std::vector<double> errors;
  for (const int n : {40, 80, 160}) {
    std::vector<double> pulse;
    for (int i = 0; i <= n; ++i) pulse.push_back(std::sin(pi * i / n));
    errors.push_back(pi / 2 - pseudo_acceleration(pulse, d / n, 0.5 / d, 0));
  }
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.02);  // linear interpolation is second order
  EXPECT_NEAR(errors[1] / errors[2], 4, 0.01);
}

TEST(ResponseSpectrum, LimitsOfStiffAndSoftOscillators) {
  const auto a = noise(400);
  double peak = 0;
  for (const double value : a) peak = std::max(peak, std::abs(value));
  EXPECT_NEAR(pseudo_acceleration(a, 0.01, 1e6, 0.05) / peak, 1, 5e-5);

  // At rest after a whole cycle of +1, -1, the soft oscillator stays where the ground leaves it.
  const std::vector<double> cycle{1, 1, 1, -1, -1, -1};
  const std::vector<double> frequencies{0, 1e-6};
  const auto soft = response_spectrum(cycle, 0.1, frequencies, 0.05);
  double ground = 0, velocity = 0;
  for (std::size_t i = 0; i + 1 < cycle.size(); ++i) {
    ground += velocity * 0.1 + 0.01 * (cycle[i] / 3 + cycle[i + 1] / 6);
    velocity += 0.05 * (cycle[i] + cycle[i + 1]);
  }
  EXPECT_NEAR(velocity, 0, 1e-15);
  EXPECT_NEAR(soft[0].displacement, ground, 1e-15);
  EXPECT_EQ(soft[0].pseudo_acceleration, 0);
  EXPECT_NEAR(soft[1].displacement, ground, 1e-6);
}

TEST(ResponseSpectrum, AnyFrequencyTakesItsTime) {
  const std::vector<double> record{0.5, -1, 2, 0.25, 0};
  for (const double damping : {0.0, 0.05}) {
    const auto points =
        response_spectrum(record, 0.01, std::vector<double>{1.5e6, 1.7e6, 1e28}, damping);
    EXPECT_NEAR(points[0].pseudo_acceleration / points[1].pseudo_acceleration, 1, 1e-3) << damping;
    EXPECT_NEAR(points[2].pseudo_acceleration, damping == 0 ? 2.5 : 2, 1e-3);
  }
}

TEST(ResponseSpectrum, FreeVibrationAfterTheRecordCounts) {
  // A soft oscillator is left with the velocity V of the ground: SD = V / omega when undamped.
  const std::vector<double> push{0, 1, 1, 1, 0};
  const double v = 0.01 * 3;
  const std::vector<double> frequencies{0.01};
  const auto point = response_spectrum(push, 0.01, frequencies, 0)[0];
  EXPECT_NEAR(point.pseudo_velocity / v, 1, 1e-5);
  EXPECT_NEAR(point.displacement * 2 * pi * 0.01, point.pseudo_velocity, 1e-15);
}

TEST(ResponseSpectrum, CutsBetweenSamplesChangeNothing) {
  // The same piecewise-linear motion cut finer is the same motion, at any omega h: this holds only
  // if every extremum inside a step is found. The last frequencies turn several times in a step.
  const auto coarse = noise(300);
  const auto fine = refine(coarse, 64);
  for (const double xi : {0.0, 0.02, 0.05, 0.7})
    for (const double f : {0.01, 0.3, 2.0, 7.0, 15.9, 16.0, 33.0, 80.0, 150.0, 420.0})
      EXPECT_NEAR(
          pseudo_acceleration(fine, 0.01 / 64, f, xi) / pseudo_acceleration(coarse, 0.01, f, xi), 1,
          1e-11)
          << xi << " " << f;
}

TEST(ResponseSpectrum, CoefficientsComposeAtAnyStep) {
  // Four steps of h/4 under a linear load are one step of h (semi-group), from 1e-6 to 60 radians.
  for (const double theta :
       {1e-6, 1e-4, 0.019, 0.021, 0.3, 0.999, 1.001, 3.999, 4.001, 12.6, 60.0}) {
    const double xi = 0.05;
    const auto whole = oscillator_step(theta, xi), part = oscillator_step(theta / 4, xi);
    for (int unit = 0; unit < 4; ++unit) {
      double u = unit == 0, v = unit == 1 ? 0.25 : 0;  // v = (h/4) u'
      const double a0 = unit == 2, a1 = unit == 3;
      for (int k = 0; k < 4; ++k) {
        const double begin = (a0 + (a1 - a0) * k / 4) / 16,
                     end = (a0 + (a1 - a0) * (k + 1) / 4) / 16;
        const double next = part.state[0][0] * u + part.state[0][1] * v + part.load[0][0] * begin +
                            part.load[0][1] * end;
        v = part.state[1][0] * u + part.state[1][1] * v + part.load[1][0] * begin +
            part.load[1][1] * end;
        u = next;
      }
      const auto j = static_cast<std::size_t>(unit % 2);
      const auto& matrix = unit < 2 ? whole.state : whole.load;
      // Relative to each coefficient, down to those of order theta^2.
      EXPECT_NEAR(u / matrix[0][j], 1, 2e-13 * std::max(1.0, theta)) << theta << " " << unit;
      EXPECT_NEAR(4 * v / matrix[1][j], 1, 2e-13 * std::max(1.0, theta)) << theta << " " << unit;
    }
  }
}

TEST(ResponseSpectrum, CoefficientsAgreeWithTheClosedFormInExtendedPrecision) {
  using real = long double;
  if (std::numeric_limits<real>::digits < 64) GTEST_SKIP() << "no extended precision";
  const real xi = 0.05L, q = std::sqrt(1 - xi * xi);
  for (const double theta : {0.02, 0.1, 0.5, 0.99, 1.0, 2.0, 12.6}) {
    const real t = theta, e = std::exp(-xi * t), c = std::cos(q * t), s = std::sin(q * t) / q;
    const auto step = oscillator_step(theta, 0.05);
    const real a00 = e * (c + xi * s), a01 = e * s / t;
    // u_p(s) = -(s - 2 xi / theta) / theta^2 for the load that grows from 0 to 1.
    const real b01 = -(1 - 2 * xi / t) / (t * t) - a00 * (2 * xi / t) / (t * t) + a01 / (t * t);
    const real b_sum = (a00 - 1) / (t * t);  // constant load
    EXPECT_NEAR(static_cast<double>(step.state[0][0] / a00), 1, 4e-16 * std::max(1.0, theta));
    EXPECT_NEAR(static_cast<double>(step.load[0][1] / b01), 1, 2e-13) << theta;
    EXPECT_NEAR(static_cast<double>((step.load[0][0] + step.load[0][1]) / b_sum), 1, 2e-14)
        << theta;
  }
}

TEST(ResponseSpectrum, VerySmallStepsKeepTheirDigits) {
  // A step of acceleration seen at 1 Hz through steps of 1e-6 s, and at 0.5 through steps of 3e-7.
  const std::vector<double> step(700000, 1.0);
  const double expected = 1 + std::exp(-pi * 0.05 / std::sqrt(1 - 0.0025));
  EXPECT_NEAR(pseudo_acceleration(step, 1e-6, 1, 0.05), expected, 1e-9);
  EXPECT_NEAR(pseudo_acceleration(step, 3e-7, 3, 0.05), expected, 1e-9);
}

TEST(ResponseSpectrum, ScalesExactlyAndIgnoresTheSign) {
  auto a = noise(500);
  const double one = pseudo_acceleration(a, 0.01, 3, 0.05);
  for (double& value : a) value *= -1024;
  EXPECT_EQ(pseudo_acceleration(a, 0.01, 3, 0.05), 1024 * one);
}

TEST(ResponseSpectrum, SilenceGivesZero) {
  const std::vector<double> frequencies{0, 1, 100, 1e4};
  for (const auto& a :
       {std::vector<double>{}, std::vector<double>{5}, std::vector<double>(50, 0.0)})
    for (const auto& point : response_spectrum(a, 0.01, frequencies, 0.05))
      EXPECT_EQ(point.pseudo_acceleration, 0);
}

TEST(ResponseSpectrum, RefusesArgumentsOutOfRange) {
  const std::vector<double> a{0, 1, 0}, f{1}, bad_a{0, NAN}, bad_f{-1}, endless{INFINITY};
  EXPECT_THAT(refusal([&] { response_spectrum(a, 0, f, 0.05); }),
              ::testing::HasSubstr("time step"));
  EXPECT_THAT(refusal([&] { response_spectrum(a, NAN, f, 0.05); }),
              ::testing::HasSubstr("time step"));
  EXPECT_THAT(refusal([&] { response_spectrum(a, 0.1, f, 1); }), ::testing::HasSubstr("damping"));
  EXPECT_THAT(refusal([&] { response_spectrum(a, 0.1, f, -0.1); }),
              ::testing::HasSubstr("damping"));
  EXPECT_THAT(refusal([&] { response_spectrum(a, 0.1, f, NAN); }), ::testing::HasSubstr("damping"));
  EXPECT_THAT(refusal([&] { response_spectrum(a, 0.1, bad_f, 0.05); }),
              ::testing::HasSubstr("freq"));
  EXPECT_THAT(refusal([&] { response_spectrum(a, 0.1, endless, 0); }),
              ::testing::HasSubstr("freq"));
  EXPECT_THAT(refusal([&] { response_spectrum(bad_a, 0.1, f, 0); }), ::testing::HasSubstr("accel"));
}

}  // namespace response_spectrum_test
}  // namespace pounding
