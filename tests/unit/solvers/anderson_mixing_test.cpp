#include "solvers/anderson_mixing.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace pounding::interactions {
namespace anderson_mixing_test {

/// x <- x + (b - A x) / 2 with A = diag(1, ..., 1/64): the slowest part falls by 1 / 128 a step.
std::vector<double> image_of(const std::vector<double>& x) {
  std::vector<double> image = x;
  double a = 1;
  for (std::size_t i = 0; i < x.size(); ++i, a /= 2) image[i] += (1 - a * x[i]) / 2;
  return image;
}

/// Largest part of the solution that is wrong after so many steps.
double left(int steps, bool mixed) {
  std::vector<double> x(7, 0.0);
  const std::vector<double> weight(x.size(), 1.0);
  AndersonMixing mixing(x.size());
  for (int i = 0; i < steps; ++i) {
    const std::vector<double> image = image_of(x);
    if (mixed) {
      mixing.mix(weight, image, x);
    } else {
      x = image;
    }
  }
  double worst = 0;
  double exact = 1;
  for (const double value : x) {
    worst = std::max(worst, std::abs(value / exact - 1));
    exact *= 2;
  }
  return worst;
}

TEST(AndersonMixing, SolvesALinearIterationInAsManyStepsAsItHasParts) {
  EXPECT_GT(left(12, false), 0.9);
  EXPECT_LT(left(12, true), 1e-6);
}

TEST(AndersonMixing, ForgetsStepsThatDoNotTell) {
  AndersonMixing mixing(2);
  const std::vector<double> weight{1, 1};
  std::vector<double> x{1, 2};
  const std::vector<double> image{2, 3};
  EXPECT_TRUE(mixing.mix(weight, image, x));  // the first one has no history
  EXPECT_EQ(x, image);
  x = {1, 2};
  EXPECT_FALSE(mixing.mix(weight, image, x));  // the same once more
  EXPECT_EQ(x, image);
}

}  // namespace anderson_mixing_test
}  // namespace pounding::interactions
