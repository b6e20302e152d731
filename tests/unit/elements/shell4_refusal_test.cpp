#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shell_model.h"

namespace pounding {
namespace shell4_refusal_test {

using testing_support::dense_shell;

const std::vector<double> good{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

void expect_refused(const std::vector<double>& x, const std::string& why, double thickness = 0.2) {
  const ShellProperties p{30e9, 0.2, 2400, thickness, 0};
  std::vector<double> stiffness(24 * 24), lumped_mass(24);
  for (const bool is_mass : {false, true}) {
    try {
      is_mass ? shell4_lumped_mass(x, p, lumped_mass) : shell4_stiffness(x, p, stiffness);
      ADD_FAILURE() << why << " accepted";
    } catch (const ElementError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  }
}

TEST(Shell4Refusal, ImpossibleQuadranglesAreRefused) {
  auto crossed = good;
  std::swap_ranges(crossed.begin(), crossed.begin() + 3, crossed.begin() + 3);
  expect_refused(crossed, "non-positive area");

  auto lopsided = good;  // crossed too, but with some area left between its diagonals
  lopsided[0] = 0.3;
  std::swap_ranges(lopsided.begin(), lopsided.begin() + 3, lopsided.begin() + 3);
  expect_refused(lopsided, "non-positive Jacobian");

  auto dented = good;
  dented[6] = dented[7] = 0.4;
  expect_refused(dented, "non-positive Jacobian -0.05 at corner 3");

  auto triangle = good;  // three nodes in line
  triangle[6] = triangle[7] = 0.5;
  expect_refused(triangle, "non-positive Jacobian");

  auto doubled = good;
  std::copy(good.begin() + 6, good.begin() + 9, doubled.begin() + 9);
  expect_refused(doubled, "non-positive Jacobian");

  expect_refused({0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}, "non-positive area");
  expect_refused(std::vector<double>(12, 0.5), "non-positive area");

  auto lost = good;
  lost[5] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(lost, "non-positive area");
}

TEST(Shell4Refusal, ThicknessMustBePositive) {
  expect_refused(good, "thickness 0 m is not positive", 0);
  expect_refused(good, "thickness -0.2 m is not positive", -0.2);
  expect_refused(good, "is not positive", std::numeric_limits<double>::quiet_NaN());
}

TEST(Shell4Refusal, WarpIsAcceptedUpToATenthOfTheSize) {
  // One corner of the unit square lifted by s: the nodes are s / 4 off the plane, to first order.
  const ShellProperties p{30e9, 0.2, 2400, 0.2, 0};
  auto x = good;
  x[8] = 0.38;
  EXPECT_NO_THROW(dense_shell(x, p));
  x[8] = 0.44;
  expect_refused(x, "warped: its nodes are 0.1");
}

}  // namespace shell4_refusal_test
}  // namespace pounding
