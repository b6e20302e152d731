#include "mesh/connectivity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "mesh/facet_point.h"
#include "support/box_mesh.h"

namespace pounding {
namespace connectivity_test {

using testing_support::box_mesh;

/// Adds nodes at some points, with the components of a mask, all free.
GlobalIndex add_nodes(GlobalMesh& mesh, const std::vector<Vector3>& points, std::uint8_t mask) {
  const GlobalIndex first = mesh.node_count();
  for (const Vector3& point : points) {
    mesh.node_tags.push_back(mesh.node_count() + 1);
    mesh.coordinates.insert(mesh.coordinates.end(), point.begin(), point.end());
    mesh.components.push_back(mask);
    mesh.free_components.push_back(mask);
  }
  return first;
}

void add_elements(GlobalMesh& mesh, ElementType type, const std::vector<GlobalIndex>& nodes,
                  std::size_t width) {
  ElementSet set;
  set.group = "more";
  set.type = type;
  set.connectivity = nodes;
  for (std::size_t e = 0; e < nodes.size() / width; ++e) {
    set.tags.push_back(static_cast<std::int64_t>(1000 + e));
  }
  mesh.regions.push_back(set);
}

Structure structure_of(const GlobalMesh& mesh) {
  Structure structure;
  structure.name = "s";
  structure.regions.resize(mesh.regions.size());
  return structure;
}

/// Two bricks of a unit cube each, one on the other, and the mask of every node free.
GlobalMesh tower() {
  GlobalMesh mesh = box_mesh({0, 0, 0}, {1, 1, 2}, {1, 1, 2});
  mesh.components.assign(mesh.node_tags.size(), 0x07);
  mesh.free_components = mesh.components;
  return mesh;
}

TEST(Connectivity, OnePieceIsHeldByOneClampedComponent) {
  GlobalMesh mesh = tower();
  EXPECT_EQ(examine_connectivity(structure_of(mesh), mesh).loose_pieces(), 1);
  mesh.free_components[0] = 0x03;
  const Connectivity found = examine_connectivity(structure_of(mesh), mesh);
  ASSERT_EQ(found.pieces.size(), 1U);
  EXPECT_EQ(found.pieces[0].nodes, 12);
  EXPECT_EQ(found.loose_pieces(), 0);
  EXPECT_EQ(found.pieces[0].rigid_motions, 6);
  EXPECT_EQ(found.pieces[0].held_motions, 1);
  EXPECT_FALSE(found.wholly_held());
  mesh.free_components[0] = mesh.free_components[1] = mesh.free_components[2] = 0;
  EXPECT_TRUE(examine_connectivity(structure_of(mesh), mesh).wholly_held());
}

TEST(Connectivity, GroundedSpringsHoldAndSpringsJoin) {
  GlobalMesh mesh = tower();
  const GlobalIndex node = add_nodes(mesh, {{5, 0, 0}}, 0x07);
  add_elements(mesh, ElementType::grounded_spring, {node}, 1);
  mesh.regions.back().region = 1;
  Structure structure = structure_of(mesh);
  structure.regions[1].stiffness = {1, 0, 0, 0, 0, 0};
  Connectivity found = examine_connectivity(structure, mesh);
  EXPECT_EQ(found.pieces.size(), 2U);
  EXPECT_EQ(found.loose_pieces(), 1);
  EXPECT_EQ(found.loose_piece().nodes, 12);
  add_elements(mesh, ElementType::spring, {node, 0}, 2);
  found = examine_connectivity(structure, mesh);
  EXPECT_EQ(found.pieces.size(), 1U);
  EXPECT_EQ(found.loose_pieces(), 0);
}

TEST(Connectivity, CoincidentNodesAreCountedUnlessALineJoinsThem) {
  GlobalMesh mesh = tower();
  const GlobalIndex first = add_nodes(mesh, {{1, 1, 2 + 1e-7}, {1, 1, 4}}, 0x3f);
  add_elements(mesh, ElementType::beam, {first, first + 1}, 2);
  Connectivity found = examine_connectivity(structure_of(mesh), mesh);
  EXPECT_EQ(found.coincident_apart.count, 1);
  EXPECT_EQ(found.coincident_apart.first, (Vector3{1, 1, 2}));
  add_elements(mesh, ElementType::bar, {first + 1, 0}, 2);
  found = examine_connectivity(structure_of(mesh), mesh);
  EXPECT_EQ(found.coincident_apart.count, 0);
  EXPECT_EQ(found.coincident_inside.count, 1);
  add_elements(mesh, ElementType::spring, {first, 11}, 2);
  EXPECT_EQ(examine_connectivity(structure_of(mesh), mesh).coincident_inside.count, 0);
}

TEST(Connectivity, EndOfALineInAFace) {
  GlobalMesh mesh = tower();
  const GlobalIndex first = add_nodes(mesh, {{0.3, 0.6, 2}, {0.3, 0.6, 4}}, 0x3f);
  add_elements(mesh, ElementType::beam, {first, first + 1}, 2);
  const Connectivity found = examine_connectivity(structure_of(mesh), mesh);
  EXPECT_EQ(found.ends_inside.count, 1);
  EXPECT_EQ(found.ends_inside.first, (Vector3{0.3, 0.6, 2}));
  mesh.free_components[static_cast<std::size_t>(first)] = 0;
  EXPECT_EQ(examine_connectivity(structure_of(mesh), mesh).ends_inside.count, 0);
}

TEST(Connectivity, BeamsAtNodesOfSolidsTurnFreely) {
  GlobalMesh mesh = tower();
  const GlobalIndex first = add_nodes(mesh, {{1, 1, 4}, {3, 1, 2}}, 0x3f);
  mesh.components[11] = mesh.free_components[11] = 0x3f;
  add_elements(mesh, ElementType::beam, {first, 11}, 2);
  Connectivity found = examine_connectivity(structure_of(mesh), mesh);
  EXPECT_EQ(found.hinges.count, 1);
  EXPECT_EQ(found.lone_hinges.count, 1);
  add_elements(mesh, ElementType::beam, {11, first + 1}, 2);
  found = examine_connectivity(structure_of(mesh), mesh);
  EXPECT_EQ(found.hinges.count, 1);
  EXPECT_EQ(found.lone_hinges.count, 0);
  mesh.free_components[11] = 0x07;
  EXPECT_EQ(examine_connectivity(structure_of(mesh), mesh).hinges.count, 0);
}

TEST(NearNodes, AreThoseOfAllPairs) {
  GlobalMesh mesh;
  std::vector<Vector3> points;
  std::uint32_t state = 1;
  const auto random = [&state] {
    state = state * 1664525U + 1013904223U;
    return static_cast<double>(state >> 8) / static_cast<double>(1U << 24);
  };
  for (int i = 0; i < 400; ++i) {
    points.push_back({random(), random() - 0.5, -random()});
  }
  add_nodes(mesh, points, 0x07);
  for (const double distance : {0.03, 0.05, 0.2}) {
    std::vector<std::pair<GlobalIndex, GlobalIndex>> expected;
    for (GlobalIndex a = 0; a < mesh.node_count(); ++a) {
      for (GlobalIndex b = a + 1; b < mesh.node_count(); ++b) {
        const Vector3 x = mesh.position(a);
        const Vector3 y = mesh.position(b);
        if (std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]) <= distance) {
          expected.emplace_back(a, b);
        }
      }
    }
    EXPECT_EQ(near_nodes(mesh, distance), expected) << distance;
    EXPECT_FALSE(expected.empty());
  }
}

TEST(PointInElement, LinesShellsAndHexahedra) {
  const std::vector<Vector3> line{{0, 0, 0}, {2, 0, 0}};
  EXPECT_TRUE(is_in_element(ElementType::beam, line, {1, 0.009, 0}, 0.01));
  EXPECT_FALSE(is_in_element(ElementType::beam, line, {1, 0.011, 0}, 0.01));
  EXPECT_FALSE(is_in_element(ElementType::beam, line, {2.02, 0, 0}, 0.01));
  const std::vector<Vector3> shell{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_TRUE(is_in_element(ElementType::shell4, shell, {0.2, 0.7, 0.05}, 0.1));
  EXPECT_FALSE(is_in_element(ElementType::shell4, shell, {0.2, 0.7, 0.15}, 0.1));
  EXPECT_FALSE(is_in_element(ElementType::shell4, shell, {1.2, 0.7, 0}, 0.1));
  const std::vector<Vector3> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_TRUE(is_in_element(ElementType::shell3, triangle, {0.2, 0.2, 0}, 0.01));
  EXPECT_FALSE(is_in_element(ElementType::shell3, triangle, {0.7, 0.7, 0}, 0.01));
  const std::vector<Vector3> brick{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
  EXPECT_TRUE(is_in_element(ElementType::hex8, brick, {0.5, 0.5, 1.9}, 0.01));
  EXPECT_FALSE(is_in_element(ElementType::hex8, brick, {0.5, 0.5, 2.1}, 0.01));
  EXPECT_FALSE(is_in_element(ElementType::hex8, brick, {-0.1, 0.5, 1}, 0.01));
}

}  // namespace connectivity_test
}  // namespace pounding
