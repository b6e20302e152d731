#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "laws/law_of.h"
#include "laws/yield_law.h"

namespace pounding::interactions {
namespace pendulum_law_test {

constexpr double stiffness = 100;
constexpr double hardening = 0.2;
constexpr double radius = 2;

TEST(PendulumLaw, SlopeIsWhatPressesOverTheRadius) {
  const PendulumLaw law(stiffness, hardening, radius);
  std::array<double, 5> memory{};
  for (const double pressed : {0.0, 10.0, 30.0}) {
    law.press(pressed, memory);
    law.yield(0.7, 0, memory);  // no friction left
    EXPECT_DOUBLE_EQ(law.force(0.7, 0.7, 0.7, memory), pressed / radius * 0.7);
    EXPECT_FALSE(law.was_overpressed(memory));
  }
  law.press(50, memory);
  EXPECT_DOUBLE_EQ(law.force(0.7, 0.7, 0.7, memory), hardening * stiffness * 0.7);
  EXPECT_TRUE(law.was_overpressed(memory));
  EXPECT_DOUBLE_EQ(law.tangent(), stiffness);
}

/// Loss of steps of any size under any force that presses, what is given from outside counted in.
TEST(PendulumLaw, LosesWhatFrictionTakesWhateverPresses) {
  const PendulumLaw law(stiffness, hardening, radius);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::array<double, 5> memory{};
  double before = 0;
  double now = 0;
  double last = 0;  // q
  for (int n = 0; n < 20000; ++n) {
    law.press(30 * uniform(random), memory);
    const double trial = law.trial(now, memory);
    const double capacity = 5 * uniform(random);
    const double kept = std::abs(trial) > capacity ? capacity / std::abs(trial) : 1;
    const double plastic = memory[0];
    law.yield(now, kept, memory);
    const double after = now + 0.1 * normal(random);
    const double q = trial * kept;
    const double held = law.energy(before, now, memory);
    const double given = law.given(before, now, memory);
    const double force = law.force(before, now, after, memory);
    law.remember(before, now, after, 1, memory);
    const double loss =
        force * (after - before) / 2 + given - (law.energy(now, after, memory) - held);
    EXPECT_NEAR(loss, (memory[0] - plastic) * (q + last) / 2, 1e-10) << n;
    last = q;
    before = now;
    now = after;
  }
}

TEST(PendulumLaw, RelievedItPullsLessByWhatTheMatrixHolds) {
  const RelievingLaw<PendulumLaw> law(stiffness, hardening, radius);
  std::array<double, 5> memory{};
  law.press(10, memory);
  law.yield(0.1, 0.5, memory);
  EXPECT_DOUBLE_EQ(law.force(0.1, 0.1, 0.1, memory) + law.counted(0.1),
                   10 / radius * 0.1 + 0.5 * (1 - hardening) * stiffness * 0.1);
}

}  // namespace pendulum_law_test
}  // namespace pounding::interactions
