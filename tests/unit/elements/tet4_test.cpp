#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "elements/solids.h"
#include "solid_cantilever.h"
#include "solid_refusal.h"

namespace pounding {
namespace tet4_test {

using testing_support::concrete;
using testing_support::cut_cell;
using testing_support::dense_element;
using testing_support::DenseModel;
using testing_support::expect_refused;

const std::vector<double> unit{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};

TEST(Tet4, MassIsAQuarterOfTheVolume) {
  const auto element = dense_element(ElementType::tet4, unit, concrete());
  for (const double m : element.lumped_mass) EXPECT_NEAR(m, 2400.0 / 6 / 4, 1e-10);
}

TEST(Tet4, UniaxialStrainEnergyHasItsClosedForm) {
  // u = (x, 0, 0): the energy is (lambda + 2 mu) V / 2.
  const ElementProperties p = concrete();
  const auto element = dense_element(ElementType::tet4, unit, p);
  std::vector<double> u(12, 0.0);
  u[3] = 1;
  const double modulus = p.young * (1 - p.poisson) / ((1 + p.poisson) * (1 - 2 * p.poisson));
  const double energy =
      0.5 * testing_support::inner(u, testing_support::multiply(element.stiffness, u));
  EXPECT_NEAR(energy / (modulus / 12), 1, 1e-14);
}

TEST(Tet4, UniformStrainLeavesInnerNodesWithoutForce) {
  std::vector<Vector3> nodes;
  const auto index = [](std::size_t i, std::size_t j, std::size_t k) { return 9 * i + 3 * j + k; };
  for (std::size_t n = 0; n < 27; ++n)
    nodes.push_back(
        {static_cast<double>(n / 9), static_cast<double>(n / 3 % 3), static_cast<double>(n % 3)});
  nodes[13] = {1.2, 0.85, 1.1};
  DenseModel model(nodes, 3);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t k = 0; k < 2; ++k)
        for (const auto& element : cut_cell(
                 ElementType::tet4, {index(i, j, k), index(i + 1, j, k), index(i + 1, j + 1, k),
                                     index(i, j + 1, k), index(i, j, k + 1), index(i + 1, j, k + 1),
                                     index(i + 1, j + 1, k + 1), index(i, j + 1, k + 1)}))
          model.add(ElementType::tet4, element, concrete());
  EXPECT_LE(testing_support::patch_residual(model, {13}), 1e-12);
  double total = 0;
  for (const double m : model.lumped_mass()) total += m / 3;
  EXPECT_NEAR(total / (2400 * 8), 1, 1e-12);
}

TEST(Tet4, ImpossibleTetrahedraAreRefused) {
  auto swapped = unit;
  std::swap_ranges(swapped.begin(), swapped.begin() + 3, swapped.begin() + 3);
  expect_refused(ElementType::tet4, swapped, "two nodes swapped");
  auto flat = unit;
  flat[11] = 0;
  expect_refused(ElementType::tet4, flat, "four nodes in a plane");
  auto below = unit;
  below[11] = -1;
  expect_refused(ElementType::tet4, below, "turned inside out");
}

TEST(Tet4, CantileverConvergesFromAbove) {
  std::vector<double> errors;
  for (const std::size_t n : {1, 2, 3}) {
    const double frequency =
        testing_support::first_frequency(ElementType::tet4, {12 * n, n, n}, {6, 0.5, 0.5});
    const double ratio = frequency / testing_support::beam_frequency(6, 0.5);
    errors.push_back(ratio * ratio - 1);
    EXPECT_GT(ratio, 1);
  }
  EXPECT_GT(std::log(errors[0] / errors[1]) / std::log(2.0), 1.5) << errors[0] << ' ' << errors[1];
  EXPECT_GT(std::log(errors[1] / errors[2]) / std::log(1.5), 1.5) << errors[1] << ' ' << errors[2];
}

}  // namespace tet4_test
}  // namespace pounding
