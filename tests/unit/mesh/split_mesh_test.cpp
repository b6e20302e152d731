#include "mesh/split_mesh.h"

#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "common/matrix3.h"

namespace pounding {
namespace split_mesh_test {

Vector3 position(const RawMesh& mesh, std::int64_t node) {
  const auto place = std::ranges::find(mesh.node_tags, node) - mesh.node_tags.begin();
  const double* x = &mesh.coordinates[3 * static_cast<std::size_t>(place)];
  return {x[0], x[1], x[2]};
}

Vector3 edge(const RawMesh& mesh, const std::int64_t* nodes, int from, int to) {
  return minus(position(mesh, nodes[to]), position(mesh, nodes[from]));
}

/// One cell of a Gmsh type on the corners of a sheared box.
RawMesh cell(int type, const std::vector<Vector3>& corners) {
  RawMesh mesh;
  RawElements elements{type, {9}, {}};
  for (const Vector3& x : corners) {
    mesh.node_tags.push_back(static_cast<std::int64_t>(10 + 3 * mesh.node_tags.size()));
    elements.nodes.push_back(mesh.node_tags.back());
    mesh.coordinates.insert(mesh.coordinates.end(), {x[0] + 0.3 * x[2], 2 * x[1], x[2]});
  }
  mesh.entities = {{type > 3 ? 3 : type == 1 ? 1 : 2, 1, false, {elements}}};
  return mesh;
}

/// Volumes of the children by three edges at their first corner: those of like cells are equal.
void expect_equal_children(int type, const std::vector<Vector3>& corners, std::array<int, 3> ends,
                           std::size_t children, std::size_t nodes) {
  RawMesh mesh = cell(type, corners);
  const auto volume = [&](const std::int64_t* child) {
    return dot(cross(edge(mesh, child, 0, ends[0]), edge(mesh, child, 0, ends[1])),
               edge(mesh, child, 0, ends[2]));
  };
  const std::vector<std::int64_t> whole = mesh.entities[0].elements[0].nodes;
  const double parent = volume(whole.data());
  split_mesh({}, mesh);
  const RawElements& split = mesh.entities[0].elements[0];
  ASSERT_EQ(split.tags.size(), children);
  EXPECT_EQ(split.tags[0], 9);
  EXPECT_EQ(mesh.node_tags.size(), nodes);
  const std::size_t width = corners.size();
  for (std::size_t e = 0; e < children; ++e) {
    EXPECT_NEAR(volume(&split.nodes[e * width]), parent / 8, 1e-12) << type << " " << e;
  }
}

TEST(SplitMesh, PartsSolidsIntoEightOfTheirOrientation) {
  const std::vector<Vector3> box{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  expect_equal_children(5, box, {1, 3, 4}, 8, 27);
  expect_equal_children(6, {box[0], box[1], box[3], box[4], box[5], box[7]}, {1, 2, 3}, 8, 18);
  expect_equal_children(4, {box[0], box[1], box[3], box[4]}, {1, 2, 3}, 8, 10);
}

TEST(SplitMesh, PartsSurfacesAlongTheirFirstEdge) {
  for (const int type : {2, 3}) {
    std::vector<Vector3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    if (type == 2) corners.pop_back();
    RawMesh mesh = cell(type, corners);
    split_mesh({}, mesh);
    const RawElements& split = mesh.entities[0].elements[0];
    ASSERT_EQ(split.tags.size(), 4U);
    const std::size_t width = corners.size();
    for (std::size_t e = 0; e < 4; ++e) {
      const std::int64_t* child = &split.nodes[e * width];
      const Vector3 first = edge(mesh, child, 0, 1);
      EXPECT_NEAR(std::abs(first[0]), 0.5, 1e-15);
      EXPECT_NEAR(first[1], 0, 1e-15);
      EXPECT_GT(cross(first, edge(mesh, child, 0, static_cast<int>(width) - 1))[2], 0);
    }
  }
}

/// Two lines on one another beside two bars, points at all nodes.
RawMesh chain() {
  RawMesh mesh;
  mesh.node_tags = {1, 2, 3};
  mesh.coordinates = {0, 0, 0, 0, 0, 1, 0, 0, 3};
  mesh.entities = {{0, 1, true, {{15, {1, 2}, {1, 2}}}},
                   {1, 1, false, {{1, {3, 4}, {1, 2, 2, 3}}}},
                   {1, 2, false, {{1, {5}, {1, 3}}}}};
  mesh.groups = {{"held", 0, {1}}, {"masses", 0, {1}}, {"column", 1, {1}}, {"tie", 1, {2}}};
  return mesh;
}

TEST(SplitMesh, BarsStayWholeAndPointsBetweenPointsAreOfTheirGroup) {
  Structure structure;
  for (const auto& [group, element] :
       {std::pair{"column", ElementType::beam}, std::pair{"tie", ElementType::bar},
        std::pair{"masses", ElementType::point_mass}}) {
    structure.regions.emplace_back().group = group;
    structure.regions.back().element = element;
  }
  RawMesh mesh = chain();
  split_mesh(structure, mesh);
  EXPECT_EQ(mesh.entities[1].elements[0].nodes,
            (std::vector<std::int64_t>{1, 4, 4, 2, 2, 5, 5, 3}));
  EXPECT_EQ(mesh.entities[2].elements[0].nodes, (std::vector<std::int64_t>{1, 3}));
  ASSERT_EQ(mesh.entities.size(), 4U);
  EXPECT_EQ(mesh.entities[3].elements[0].nodes, (std::vector<std::int64_t>{4}));
  EXPECT_EQ(mesh.groups[0].entities.size(), 2U);
  EXPECT_EQ(mesh.groups[1].entities.size(), 1U);
  EXPECT_NEAR(mesh.coordinates.back(), 2, 1e-15);
}

}  // namespace split_mesh_test
}  // namespace pounding
