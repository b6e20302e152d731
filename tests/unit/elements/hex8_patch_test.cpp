#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dense_model.h"

namespace pounding {
namespace hex8_patch_test {

using testing_support::DenseModel;

/// The solid patch of R. H. MacNeal and R. L. Harder, Finite Elements in Analysis and Design 1
/// (1985): a distorted brick inside a unit cube, and six around it.
const std::vector<Vector3> patch_nodes{
    {.249, .342, .192}, {.826, .288, .288}, {.850, .649, .263}, {.273, .750, .230},
    {.320, .186, .643}, {.677, .305, .683}, {.788, .693, .644}, {.165, .745, .702},
    {0, 0, 0},          {1, 0, 0},          {1, 1, 0},          {0, 1, 0},
    {0, 0, 1},          {1, 0, 1},          {1, 1, 1},          {0, 1, 1}};
const std::vector<std::vector<std::size_t>> patch_elements{
    {0, 1, 2, 3, 4, 5, 6, 7},   {8, 9, 10, 11, 0, 1, 2, 3},  {4, 5, 6, 7, 12, 13, 14, 15},
    {8, 9, 1, 0, 12, 13, 5, 4}, {9, 10, 2, 1, 13, 14, 6, 5}, {10, 11, 3, 2, 14, 15, 7, 6},
    {11, 8, 0, 3, 15, 12, 4, 7}};
constexpr std::size_t inner_nodes = 8;

DenseModel solid_patch(ElementType type) {
  ElementProperties p{.young = 1e6, .poisson = 0.25, .density = 1};
  DenseModel model(patch_nodes, 3);
  for (const auto& element : patch_elements) model.add(type, element, p);
  return model;
}

/// u = 1e-3 (2x + y + z, x + 2y + z, x + y + 2z) / 2: all six engineering strains are 1e-3, the
/// stresses 2000 and 400.
std::vector<double> uniform_strain() {
  std::vector<double> u;
  for (const Vector3& x : patch_nodes)
    for (std::size_t i = 0; i < 3; ++i) u.push_back(0.5e-3 * (x[0] + x[1] + x[2] + x[i]));
  return u;
}

TEST(Hex8Patch, UniformStrainLeavesInnerNodesWithoutForce) {
  for (const ElementType type : {ElementType::hex8_full, ElementType::hex8}) {
    const DenseModel model = solid_patch(type);
    const auto u = uniform_strain();
    const auto force = testing_support::multiply(model.stiffness(), u);
    for (std::size_t i = 0; i < 3 * inner_nodes; ++i) EXPECT_NEAR(force[i], 0, 1e-10);
    EXPECT_NEAR(0.5 * testing_support::inner(u, force), 3.6, 1e-12);
    // A corner of the cube takes a quarter of the traction on each of its three faces.
    for (std::size_t node = inner_nodes; node < 16; ++node)
      for (std::size_t i = 0; i < 3; ++i) {
        double traction = 0;
        for (std::size_t j = 0; j < 3; ++j)
          traction += (i == j ? 2000 : 400) * (patch_nodes[node][j] > 0.5 ? 0.25 : -0.25);
        EXPECT_NEAR(force[3 * node + i], traction, 1e-9);
      }
  }
}

TEST(Hex8Patch, InnerNodesFindTheirPlaceFromTheBoundary) {
  for (const ElementType type : {ElementType::hex8_full, ElementType::hex8}) {
    DenseModel model = solid_patch(type);
    const auto exact = uniform_strain();
    std::vector<double> boundary = exact;
    std::fill(boundary.begin(), boundary.begin() + 3 * inner_nodes, 0.0);
    auto load = testing_support::multiply(model.stiffness(), boundary);
    for (double& f : load) f = -f;
    for (std::size_t node = inner_nodes; node < 16; ++node) model.clamp(node);
    const auto u = model.solve(load);
    for (std::size_t i = 0; i < 3 * inner_nodes; ++i) EXPECT_NEAR(u[i], exact[i], 1e-15);
  }
}

TEST(Hex8Patch, MassIsTheRowSumOfEachNode) {
  DenseModel model = solid_patch(ElementType::hex8);
  const double expected[] = {
      0.05471681027314812, 0.050176645226851835, 0.05129836004629629, 0.05536999235648147,
      0.0581471575185185,  0.054246704981481465, 0.05831227570370368, 0.061356190212962965,
      0.06758406480324072, 0.06409990947222222,  0.06433077661111111, 0.06660845399537035,
      0.07373648044675923, 0.0724209469236111,   0.07395240400694442, 0.0736428274212963};
  double total = 0;
  for (std::size_t node = 0; node < 16; ++node) {
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(model.lumped_mass()[3 * node + i], expected[node], 1e-15);
    total += model.lumped_mass()[3 * node];
  }
  EXPECT_NEAR(total, 1, 1e-14);
}

}  // namespace hex8_patch_test
}  // namespace pounding
