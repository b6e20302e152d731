#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "laws/tension_law.h"

namespace pounding::interactions {
namespace filler_law_test {

constexpr double thickness = 0.1;  // m
constexpr double area = 2;         // m2

Filler foam() {
  Filler filler;
  filler.table = {{0.2, 6e3}, {0.7, 9e3}, {0.9, 3e4}};
  filler.unloading = 6e5;
  return filler;
}

const FillerLaw law(foam(), thickness, area);

/// N_n at rest at a compression, after it has crushed.
double force_at(double compression, std::array<double, 2>& memory) {
  law.yield(compression, 0, memory);
  const double force = law.force(compression, compression, compression, memory);
  law.remember(compression, compression, compression, 1, memory);
  return force;
}

TEST(FillerLaw, FollowsItsTableThenUnloadsAndKeepsWhatIsCrushed) {
  std::array<double, 2> memory{};
  EXPECT_NEAR(force_at(0.01, memory), area * 3e3, 1e-9);
  EXPECT_NEAR(force_at(0.045, memory), area * 7.5e3, 1e-9);
  EXPECT_NEAR(force_at(0.07, memory), area * 9e3, 1e-9);
  const double crushed = 0.07 - area * 9e3 / law.tangent();
  EXPECT_NEAR(memory[0], crushed, 1e-15);
  EXPECT_NEAR(force_at(0.069, memory), area * 9e3 - 0.001 * law.tangent(), 1e-8);
  EXPECT_EQ(force_at(0.03, memory), 0);
  EXPECT_EQ(force_at(-0.5, memory), 0);
  EXPECT_NEAR(force_at(0.07, memory), area * 9e3, 1e-8);
  EXPECT_NEAR(memory[0], crushed, 1e-15);
  // Beyond the table on its last slope, 21 kPa over 0.2.
  EXPECT_NEAR(force_at(0.1, memory), area * (3e4 + 1.05e4), 1e-8);
}

TEST(FillerLaw, NeverLosesLessThanNothingWhateverTheCompressions) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (const double size : {1e-4, 1e-2, 0.1}) {
    std::array<double, 2> memory{};
    double before = 0;
    double now = 0;
    for (int n = 0; n < 20000; ++n) {
      law.yield(now, 0, memory);
      const double held = law.energy(before, now, memory);
      const double free_after = now + size * normal(random);
      const double compliance = std::pow(10.0, n % 7 - 3) / law.tangent();
      const double force = law.solve(before, now, free_after, compliance, memory);
      const double after = free_after - compliance * force;
      EXPECT_GE(force, 0);
      law.remember(before, now, after, 1, memory);
      const double kept = law.energy(now, after, memory) - held;
      const double loss = force * (after - before) / 2 - kept;
      const double scale = law.tangent() * (now * now + after * after + before * before);
      EXPECT_GE(loss, -1e-14 * scale) << before << " " << now << " " << after;
      before = now;
      now = after;
    }
  }
}

TEST(FillerLaw, SolutionIsTheForceOfTheCompressionThatItLeaves) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 20000; ++n) {
    std::array<double, 2> memory{std::max(0.0, 0.02 * normal(random)), 0};
    const double before = 0.03 * normal(random);
    const double now = 0.03 * normal(random);
    law.yield(now, 0, memory);
    const double free_after = 0.03 * normal(random);
    const double compliance = std::pow(10.0, n % 5 - 3) / law.tangent();
    const double force = law.solve(before, now, free_after, compliance, memory);
    const double after = free_after - compliance * force;
    // Round-off of the compression may change the force where the filler just lets go.
    const double unsure = 1e-14 * (std::abs(free_after) + std::abs(before) + std::abs(now));
    const double tolerance = 1e-12 * law.tangent() * std::abs(now);
    EXPECT_GE(force, law.force(before, now, after - unsure, memory) - tolerance);
    EXPECT_LE(force, law.force(before, now, after + unsure, memory) + tolerance);
  }
}

/// A unit mass on a spring beside a filler: largest energy over the
/// first; dt in parts of the limit 2 / sqrt(1 + spring).
double largest_energy(double spring, double fraction) {
  Filler filler;
  filler.table = {{0.5, 0.5}, {1, 0.6}};
  filler.unloading = 1;
  const FillerLaw soft(filler, 1, 1);
  const double dt = fraction * 2 / std::sqrt(1 + spring);
  std::array<double, 2> memory{};
  double before = -dt;
  double now = 0;
  double first = 0;
  double largest = 0;
  for (int n = 0; n < 20000; ++n) {
    soft.yield(now, 0, memory);
    const double free_after = 2 * now - before - dt * dt * spring * now;
    const double after =
        free_after - dt * dt * soft.solve(before, now, free_after, dt * dt, memory);
    soft.remember(before, now, after, 1, memory);
    const double velocity = (after - now) / dt;
    const double energy =
        velocity * velocity / 2 + spring * now * after / 2 + soft.energy(now, after, memory);
    if (n == 0) first = energy;
    largest = std::max(largest, energy);
    before = now;
    now = after;
  }
  return largest / first;
}

TEST(FillerLaw, NoEnergyGrowsBelowTheStepOfItsUnloadingSlope) {
  for (double spring = 0.01; spring < 200; spring *= 1.37) {
    for (const double fraction : {0.3, 0.77, 0.95, 0.999}) {
      EXPECT_LE(largest_energy(spring, fraction), 1 + 1e-9) << spring << " " << fraction;
    }
  }
}

}  // namespace filler_law_test
}  // namespace pounding::interactions
