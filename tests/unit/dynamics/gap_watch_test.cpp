#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "dynamics/unilateral_contact.h"

namespace pounding {
namespace gap_watch_test {

constexpr double time_step = 1e-3;
constexpr double energy = 8;      // J
constexpr double rate_norm = 3;   // kg^-1/2
constexpr double clearance = 10;  // m

std::vector<LinearSystem> one_system() {
  std::vector<LinearSystem> systems(1);
  systems[0].total_mass = 2;
  return systems;
}

/// The step of the next look after one at step 1, nothing touching.
std::int64_t next_look(double norm, const std::array<double, 3>& force_norm = {},
                       const Vector3& peaks = {}, double known = energy, double round_off = 0) {
  const std::vector<StructureEnergy> energies{{0, 0, 0, 0, known, 0}};
  GapWatch watch(one_system(), {{norm, force_norm, {}}}, peaks, time_step);
  watch.energies_known(0, energies, {&round_off, 1});
  watch.looked(1, clearance, false);
  std::int64_t step = 2;
  while (!watch.due(step)) {
    EXPECT_TRUE(watch.needs_look(step));  // energies cost nothing: each look may widen the bound
    ++step;
  }
  return step;
}

/// No gap closes faster than rate_norm sqrt(2 E).
TEST(GapWatch, LooksBeforeTheEnergyCanCloseTheGap) {
  const double fastest = rate_norm * std::sqrt(2 * energy);
  const double steps = clearance / (fastest * time_step);
  const auto found = static_cast<double>(next_look(rate_norm) - 1);
  EXPECT_LE(found, steps);
  EXPECT_GT(found, steps / 4);
}

/// An energy that round-off ate is no sign of rest.
TEST(GapWatch, TakesRoundOffOfTheEnergyForMotion) {
  EXPECT_EQ(next_look(rate_norm, {}, {}, -0.1, energy), next_look(rate_norm));
  EXPECT_EQ(next_look(rate_norm, {}, {}, energy / 4, 3 * energy / 4), next_look(rate_norm));
}

/// The ground adds (|a_x| |M iota_x| + ...) t to sqrt(2 E).
TEST(GapWatch, LooksBeforeTheGroundCanCloseTheGap) {
  const Vector3 peaks{3, 0, 2};
  const std::array<double, 3> force_norm{2, 50, 4};
  const auto moved = [&](double steps) {
    const double root = std::sqrt(2 * energy) + 14 * time_step * (steps + 2);
    return rate_norm * root * steps * time_step;
  };
  const auto found = static_cast<double>(next_look(rate_norm, force_norm, peaks) - 1);
  EXPECT_LT(moved(found), clearance);
  EXPECT_GT(moved(4 * found), clearance);
  EXPECT_LT(found, static_cast<double>(next_look(rate_norm) - 1));
}

TEST(GapWatch, LooksAtEveryStepWhereTheEnergyIsNoBound) {
  EXPECT_EQ(next_look(std::numeric_limits<double>::infinity()), 2);
}

}  // namespace gap_watch_test
}  // namespace pounding
