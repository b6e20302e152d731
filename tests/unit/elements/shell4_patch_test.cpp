#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shell_model.h"

namespace pounding {
namespace shell4_patch_test {

using testing_support::inner;
using testing_support::ShellModel;

using Elements = std::vector<std::vector<std::size_t>>;

/// The plate patch of R. H. MacNeal and R. L. Harder, Finite Elements in Analysis and Design 1
/// (1985), 0.24 x 0.12: a distorted quadrangle and four around it.
const std::vector<Vector3> patch_nodes{{.04, .02, 0}, {.18, .03, 0}, {.16, .08, 0}, {.08, .08, 0},
                                       {0, 0, 0},     {.24, 0, 0},   {.24, .12, 0}, {0, .12, 0}};
const Elements quadrangles{{0, 1, 2, 3}, {4, 5, 1, 0}, {5, 6, 2, 1}, {6, 7, 3, 2}, {7, 4, 0, 3}};
const Elements triangles{{0, 1, 2}, {0, 2, 3}, {4, 5, 1}, {4, 1, 0}, {5, 6, 2},
                         {5, 2, 1}, {6, 7, 3}, {6, 3, 2}, {7, 4, 0}, {7, 0, 3}};
const Elements mixed{{0, 1, 3}, {1, 2, 3},    {4, 5, 1, 0}, {5, 6, 2},
                     {5, 2, 1}, {6, 7, 3, 2}, {7, 4, 0, 3}};
constexpr std::size_t inner_nodes = 4;
constexpr double thickness = 1e-3, width = 0.24, height = 0.12;

ShellModel patch(const Elements& elements) {
  ShellModel model(patch_nodes);
  for (const auto& element : elements) model.add(element, {1e6, 0.25, 1, thickness});
  return model;
}

/// u = 1e-3 (x + y / 2), v = 1e-3 (y + x / 2): strains 1e-3, stresses 4000/3 and 400.
std::vector<double> stretched() {
  std::vector<double> u;
  for (const auto& [x, y, z] : patch_nodes)
    u.insert(u.end(), {1e-3 * (x + y / 2), 1e-3 * (y + x / 2), 0, 0, 0, 0});
  return u;
}

/// w = 1e-3 (x^2 + x y + y^2) / 2 and the rotations of its normals.
std::vector<double> bent() {
  std::vector<double> u;
  for (const auto& [x, y, z] : patch_nodes)
    u.insert(u.end(),
             {0, 0, 0.5e-3 * (x * x + x * y + y * y), 1e-3 * (x / 2 + y), -1e-3 * (x + y / 2), 0});
  return u;
}

/// Sum of one component of the nodal forces over the edge x = width.
double sum_on_right_edge(const std::vector<double>& force, std::size_t component) {
  return force[6 * 5 + component] + force[6 * 6 + component];
}

TEST(Shell4Patch, UniformStrainGivesTheStressesAndNoInnerForce) {
  for (const Elements& elements : {quadrangles, triangles, mixed}) {
    const auto u = stretched();
    const auto force = testing_support::multiply(patch(elements).stiffness(), u);
    for (std::size_t i = 0; i < 6 * inner_nodes; ++i) EXPECT_NEAR(force[i], 0, 1e-13) << i;
    EXPECT_NEAR(sum_on_right_edge(force, 0) / (thickness * height), 4000.0 / 3, 1e-9);
    EXPECT_NEAR(sum_on_right_edge(force, 1) / (thickness * height), 400, 1e-9);
    EXPECT_NEAR(0.5 * inner(u, force), 0.5 * (8000.0 / 3 + 400) * 1e-3 * thickness * width * height,
                1e-15);
  }
}

TEST(Shell4Patch, UniformCurvatureGivesTheMomentsAndNoInnerForce) {
  for (const Elements& elements : {quadrangles, triangles, mixed}) {
    const auto u = bent();
    const auto force = testing_support::multiply(patch(elements).stiffness(), u);
    for (std::size_t i = 0; i < 6 * inner_nodes; ++i) EXPECT_NEAR(force[i], 0, 1e-17) << i;
    EXPECT_NEAR(sum_on_right_edge(force, 4) / height, -1e-6 / 9, 1e-16);  // -m_xx
    EXPECT_NEAR(sum_on_right_edge(force, 3) / height, 1e-7 / 3, 1e-16);   // m_xy
    EXPECT_NEAR(0.5 * inner(u, force), 3.68e-12, 1e-21);
  }
}

TEST(Shell4Patch, InnerNodesFindTheirPlaceFromTheBoundary) {
  for (const Elements& elements : {quadrangles, triangles, mixed})
    for (const auto& exact : {stretched(), bent()}) {
      ShellModel model = patch(elements);
      std::vector<double> boundary = exact;
      std::fill(boundary.begin(), boundary.begin() + 6 * inner_nodes, 0.0);
      auto load = testing_support::multiply(model.stiffness(), boundary);
      for (double& f : load) f = -f;
      for (std::size_t node = inner_nodes; node < patch_nodes.size(); ++node) model.clamp(node);
      const auto u = model.solve(load);
      for (std::size_t i = 0; i < 6 * inner_nodes; ++i) EXPECT_NEAR(u[i], exact[i], 1e-10 * 2e-4);
    }
}

TEST(Shell4Patch, MassIsTheAreaTimesTheThickness) {
  for (const Elements& elements : {quadrangles, triangles, mixed}) {
    const ShellModel model = patch(elements);
    double mass = 0, inertia = 0;
    for (std::size_t node = 0; node < patch_nodes.size(); ++node) {
      mass += model.lumped_mass()[6 * node];
      inertia += model.lumped_mass()[6 * node + 5];
    }
    EXPECT_NEAR(mass, thickness * width * height, 1e-18);
    EXPECT_NEAR(inertia, std::pow(thickness, 3) / 12 * width * height, 1e-24);
  }
}

}  // namespace shell4_patch_test
}  // namespace pounding
