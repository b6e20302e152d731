#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "elements/solids.h"
#include "solid_cantilever.h"
#include "solid_refusal.h"

namespace pounding {
namespace wedge6_test {

using testing_support::concrete;
using testing_support::cut_cell;
using testing_support::dense_element;
using testing_support::DenseModel;
using testing_support::expect_refused;

const std::vector<double> unit{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1};

TEST(Wedge6, MassIsTheShareOfVolume) {
  const auto wedge = dense_element(ElementType::wedge6, unit, concrete());
  for (const double m : wedge.lumped_mass) EXPECT_NEAR(m, 2400 * 0.5 / 6, 1e-10);
  // A frustum, its top half as wide: the section is (2 - z)^2 / 8, its integral 7 / 24, and that of
  // z times it, which the upper nodes take, 11 / 96.
  auto frustum = unit;
  for (const std::size_t i : {12, 16}) frustum[i] = 0.5;
  const auto narrow = dense_element(ElementType::wedge6, frustum, concrete());
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(narrow.lumped_mass[i], 2400 * (7.0 / 24 - 11.0 / 96) / 3, 1e-10);
    EXPECT_NEAR(narrow.lumped_mass[9 + i], 2400 * (11.0 / 96) / 3, 1e-10);
  }
}

TEST(Wedge6, UniformStrainLeavesInnerNodesWithoutForce) {
  // 3 x 3 x 3 cells in wedges, their inner nodes moved about.
  std::vector<Vector3> nodes;
  std::vector<std::size_t> inner;
  const auto index = [](std::size_t i, std::size_t j, std::size_t k) { return 16 * i + 4 * j + k; };
  for (std::size_t n = 0; n < 64; ++n) {
    const std::array<std::size_t, 3> at{n / 16, n / 4 % 4, n % 4};
    Vector3 x{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
    if (std::ranges::all_of(at, [](std::size_t place) { return place == 1 || place == 2; })) {
      inner.push_back(n);
      for (std::size_t d = 0; d < 3; ++d) x[d] += 0.2 * std::sin(static_cast<double>(7 * n + d));
    }
    nodes.push_back(x);
  }
  DenseModel model(nodes, 3);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        for (const auto& wedge :
             cut_cell(ElementType::wedge6,
                      {index(i, j, k), index(i + 1, j, k), index(i + 1, j + 1, k),
                       index(i, j + 1, k), index(i, j, k + 1), index(i + 1, j, k + 1),
                       index(i + 1, j + 1, k + 1), index(i, j + 1, k + 1)}))
          model.add(ElementType::wedge6, wedge, concrete());
  EXPECT_EQ(inner.size(), 8U);
  EXPECT_LE(testing_support::patch_residual(model, inner), 1e-12);
  double total = 0;
  for (const double m : model.lumped_mass()) total += m / 3;
  EXPECT_NEAR(total / (2400 * 27), 1, 1e-12);
}

TEST(Wedge6, ImpossibleWedgesAreRefused) {
  auto swapped = unit;
  std::swap_ranges(swapped.begin(), swapped.begin() + 3, swapped.begin() + 3);
  std::swap_ranges(swapped.begin() + 9, swapped.begin() + 12, swapped.begin() + 12);
  expect_refused(ElementType::wedge6, swapped, "triangles the other way round");
  auto upside_down = unit;
  std::swap_ranges(upside_down.begin(), upside_down.begin() + 9, upside_down.begin() + 9);
  expect_refused(ElementType::wedge6, upside_down, "bottom above top");
  auto flat = unit;
  for (const std::size_t i : {11, 14, 17}) flat[i] = 0;
  expect_refused(ElementType::wedge6, flat, "zero thickness");
  auto thin = unit;
  for (std::size_t i = 1; i < 18; i += 3) thin[i] = 0;
  expect_refused(ElementType::wedge6, thin, "triangles without area");
}

TEST(Wedge6, CantileverConvergesWithTheSquareOfTheMesh) {
  // Bends in the plane of the triangles. Errors are those of the stiffness, so of frequencies
  // squared.
  std::vector<double> errors;
  for (const std::size_t n : {1, 2, 4}) {
    const double frequency =
        testing_support::first_frequency(ElementType::wedge6, {12 * n, n, 1}, {6, 0.5, 1});
    const double ratio = frequency / testing_support::beam_frequency(6, 0.5);
    errors.push_back(ratio * ratio - 1);
    EXPECT_GT(ratio, 1);
  }
  EXPECT_LT(errors[2], 0.3);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.2) << errors[0] << ' ' << errors[1];
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.2) << errors[1] << ' ' << errors[2];
}

}  // namespace wedge6_test
}  // namespace pounding
