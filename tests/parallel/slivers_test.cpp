#include "system/slivers.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/box_mesh.h"
#include "support/built_system.h"

namespace pounding {
namespace slivers_test {

using testing_support::box_mesh;
using testing_support::build_system;
using testing_support::BuiltSystem;
using testing_support::solid_structure;

constexpr int layers = 9;
constexpr int across = 2;

/// A column of cubes of 0.1 m, 2 x 2 of them in a layer; one layer of another thickness.
GlobalMesh column(int layer, double thickness) {
  GlobalMesh mesh = box_mesh({0, 0, 0}, {0.1 * across, 0.1 * across, 0.1 * layers},
                             {across, across, layers}, ElementType::hex8_full);
  for (std::size_t z = 2; z < mesh.coordinates.size(); z += 3) {
    if (mesh.coordinates[z] > 0.1 * (layer + 0.5)) {
      mesh.coordinates[z] += thickness - 0.1;
    }
  }
  return mesh;
}

Structure concrete(double beta = 0) {
  Structure structure = solid_structure("column", 30e9, 0, 2400, ElementType::hex8_full);
  structure.damping = {0, beta};
  return structure;
}

TEST(Slivers, AreTheElementsOfAThinLayer) {
  const double beta = 1e-5;
  const BuiltSystem cubes = build_system(column(0, 0.1), concrete(beta));
  EXPECT_TRUE(cubes.system.slivers.empty());
  const BuiltSystem thin = build_system(column(5, 0.005), concrete(beta));
  ASSERT_EQ(thin.system.slivers.size(), 1u);
  const Sliver& sliver = thin.system.slivers[0];
  EXPECT_EQ(sliver.element, "element 21 of group 'body' at (0.05, 0.05, 0.5025)");
  EXPECT_EQ(sliver.count, across * across);
  EXPECT_NEAR(sliver.median, cubes.system.element_time_step_bound, 1e-6 * sliver.median);
  EXPECT_EQ(sliver.time_step, thin.system.element_time_step_bound);
}

/// Without damping and Poisson's ratio a layer allows its thickness over the wave speed, and a cube
/// its side.
TEST(Slivers, BeginATenthBelowTheMedian) {
  const double wave = std::sqrt(30e9 / 2400);
  for (const double thickness : {0.02, 0.0101, 0.0099, 0.001}) {
    const BuiltSystem built = build_system(column(3, thickness), concrete());
    EXPECT_NEAR(built.system.element_time_step_bound * wave, thickness, 1e-6 * thickness);
    EXPECT_EQ(built.system.slivers.size(), thickness < 0.01 ? 1u : 0u) << thickness;
  }
}

/// One element is coarse: that makes no sliver of the others.
TEST(Slivers, AreFewerThanTheRest) {
  GlobalMesh mesh = box_mesh({0, 0, 0}, {0.1, 0.1, 0.005 * layers}, {1, 1, layers});
  for (std::size_t z = 2; z < mesh.coordinates.size(); z += 3) {
    if (mesh.coordinates[z] > 0.005 * (layers - 0.5)) {
      mesh.coordinates[z] += 0.1;
    }
  }
  EXPECT_TRUE(build_system(mesh, concrete()).system.slivers.empty());
}

/// A group of its own has a section or a thickness of its own.
TEST(Slivers, AreJudgedWithinTheirGroup) {
  GlobalMesh mesh = column(5, 0.001);
  ElementSet body = mesh.regions[0];
  ElementSet layer = body;
  layer.group = "layer";
  const auto nodes = static_cast<std::ptrdiff_t>(8 * across * across);
  const auto tags = static_cast<std::ptrdiff_t>(across * across);
  layer.tags.assign(body.tags.begin() + 5 * tags, body.tags.begin() + 6 * tags);
  layer.connectivity.assign(body.connectivity.begin() + 5 * nodes,
                            body.connectivity.begin() + 6 * nodes);
  body.tags.erase(body.tags.begin() + 5 * tags, body.tags.begin() + 6 * tags);
  body.connectivity.erase(body.connectivity.begin() + 5 * nodes,
                          body.connectivity.begin() + 6 * nodes);
  mesh.regions = {body, layer};
  Structure structure = concrete();
  structure.regions.push_back(structure.regions[0]);
  structure.regions[1].group = "layer";
  EXPECT_TRUE(build_system(mesh, structure).system.slivers.empty());
  EXPECT_EQ(build_system(column(5, 0.001), concrete()).system.slivers.size(), 1u);
}

}  // namespace slivers_test
}  // namespace pounding
