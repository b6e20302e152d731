#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "laws/dashpot_law.h"
#include "support/passive_oscillator.h"

namespace pounding::interactions {
namespace series_law_test {

constexpr double dt = 1e-3;

/// Numbers from far below to far above those that go with the step.
std::vector<SeriesLaw> laws() {
  std::vector<SeriesLaw> list;
  for (const double stiffness : {1e-3, 60.0, 1e12}) {
    for (const double strength : {1e-4, 1.7, 1e10}) {
      for (const double exponent : {0.01, 0.3, 1.0, 1.7}) {
        list.emplace_back(stiffness, strength, exponent, dt);
      }
    }
  }
  return list;
}

TEST(SeriesLaw, LosesNeverLessThanNothing) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const SeriesLaw& law : laws()) {
    std::vector<double> memory(law.memory_size(), 0.0);
    double before = any(random);
    double now = any(random);
    for (int n = 0; n < 200; ++n) {
      const double after = any(random);
      const double share = n == 0 ? 0.5 : 1;
      const double force = law.force(before, now, after, memory);
      const double held = law.energy(before, now, memory);
      law.remember(before, now, after, share, memory);
      const double work = share * force * (after - before) / 2;
      const double change = law.energy(now, after, memory) - held;
      ASSERT_TRUE(std::isfinite(force));
      EXPECT_GE(work - change, -1e-11 * (std::abs(work) + held + std::abs(change)));
      before = now;
      now = after;
    }
  }
}

TEST(SeriesLaw, SolutionIsTheForceOfTheElongationThatItLeaves) {
  for (const SeriesLaw& law : laws()) {
    for (const double first : {0.0, 1.0}) {
      const std::vector<double> memory{0.4, first};
      for (const double compliance : {0.0, 1e-9, 1e-3, 10.0}) {
        const double force = law.solve(-0.2, 0.1, 0.7, compliance, memory);
        const double after = 0.7 - compliance * force;
        // Within the round-off of elongations, which a stiff law multiplies.
        const double near = 1e-13 * (0.7 + compliance * std::abs(force));
        const double slack = 1e-12 * std::abs(force);
        EXPECT_LE(law.force(-0.2, 0.1, after - near, memory), force + slack);
        EXPECT_GE(law.force(-0.2, 0.1, after + near, memory), force - slack);
      }
    }
  }
}

/// Both dashpots of a rate by rate law pull alike: Newton's iteration beside the closed form.
TEST(SeriesLaw, ExponentsNearOneAreNearTheLinearLaw) {
  const std::vector<double> memory{0.4, 1};
  const double linear = SeriesLaw(60, 1.7, 1, dt).solve(-0.2, 0.1, 0.7, 0.01, memory);
  for (const double exponent : {1 - 1e-9, 1 + 1e-9}) {
    EXPECT_NEAR(SeriesLaw(60, 1.7, exponent, dt).solve(-0.2, 0.1, 0.7, 0.01, memory) / linear, 1,
                1e-7);
  }
}

/// A step of elongation that is held: Q = A e exp(-A t / c), and for a power a the closed form of
/// c y^a = Q, Q' = -A y.
TEST(SeriesLaw, RelaxesToSecondOrder) {
  for (const double exponent : {0.5, 1.0, 1.5}) {
    std::vector<double> errors;
    for (const double step : {1e-3, 5e-4}) {
      const SeriesLaw law(60, 1.7, exponent, step);
      std::vector<double> memory{6, 1};
      const int count = static_cast<int>(std::lround(0.02 / step));
      for (int n = 0; n < count; ++n) law.remember(0, 0, 0, 1, memory);
      const double power = 1 - 1 / exponent;
      const double turned = 60 * count * step / std::pow(1.7, 1 / exponent);
      const double exact = exponent == 1 ? 6 * std::exp(-turned)
                                         : std::pow(std::pow(6, power) - power * turned, 1 / power);
      errors.push_back(std::abs(memory[0] - exact));
    }
    EXPECT_LT(errors[1], 1e-2);
    EXPECT_NEAR(errors[0] / errors[1], 4, 0.3) << exponent;
  }
}

/// Explicit steps of a mass on a spring at 0.999 of its limit beside any numbers: the energy of
/// both never grows.
TEST(SeriesLaw, DoesNotMoveTheStableStep) {
  for (const SeriesLaw& law : laws()) expect_energy_never_grows(law, {0, 1}, dt, 3000);
}

}  // namespace series_law_test
}  // namespace pounding::interactions
