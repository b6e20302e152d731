#include "laws/yield_law.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "laws/dashpot_law.h"
#include "laws/law_of.h"

namespace pounding::interactions {
namespace yield_law_test {

/// Steps of a law alone, from elongations that come from anywhere; the least loss of a step and all
/// of it.
struct Walk {
  double least = 0;
  double all = 0;
  double largest_force = 0;
};

Walk walk(const LinkLaw& law, unsigned seed, double size) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, size);
  std::vector<double> memory(law.memory_size(), 0.0);
  double before = 0;
  double now = 0;
  Walk result;
  for (int i = 0; i < 20000; ++i) {
    const double after = i % 3 == 0 ? normal(random) : now + 0.1 * normal(random);
    const double trial = std::abs(law.trial(now, memory));
    law.yield(now, trial > law.capacity() ? law.capacity() / trial : 1, memory);
    const double force = law.force(before, now, after, memory);
    const double held = law.energy(before, now, memory);
    law.remember(before, now, after, 1, memory);
    const double loss = force * (after - before) / 2 - (law.energy(now, after, memory) - held);
    result.least = std::min(result.least, loss);
    result.all += loss;
    result.largest_force = std::max(result.largest_force, std::abs(force));
    before = now;
    now = after;
  }
  return result;
}

TEST(YieldLaw, NeverGivesEnergyWhateverTheElongationsAre) {
  for (const double hardening : {0.0, 0.2, 0.9}) {
    for (const double size : {0.05, 1.0, 300.0}) {
      const Walk found = walk(YieldLaw(1000, hardening, 100), 3, size);
      EXPECT_GE(found.least, -1e-12 * 1000 * size * size) << hardening << " " << size;
      if (size < 0.1) {
        EXPECT_NEAR(found.all, 0, 0.2 * 20000 * 1000 * size * size);
      } else {
        EXPECT_GT(found.all, 0);
      }
      if (hardening == 0) {
        EXPECT_LE(found.largest_force, 100 * (1 + 1e-12));
      }
    }
  }
}

TEST(YieldLaw, DoesNotYieldBelowItsForce) {
  const YieldLaw law(1000, 0.1, 100);
  std::vector<double> memory(2, 0.0);
  law.yield(0.0999, 1, memory);
  EXPECT_NEAR(law.force(0, 0.0999, 0, memory), 99.9, 1e-12);
  law.yield(0.3, 90 / law.trial(0.3, memory), memory);
  EXPECT_NEAR(law.force(0, 0.3, 0, memory), 100 + 100 * 0.2, 1e-12);
  law.remember(0, 0.3, 0, 1, memory);
  law.yield(0.2, 1, memory);  // back along the stiffness before
  EXPECT_NEAR(law.force(0.3, 0.2, 0, memory), 120 - 1000 * 0.1, 1e-12);
}

TEST(YieldLaw, BesideItsOwnStiffnessInKIsTheSame) {
  const RelievingLaw<YieldLaw> relieving(1000, 0.1, 100);
  const YieldLaw law(1000, 0.1, 100);
  std::vector<double> one(2, 0.0);
  std::vector<double> other(2, 0.0);
  for (const double now : {0.05, 0.3, 0.7, -0.4}) {
    EXPECT_EQ(law.trial(now, one), relieving.trial(now, other));
    const double kept = std::min(1.0, law.capacity() / std::abs(law.trial(now, one)));
    law.yield(now, kept, one);
    relieving.yield(now, kept, other);
    EXPECT_NEAR(relieving.force(0, now, 1, other) + 1000 * now, law.force(0, now, 1, one), 1e-10);
    EXPECT_NEAR(relieving.energy(now, 0.2, other) + 500 * now * 0.2, law.energy(now, 0.2, one),
                1e-10);
    law.remember(0, now, 1, 1, one);
    relieving.remember(0, now, 1, 1, other);
  }
}

TEST(DamperLaw, SolvesForItsForceWhateverItsPower) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 5000; ++i) {
    const double exponent = std::exp(uniform(random) * 1.5) * 0.4;  // .09 to 1.8
    const double strength = std::pow(10.0, 6 * uniform(random));
    const double compliance = std::pow(10.0, 5 * uniform(random) - 5);
    const DamperLaw law(strength, exponent, 1e-4);
    const double before = uniform(random);
    const double free_after = uniform(random) * std::pow(10.0, 4 * uniform(random));
    const double force = law.solve(before, 0, free_after, compliance);
    const double change = free_after - before - compliance * force;
    EXPECT_GE(change * force, 0);
    const double c = strength / std::pow(2e-4, exponent);
    EXPECT_NEAR(std::pow(std::abs(force) / c, 1 / exponent) + compliance * std::abs(force),
                std::abs(free_after - before), 1e-12 * std::abs(free_after - before));
  }
  EXPECT_EQ(DamperLaw(1e3, 0.5, 1e-4).solve(0.1, 0, 0.1, 1e-6), 0);
}

}  // namespace yield_law_test
}  // namespace pounding::interactions
