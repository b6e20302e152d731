#include "scene/uniform_damping.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

namespace pounding {
namespace uniform_damping_test {

constexpr double two_pi = 2 * std::numbers::pi;

/// Relative errors of the damping ratio on many frequencies of the band.
std::vector<double> errors(const UniformDamping& damping, int points = 20001) {
  std::vector<double> result;
  for (int k = 0; k < points; ++k) {
    const double frequency = damping.lowest * std::pow(damping.highest / damping.lowest,
                                                       static_cast<double>(k) / (points - 1));
    result.push_back(damping.ratio_at(two_pi * frequency) / damping.ratio - 1);
  }
  return result;
}

double largest(const std::vector<double>& values) {
  return std::abs(*std::ranges::max_element(values, {}, [](double v) { return std::abs(v); }));
}

/// Number of the largest errors of alternating sign.
int alternations(const std::vector<double>& values, double ripple) {
  int count = 0;
  double last = 0;
  for (const double value : values) {
    if (std::abs(value) > 0.99 * ripple && value * last <= 0) {
      ++count;
      last = value;
    }
  }
  return count;
}

TEST(UniformDamping, HoldsItsRatioAsCloselyAsItSays) {
  for (const double ratio : {1e-3, 0.02, 0.04, 0.07, 0.2, 0.3}) {
    for (const double highest : {10.0, 100.0, 400.0, 1000.0}) {
      for (const int filters : {1, 2, 3, 4, 6}) {
        const UniformDamping damping = fit_uniform_damping(ratio, 1, highest, filters);
        const std::vector<double> found = errors(damping);
        EXPECT_NEAR(largest(found), damping.ripple, 1e-3 * damping.ripple + 1e-9);
        // 2 n + 1 equal extrema of alternating sign: no other 2 n numbers do better.
        if (damping.ripple > 1e-3) {
          EXPECT_EQ(alternations(found, damping.ripple), 2 * filters + 1)
              << ratio << " " << highest << " " << filters;
        }
      }
    }
  }
}

/// Rows of ripple and of what is left of the time step: no more than an independent fit in the mean
/// has, and alike.
TEST(UniformDamping, IsNoWorseThanAnotherFit) {
  struct Row {
    double ratio, highest;
    int filters;
    double ripple, step;
  };
  for (const Row& row : {Row{0.02, 400, 3, 0.13, 0.90}, Row{0.02, 400, 4, 0.037, 0.90},
                         Row{0.04, 100, 3, 0.053, 0.83}, Row{0.04, 400, 3, 0.13, 0.80},
                         Row{0.04, 400, 4, 0.037, 0.80}, Row{0.07, 400, 4, 0.037, 0.68}}) {
    const UniformDamping damping = fit_uniform_damping(row.ratio, 1, row.highest, row.filters);
    EXPECT_LT(damping.ripple, row.ripple);
    EXPECT_NEAR(1 / std::sqrt(damping.at_once()), row.step, 0.02);
  }
}

TEST(UniformDamping, NeedsNoMoreThanRoundOffInANarrowBand) {
  for (const double highest : {1.01, 1.2, 1.5, 2.0, 4.0}) {
    for (const int filters : {2, 3, 5, 8}) {
      const UniformDamping damping = fit_uniform_damping(0.05, 1, highest, filters);
      EXPECT_LT(largest(errors(damping, 101)), 5e-3) << highest << " " << filters;
      for (const DampingFilter& filter : damping.filters) {
        EXPECT_GT(filter.weight, 0);
        EXPECT_GT(filter.rate, 0);
      }
    }
  }
}

/// z^2 = -omega_0^2 s G(z) at the frequency and the ratio that are stated.
TEST(UniformDamping, KnowsHowModesSwingFreely) {
  for (const double ratio : {0.01, 0.1, 0.3}) {
    UniformDamping damping = fit_uniform_damping(ratio, 1, 400, 3);
    damping.reference = 3;
    for (const double frequency : {0.01, 0.5, 3.0, 40.0, 1e4}) {
      const double omega = two_pi * damping.moved(frequency);
      const double lost = damping.ratio_at(omega);
      const std::complex<double> z(-omega * lost, omega * std::sqrt(1 - lost * lost));
      std::complex<double> g = 1;
      for (const auto& [weight, rate] : damping.filters) g += weight * z / (rate + z);
      const double omega_0 = two_pi * frequency;
      EXPECT_LT(std::abs(z * z + omega_0 * omega_0 * damping.at_rest() * g), 1e-12 * omega * omega);
    }
  }
}

TEST(UniformDamping, KeepsTheStiffnessAtItsReference) {
  UniformDamping damping = fit_uniform_damping(0.04, 1, 400, 3);
  EXPECT_EQ(damping.at_rest(), 1);  // the bound before the reference is known
  const double bound = damping.at_once();
  damping.reference = 2.5;
  EXPECT_NEAR(damping.moved(2.5), 2.5, 1e-14);
  EXPECT_LT(damping.at_rest(), 1);
  EXPECT_LT(damping.at_once(), bound);
  EXPECT_NEAR(damping.moved(1e-7) / 1e-7, std::sqrt(damping.at_rest()), 1e-6);
  EXPECT_NEAR(damping.moved(1e9) / 1e9, std::sqrt(damping.at_once()), 1e-6);
  EXPECT_LT(damping.moved(1), 1);
  EXPECT_GT(damping.moved(100), 100);
}

TEST(UniformDamping, OfNoneHasNoFilters) {
  const UniformDamping damping = fit_uniform_damping(0, 1, 400, 3);
  EXPECT_TRUE(damping.filters.empty());
  EXPECT_EQ(damping.at_once(), 1);
  EXPECT_EQ(damping.ratio_at(30), 0);
}

}  // namespace uniform_damping_test
}  // namespace pounding
