#include "stability/stable_time_step.h"

#include <cmath>

#include <gtest/gtest.h>

namespace pounding {
namespace stable_time_step_test {

/// Spectral radius of z^2 - (2 - 2 xi W - W^2) z + (1 - 2 xi W), the modal recurrence, W = omega
/// dt.
double spectral_radius(double ratio, double angle) {
  const double b = 2 - 2 * ratio * angle - angle * angle;
  const double c = 1 - 2 * ratio * angle;
  const double discriminant = b * b - 4 * c;
  if (discriminant < 0) {
    return std::sqrt(c);
  }
  const double root = std::sqrt(discriminant);
  return std::max(std::abs(b + root), std::abs(b - root)) / 2;
}

TEST(StableTimeStep, IsTheExactLimitOfTheLaggedScheme) {
  for (const double ratio : {0.0, 0.006, 0.2, 1.0, 1.9149, 5.0}) {
    const double omega = 3.05e5;
    const Rayleigh damping{0, 2 * ratio / omega};
    const double limit = stable_time_step(damping, omega);
    EXPECT_LE(spectral_radius(ratio, omega * limit * 0.999), 1 + 1e-12) << ratio;
    EXPECT_GT(spectral_radius(ratio, omega * limit * 1.001), 1 + 1e-6) << ratio;
  }
}

TEST(StableTimeStep, DoesNotCancelAtHugeDamping) {
  // 2 / (beta omega^2), where the printed form of Eq. 12 gives 0.
  EXPECT_NEAR(stable_time_step({0, 1e6}, 3.05e5) / 2.14996e-17, 1, 1e-5);
  EXPECT_NEAR(stable_time_step({1e6, 0}, 3.05e5) / 1.84216e-06, 1, 1e-5);
}

TEST(StableTimeStep, OfAFreeMassIsSetByItsDampingAlone) {
  EXPECT_DOUBLE_EQ(stable_time_step({4, 0}, 0), 0.5);  // 2 / alpha
  EXPECT_TRUE(std::isinf(stable_time_step({0, 1}, 0)));
}

TEST(StableTimeStep, MarginVanishesAtTheLimit) {
  const Rayleigh damping{0.1562, 1.2557e-5};
  const double omega = 1.757e5;
  const double limit = stable_time_step(damping, omega);
  EXPECT_NEAR(energy_margin(damping, omega, limit), 0, 1e-12);
  EXPECT_GT(energy_margin(damping, omega, 0.9 * limit), 0.05);
}

TEST(StableTimeStep, RoundsDownToSixDigits) {
  EXPECT_DOUBLE_EQ(round_down(2.2867899e-6), 2.28678e-6);
  EXPECT_LE(round_down(1e-6), 1e-6);
  EXPECT_GT(round_down(1e-6), 0.99999e-6);
}

}  // namespace stable_time_step_test
}  // namespace pounding
