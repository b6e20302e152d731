#include "laws/tension_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace pounding::interactions {
namespace tension_law_test {

constexpr double damping_rate = 0.7;  // of the damped one [N/m]
const TensionLaw undamped{3, 0};
const TensionLaw damped{3, damping_rate};

/// Elongations of both signs, of very different size, and some exactly zero.
std::vector<double> elongations() {
  std::vector<double> values{0, 1, -1, 1e-9, -1e-9, 1e-30, -1e-30};
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 9; ++i) {
    values.push_back(normal(random) * std::pow(10.0, i % 3 - 2));
  }
  return values;
}

TEST(TensionLaw, IsCentralDifferencesWhileTautAndNothingWhileSlack) {
  EXPECT_DOUBLE_EQ(undamped.force(0.2, 0.5, 0.1), 1.5);
  EXPECT_DOUBLE_EQ(undamped.solve(0.2, 0.5, 0.4, 0.01), 1.5);
  EXPECT_EQ(undamped.force(0.2, -0.5, 0.1), 0);
  EXPECT_EQ(undamped.force(-0.2, 0.5, -0.1), 0);
  EXPECT_DOUBLE_EQ(damped.force(0.2, 0.5, 0.1), 1.5 - 0.07);
}

TEST(TensionLaw, NeverPushesAndGrowsWithTheElongation) {
  for (const TensionLaw& law : {undamped, damped}) {
    for (const double before : elongations()) {
      for (const double now : elongations()) {
        std::vector<double> afters = elongations();
        std::sort(afters.begin(), afters.end());
        double last = 0;
        for (const double after : afters) {
          const double tension = law.force(before, now, after);
          EXPECT_GE(tension, last * (1 - 1e-12)) << before << " " << now << " " << after;
          last = tension;
        }
      }
    }
  }
}

TEST(TensionLaw, WorkIsTheChangeOfItsEnergyAndWithDampingMore) {
  for (const double before : elongations()) {
    for (const double now : elongations()) {
      for (const double after : elongations()) {
        const auto given = [&](const TensionLaw& law) {
          return law.energy(now, after) - law.energy(before, now) -
                 law.force(before, now, after) * (after - before) / 2;
        };
        const double scale = std::abs(now) * (std::abs(after) + std::abs(before));
        EXPECT_NEAR(given(undamped), 0, 1e-15 * scale) << before << " " << now << " " << after;
        EXPECT_LE(given(damped), 1e-15 * scale) << before << " " << now << " " << after;
      }
    }
  }
}

TEST(TensionLaw, SolutionIsTheTensionOfTheElongationThatItLeaves) {
  for (const TensionLaw& law : {undamped, damped}) {
    for (const double compliance : {1e-6, 0.01, 0.3, 1.3, 20.0}) {
      for (const double before : elongations()) {
        for (const double now : elongations()) {
          for (const double free_after : elongations()) {
            const double tension = law.solve(before, now, free_after, compliance);
            // Round-off of the elongation may change the tension, where the bar just switches
            // much: it lies between those of elongations that close.
            const double after = free_after - compliance * tension;
            const double unsure = 1e-14 * (std::abs(free_after) + std::abs(before) +
                                           compliance * law.tangent() * std::abs(now));
            const double tolerance =
                1e-12 * law.tangent() * std::abs(now) + 2 * damping_rate * unsure;
            EXPECT_GE(tension, law.force(before, now, after - unsure) - tolerance)
                << before << " " << now << " " << free_after << " " << compliance;
            EXPECT_LE(tension, law.force(before, now, after + unsure) + tolerance)
                << before << " " << now << " " << free_after << " " << compliance;
          }
        }
      }
    }
  }
}

/// Branches of uniform damping beside a bar at rest, and forces that they remember.
const TensionLaw branched{3, damping_rate, 0.01, 0.8, {{2, 5}, {0.7, 60}}, 0.01};

std::vector<std::vector<double>> memories() {
  std::vector<std::vector<double>> values;
  for (const double first : {0.0, 0.4, -3.0}) {
    for (const double second : {0.0, 0.02, -0.5}) values.push_back({first, second, -0.02});
  }
  return values;
}

TEST(TensionLaw, BranchesGiveNoMoreThanTheyTookHoweverItSwitches) {
  for (const std::vector<double>& memory : memories()) {
    for (const double before : elongations()) {
      for (const double now : elongations()) {
        double last = 0;
        std::vector<double> afters = elongations();
        std::sort(afters.begin(), afters.end());
        for (const double after : afters) {
          const double tension = branched.force(before, now, after, memory);
          EXPECT_GE(tension, last * (1 - 1e-12)) << before << " " << now << " " << after;
          last = tension;
          std::vector<double> next = memory;
          branched.remember(before, now, after, 1, next);
          const double held = branched.energy(before, now, memory);
          const double given =
              branched.energy(now, after, next) - held - tension * (after - before) / 2;
          const double scale = held + std::abs(now) * (std::abs(after) + std::abs(before)) +
                               tension * std::abs(after - before);
          EXPECT_LE(given, 1e-14 * scale) << before << " " << now << " " << after;
        }
      }
    }
  }
}

TEST(TensionLaw, SolutionWithBranchesIsTheTensionOfTheElongationThatItLeaves) {
  for (const std::vector<double>& memory : memories()) {
    for (const double compliance : {1e-6, 0.01, 0.3, 20.0}) {
      for (const double before : elongations()) {
        for (const double now : elongations()) {
          for (const double free_after : elongations()) {
            const double tension = branched.solve(before, now, free_after, compliance, memory);
            const double after = free_after - compliance * tension;
            const double size = std::abs(free_after) + std::abs(before) + compliance * tension;
            const double unsure = 1e-13 * (size + std::abs(now));
            const double tolerance = 1e-11 * (size + std::abs(now) + std::abs(memory[0]) + tension);
            EXPECT_GE(tension, branched.force(before, now, after - unsure, memory) - tolerance)
                << before << " " << now << " " << free_after << " " << compliance;
            EXPECT_LE(tension, branched.force(before, now, after + unsure, memory) + tolerance)
                << before << " " << now << " " << free_after << " " << compliance;
          }
        }
      }
    }
  }
}

TEST(TensionLaw, RestPullsWithTheStiffnessOfTheMaterialWhateverIsBesideIt) {
  std::vector<double> memory{0, 0, 0};
  branched.rest(0.21, memory);
  EXPECT_DOUBLE_EQ(branched.force(0.21, 0.21, 0.21, memory), 3 * 0.2);
  branched.rest(-0.3, memory);
  EXPECT_EQ(branched.slack(memory), 0.01);
}

/// A unit mass on a spring of unit stiffness and a bar `ratio` times as stiff, from rest with unit
/// velocity. Largest energy over the first; dt in parts of the limit 2 / sqrt(1 + ratio).
double largest_energy(double ratio, double fraction, double damping) {
  const double dt = fraction * 2 / std::sqrt(1 + ratio);
  const TensionLaw law{ratio, damping / (2 * dt)};
  double before = -dt;
  double now = 0;
  double first = 0;
  double largest = 0;
  for (int n = 0; n < 20000; ++n) {
    const double free_after = 2 * now - before - dt * dt * now;
    const double after = free_after - dt * dt * law.solve(before, now, free_after, dt * dt);
    const double velocity = (after - now) / dt;
    const double energy = velocity * velocity / 2 + now * after / 2 + law.energy(now, after);
    if (n == 0) {
      first = energy;
    }
    largest = std::max(largest, energy);
    before = now;
    now = after;
  }
  return largest / first;
}

TEST(TensionLaw, SwitchingMapDoesNotGrowAtAnyRatioOfStiffnesses) {
  for (double ratio = 0.01; ratio < 200; ratio *= 1.37) {
    for (const double fraction : {0.05, 0.4, 0.6, 0.9, 0.99, 0.9999}) {
      EXPECT_LT(largest_energy(ratio, fraction, 0), 1 + 1e-9) << ratio << " " << fraction;
      EXPECT_LT(largest_energy(ratio, fraction, 0.01), 1 + 1e-9) << ratio << " " << fraction;
    }
  }
}

/// Second order: period of the bilinear oscillator, pi (1 + 1 / sqrt(1 + ratio)).
TEST(TensionLaw, PeriodConvergesInSecondOrder) {
  const double ratio = 3;
  const double exact = std::numbers::pi * (1 + 1 / std::sqrt(1 + ratio));
  const auto error = [&](double dt) {
    const TensionLaw law{ratio, 0};
    double before = -dt;
    double now = 0;
    int crossings = 0;
    for (int n = 1;; ++n) {
      const double free_after = 2 * now - before - dt * dt * now;
      const double after = free_after - dt * dt * law.solve(before, now, free_after, dt * dt);
      if (now < 0 && after >= 0 && ++crossings == 20) {
        return std::abs((n - 1 - now / (after - now)) * dt / 20 - exact);
      }
      before = now;
      now = after;
    }
  };
  EXPECT_LT(error(0.01), 1e-4);
  EXPECT_LT(error(0.0025), error(0.01) / 12);
}

}  // namespace tension_law_test
}  // namespace pounding::interactions
