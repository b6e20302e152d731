#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "motion/support_motion.h"

namespace pounding {
namespace kinematic_interaction_test {

constexpr double pi = std::numbers::pi;
constexpr Embedment basement{8, 320, 12};  // 25 ms of travel

Accelerogram sine(double frequency, std::size_t count) {
  Accelerogram signal{{}, 0.002};
  for (std::size_t n = 0; n < count; ++n) {
    signal.acceleration.push_back(
        std::sin(2 * pi * frequency * signal.time_step * static_cast<double>(n)));
  }
  return signal;
}

/// Of a long sine both motions are sines in phase with it, of the sizes of the formulas.
TEST(KinematicInteraction, OfASineIsASine) {
  for (const double frequency : {0.5, 3.0, 6.5, 9.0, 20.0}) {
    const Accelerogram surface = sine(frequency, 20001);
    const Accelerogram along = embedded_translation(surface, basement);
    const Accelerogram about = embedded_rotation(surface, basement);
    const double a0 = 2 * pi * frequency * 8 / 320;
    const double translation = a0 < 1.1 ? std::cos(a0) : std::cos(1.1);
    const double rotation = 0.26 / 12 * (a0 < pi / 2 ? 1 - std::cos(a0) : 1);
    for (std::size_t n = 5000; n < 15000; ++n) {
      ASSERT_NEAR(along.acceleration[n], translation * surface.acceleration[n], 1e-4) << frequency;
      ASSERT_NEAR(about.acceleration[n], rotation * surface.acceleration[n], 1e-5) << frequency;
    }
  }
}

/// Below a0 = 1.1 the motion at depth is that of two waves, one on its way up and one reflected.
TEST(KinematicInteraction, OfASlowPulseIsTheMeanOfTheWavesUpAndDown) {
  Accelerogram surface{{}, 0.0025};  // ten samples are the time of travel
  for (int n = 0; n < 2000; ++n) {
    surface.acceleration.push_back(std::exp(-std::pow((n - 800) * 0.0025 / 0.3, 2)));
  }
  const Accelerogram along = embedded_translation(surface, basement);
  for (std::size_t n = 20; n < 1900; ++n) {
    const double mean = (surface.acceleration[n - 10] + surface.acceleration[n + 10]) / 2;
    ASSERT_NEAR(along.acceleration[n], mean, 1e-9);
  }
}

/// A motion that is at rest at its end leaves the underside where it leaves the surface, however
/// sudden its beginning.
TEST(KinematicInteraction, ComesToRestWhereTheSurfaceDoes) {
  Accelerogram surface{{}, 0.005};
  for (int n = 0; n <= 400; ++n) surface.acceleration.push_back(std::cos(pi * n / 200));
  const auto ends = [](const Accelerogram& motion) {
    double velocity = 0, displacement = 0;
    const std::vector<double>& a = motion.acceleration;
    for (std::size_t n = 0; n + 1 < a.size(); ++n) {
      displacement += motion.time_step * (velocity + motion.time_step * (2 * a[n] + a[n + 1]) / 6);
      velocity += motion.time_step * (a[n] + a[n + 1]) / 2;
    }
    return std::array{velocity, displacement};
  };
  Accelerogram longer = surface;
  longer.acceleration.resize(embedded_translation(surface, basement).acceleration.size(), 0.0);
  const auto [velocity, displacement] = ends(embedded_translation(surface, basement));
  EXPECT_NEAR(velocity, ends(longer)[0], 1e-4);
  EXPECT_NEAR(displacement, ends(longer)[1], 2e-4);
  EXPECT_NEAR(ends(embedded_rotation(surface, basement))[1], 0, 1e-5);
}

TEST(KinematicInteraction, NearTheSurfaceItIsTheMotionOfTheSurface) {
  const Accelerogram surface = sine(4, 501);
  const Accelerogram along = embedded_translation(surface, {1e-9, 320, 12});
  for (std::size_t n = 0; n < 501; ++n) {
    EXPECT_NEAR(along.acceleration[n], surface.acceleration[n], 1e-12);
  }
  EXPECT_NEAR(embedded_rotation(surface, {1e-9, 320, 12}).peak(), 0, 1e-12);
}

}  // namespace kinematic_interaction_test
}  // namespace pounding
