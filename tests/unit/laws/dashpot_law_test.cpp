#include "laws/dashpot_law.h"

#include <gtest/gtest.h>

namespace pounding::interactions {
namespace dashpot_law_test {

TEST(DashpotLaw, PullsByTheMeanOfTheRatesBeforeAndAfter) {
  constexpr double c = 30;
  constexpr double dt = 0.01;
  const DashpotLaw law(c / (2 * dt));
  EXPECT_DOUBLE_EQ(law.force(-2 * dt, 0, 4 * dt), c * 3);
  EXPECT_DOUBLE_EQ(law.force(4 * dt, 0, -2 * dt), -c * 3);
  EXPECT_EQ(law.energy(1, 2), 0);
}

TEST(DashpotLaw, SolutionIsTheForceOfTheElongationThatItLeaves) {
  for (const double rate : {1e-3, 1.0, 1e9}) {
    const DashpotLaw law(rate);
    for (const double compliance : {0.0, 1e-6, 0.3, 1e4}) {
      const double force = law.solve(-0.2, 0, 0.7, compliance);
      const double after = 0.7 - compliance * force;
      const double tolerance = 1e-15 * rate * (0.7 + compliance * force);
      EXPECT_NEAR(law.force(-0.2, 0, after), force, tolerance) << rate << " " << compliance;
    }
  }
}

/// However strong it is: a free mass between two steps loses speed, and never more than all of it
/// twice over, as the trapezoidal rule has it.
TEST(DashpotLaw, NeverMakesAMassFaster) {
  for (double rate = 1e-6; rate < 1e12; rate *= 7) {
    const DashpotLaw law(rate);
    const double compliance = 0.5;
    const double after = 1 - compliance * law.solve(-1, 0, 1, compliance);
    EXPECT_LT(after, 1) << rate;
    EXPECT_GE(after, -1) << rate;
  }
}

}  // namespace dashpot_law_test
}  // namespace pounding::interactions
