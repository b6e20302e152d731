#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "brick_mesh.h"
#include "solid_refusal.h"

namespace pounding {
namespace hex8_refusal_test {

using testing_support::box;
using testing_support::concrete;
using testing_support::dense_element;

void expect_refused(const std::vector<double>& x, const std::string& why) {
  for (const ElementType type : {ElementType::hex8_full, ElementType::hex8}) {
    testing_support::expect_refused(type, x, why);
  }
}

TEST(Hex8Refusal, ImpossibleBricksAreRefused) {
  const auto good = box(1, 1, 1);
  auto swapped = good;
  std::swap_ranges(swapped.begin(), swapped.begin() + 3, swapped.begin() + 3);
  expect_refused(swapped, "two nodes swapped");

  auto upside_down = good;
  std::swap_ranges(upside_down.begin(), upside_down.begin() + 12, upside_down.begin() + 12);
  expect_refused(upside_down, "bottom above top");

  expect_refused(box(1, 1, 0), "zero thickness");
  expect_refused(std::vector<double>(24, 0.5), "one point");

  auto far = box(1, 1, 0);
  for (std::size_t i = 0; i < 24; ++i) far[i] += 1e6;
  far[14] += 1e-9;  // one unit in the last place of thickness
  expect_refused(far, "zero thickness far from the origin");

  auto dented = good;  // one corner pushed past the plane of its neighbours
  dented[18] = dented[19] = dented[20] = 0.1;
  expect_refused(dented, "corner inside out");

  auto lost = good;
  lost[5] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(lost, "not a number");
}

TEST(Hex8Refusal, InversionIsReportedWithItsJacobian) {
  // The unit cube with its first two nodes swapped.
  auto x = box(1, 1, 1);
  std::swap_ranges(x.begin(), x.begin() + 3, x.begin() + 3);
  try {
    dense_element(ElementType::hex8, x, concrete());
    ADD_FAILURE() << "accepted";
  } catch (const ElementError& error) {
    EXPECT_STREQ(error.what(), "non-positive Jacobian -0.0305021");
  }
}

TEST(Hex8Refusal, FoldedCornerIsRefusedOnceItReachesAGaussPoint) {
  // Corner 6 at s (1, 1, 1): its own Jacobian vanishes at s = 2/3, that of the Gauss point later.
  auto x = box(1, 1, 1);
  x[18] = x[19] = x[20] = 0.6;
  const auto e = dense_element(ElementType::hex8, x, concrete());
  for (const double m : e.lumped_mass) EXPECT_GT(m, 0);
  const double jacobian_vanishes_at = [] {
    // J = I / 2 + (s - 1) (1, 1, 1)' grad N_6: det = (1 + 2 (s - 1) sum dN_6) / 8.
    const double g = 1 / std::sqrt(3.0);
    return 1 - 1 / (2 * 3 * 0.125 * (1 + g) * (1 + g));
  }();
  x[18] = x[19] = x[20] = jacobian_vanishes_at + 1e-6;
  EXPECT_NO_THROW(dense_element(ElementType::hex8, x, concrete()));
  x[18] = x[19] = x[20] = jacobian_vanishes_at - 1e-6;
  expect_refused(x, "Gauss point inside out");
}

TEST(Hex8Refusal, IncompressibleMaterialIsRefusedNotNaN) {
  ElementProperties p = concrete(0.5);
  EXPECT_THROW(dense_element(ElementType::hex8, box(1, 1, 1), p), ElementError);
}

}  // namespace hex8_refusal_test
}  // namespace pounding
