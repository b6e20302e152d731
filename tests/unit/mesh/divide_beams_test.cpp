#include "mesh/divide_beams.h"

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "common/error.h"
#include "common/matrix3.h"
#include "elements/beam2.h"
#include "mesh/element_properties.h"

namespace pounding {
namespace divide_beams_test {

Region column(int parts) {
  Region region;
  region.group = "column";
  region.element = ElementType::beam;
  region.material = {"steel", 200e9, 0.3, 7850};
  region.section = Section{"s", 54e-4, 2.5e-5, 8.9e-6, 3e-7, {1, 0, 0}, 3.4e-3, 1.1e-3};
  region.resolved_frequency = 2 * std::numbers::pi * 100;
  region.parts = parts;
  return region;
}

/// Two columns of 3 m and 1 m on one another, an edge of a triangle on the second; a curve that is
/// a spring as well.
RawMesh frame() {
  RawMesh mesh;
  mesh.node_tags = {7, 3, 12, 5};
  mesh.coordinates = {0, 0, 0, 0, 0, 3, 0, 0, 4, 1, 0, 3.5};
  mesh.entities = {{1, 1, false, {{1, {40}, {7, 3}}}},
                   {1, 2, true, {{1, {20}, {3, 12}}}},
                   {2, 1, false, {{2, {30}, {12, 5, 3}}}}};
  mesh.groups = {{"column", 1, {1, 2}}, {"all", 1, {1}}};
  return mesh;
}

Structure structure_of(const Region& region) {
  Structure structure;
  structure.name = "s";
  structure.regions = {region};
  return structure;
}

TEST(DivideBeams, CutsLinesIntoEqualPartsAndLeavesEdgesOfSurfaces) {
  RawMesh mesh = frame();
  const auto divided = divide_beams(structure_of(column(3)), mesh);
  ASSERT_EQ(divided.size(), 1U);
  EXPECT_EQ(divided[0].lines, 2);
  EXPECT_EQ(divided[0].beams, 4);
  EXPECT_EQ(divided[0].whole, 1);
  const RawElements& lines = mesh.entities[0].elements[0];
  EXPECT_EQ(lines.tags, (std::vector<std::int64_t>{40, 41, 42}));
  EXPECT_EQ(lines.nodes, (std::vector<std::int64_t>{7, 13, 13, 14, 14, 3}));
  EXPECT_EQ(mesh.node_tags, (std::vector<std::int64_t>{7, 3, 12, 5, 13, 14}));
  EXPECT_NEAR(mesh.coordinates[3 * 4 + 2], 1, 1e-15);
  EXPECT_NEAR(mesh.coordinates[3 * 5 + 2], 2, 1e-15);
  EXPECT_EQ(mesh.entities[1].elements[0].nodes, (std::vector<std::int64_t>{3, 12}));
}

TEST(DivideBeams, LeavesTheMeshAsItIsUnlessAsked) {
  RawMesh mesh = frame();
  EXPECT_TRUE(divide_beams(structure_of(column(1)), mesh).empty());
  EXPECT_EQ(mesh.node_tags.size(), 4U);
}

TEST(DivideBeams, LeavesLinesOfOtherRegions) {
  RawMesh mesh = frame();
  Structure structure = structure_of(column(3));
  Region spring;
  spring.group = "all";
  spring.element = ElementType::spring;
  structure.regions.push_back(spring);
  const auto divided = divide_beams(structure, mesh);
  EXPECT_EQ(divided[0].whole, 2);
  EXPECT_EQ(divided[0].beams, 2);
}

TEST(DivideBeams, AsManyAsHalfAWaveNeeds) {
  RawMesh mesh = frame();
  const Region region = column(0);
  const double half = half_wave(element_properties(region), region.resolved_frequency);
  const auto expected = static_cast<GlobalIndex>(std::ceil(4 * 3 / half));
  EXPECT_GT(expected, 2);
  EXPECT_EQ(divide_beams(structure_of(region), mesh)[0].beams, expected + 1);
  Region fine = column(0);
  fine.resolved_frequency *= 1e8;
  EXPECT_THROW(divide_beams(structure_of(fine), mesh), UserError);
}

/// Of a slender beam sqrt(2 pi / w) (E I / m)^1/4 / sqrt(2) times pi; of one that shears
/// pi / w (G A_s / m)^1/2 where bending is stiff.
TEST(DivideBeams, HalfAWaveHasItsLimits) {
  ElementProperties p = element_properties(column(0));
  const double mass = p.density * p.area;
  const double slow = 2 * std::numbers::pi * 0.01;
  const double slender =
      std::numbers::pi / std::sqrt(slow) * std::pow(p.young * p.inertia_z / mass, 0.25);
  EXPECT_NEAR(half_wave(p, slow) / slender, 1, 1e-3);
  p.inertia_y = p.inertia_z = 1e6;
  p.density = 0;
  p.added_mass = mass;
  const double shear = p.young / (2 * (1 + p.poisson)) * p.shear_area_z;
  const double fast = 2 * std::numbers::pi * 100;
  EXPECT_NEAR(half_wave(p, fast) / (std::numbers::pi / fast * std::sqrt(shear / mass)), 1, 1e-3);
}

}  // namespace divide_beams_test
}  // namespace pounding
