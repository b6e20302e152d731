#include "mesh/raw_mesh.h"

#include <gtest/gtest.h>

#include "common/error.h"
#include "mesh/element_checks.h"
#include "mesh/unused_elements.h"
#include "support/box_mesh.h"

namespace pounding {
namespace raw_mesh_test {

RawAnswer sample() {
  RawAnswer answer;
  answer.error = "";
  answer.mesh.node_tags = {3, 5};
  answer.mesh.coordinates = {0, 1, 2, 3, 4, 5};
  answer.mesh.entities = {{1, 7, true, {{1, {11}, {3, 5}}}}, {2, 8, false, {}}};
  answer.mesh.groups = {{"column", 1, {7}}};
  answer.mesh.types = {{1, 2, "Line 2"}};
  return answer;
}

std::vector<char> to_bytes(const RawAnswer& answer) {
  std::vector<char> bytes;
  write_answer(answer, [&](std::span<const char> piece) {
    bytes.insert(bytes.end(), piece.begin(), piece.end());
  });
  return bytes;
}

/// What can be read of bytes that are followed by zeros, if `most` lets it.
RawAnswer from_bytes(std::span<const char> bytes, std::size_t most) {
  std::size_t at = 0;
  const auto read = [&](std::span<char> piece) {
    for (char& byte : piece) byte = at < bytes.size() ? bytes[at++] : '\0';
  };
  return read_answer(read, most);
}

TEST(RawMesh, ComesBackFromItsBytes) {
  const std::vector<char> bytes = to_bytes(sample());
  const RawAnswer answer = from_bytes(bytes, bytes.size());
  EXPECT_EQ(answer.mesh.node_tags, sample().mesh.node_tags);
  EXPECT_EQ(answer.mesh.coordinates, sample().mesh.coordinates);
  ASSERT_EQ(answer.mesh.entities.size(), 2U);
  EXPECT_TRUE(answer.mesh.entities[0].bounds_another);
  EXPECT_EQ(answer.mesh.entities[0].elements[0].nodes, (std::vector<std::int64_t>{3, 5}));
  EXPECT_EQ(answer.mesh.groups[0].name, "column");
  EXPECT_EQ(answer.mesh.groups[0].entities, std::vector<int>{7});
  EXPECT_EQ(answer.mesh.types[0].name, "Line 2");
  EXPECT_EQ(to_bytes(answer), bytes);
}

TEST(RawMesh, EveryCutIsRefused) {
  const std::vector<char> bytes = to_bytes(sample());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::span<const char> cut = std::span(bytes).first(size);
    EXPECT_THROW(from_bytes(cut, size), std::runtime_error) << size;
    EXPECT_THROW(from_bytes(cut, 2 * bytes.size()), std::runtime_error) << size;
  }
}

/// A brick with a group on one of its faces, and lines: along an edge, and across.
RawMesh raw_box(const GlobalMesh& mesh) {
  RawMesh raw;
  raw.node_tags = mesh.node_tags;
  raw.coordinates = mesh.coordinates;
  raw.types = {{1, 2, "Line 2"}, {3, 4, "Quadrangle 4"}, {5, 8, "Hexahedron 8"}};
  raw.entities = {{3, 1, false, {{5, {1}, {1, 2, 4, 3, 5, 6, 8, 7}}}},
                  {2, 1, true, {{3, {10}, {3, 4, 2, 1}}}},
                  {1, 1, false, {{1, {20}, {1, 2}}}},
                  {1, 2, false, {{1, {21}, {1, 8}}}},
                  {1, 3, true, {{1, {22}, {3, 4}}}}};
  raw.groups = {{"body", 3, {1}}, {"z_min", 2, {1}}, {"edge", 1, {1}}};
  return raw;
}

TEST(UnusedElements, FacesArePlacesAndLinesAreLeftOut) {
  const GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  const std::vector<UnusedElements> unused = find_unused(raw_box(mesh), mesh, {{"body", 3}});
  ASSERT_EQ(unused.size(), 3U);
  EXPECT_EQ(unused[0].group, "");
  EXPECT_EQ(unused[0].left_out, 1);
  EXPECT_EQ(unused[0].place, (Vector3{0.5, 0.5, 0.5}));
  EXPECT_EQ(unused[1].group, "edge");
  EXPECT_EQ(unused[1].left_out, 1);
  EXPECT_EQ(unused[2].group, "z_min");
  EXPECT_EQ(unused[2].count, 1);
  EXPECT_EQ(unused[2].left_out, 0);
}

TEST(RepeatedElements, AreRefusedInSolidsOfTwoGroups) {
  GlobalMesh mesh = testing_support::box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  EXPECT_NO_THROW(check_repeated_elements("s", mesh));
  ElementSet again = mesh.regions[0];
  again.group = "again";
  again.tags = {99};
  std::swap(again.connectivity[0], again.connectivity[5]);
  mesh.regions.push_back(again);
  EXPECT_THROW(check_repeated_elements("s", mesh), UserError);
}

/// Two faces on a surface, in groups of given entities, with the second face again as told.
RawMesh faces(const std::vector<std::vector<int>>& entities,
              const std::vector<std::vector<std::int64_t>>& again) {
  RawMesh mesh;
  RawElements elements{3, {1, 2}, {1, 2, 3, 4, 2, 5, 6, 3}};
  for (const std::vector<std::int64_t>& nodes : again) {
    elements.tags.push_back(static_cast<std::int64_t>(elements.tags.size()) + 1);
    elements.nodes.insert(elements.nodes.end(), nodes.begin(), nodes.end());
  }
  mesh.entities = {{2, 8, false, {elements}}};
  for (const std::vector<int>& of : entities) mesh.groups.push_back({"g", 2, of});
  return mesh;
}

std::vector<std::int64_t> tags_left(RawMesh mesh) {
  merge_shared_elements(mesh);
  const RawElements& left = mesh.entities[0].elements[0];
  EXPECT_EQ(left.nodes.size(), 4 * left.tags.size());
  return left.tags;
}

TEST(SharedElements, AreOneHoweverOftenTheirGroupsWriteThem) {
  using Tags = std::vector<std::int64_t>;
  const std::vector<std::int64_t> same{2, 5, 6, 3};
  EXPECT_EQ(tags_left(faces({{8}, {8}}, {same})), (Tags{1, 2}));
  EXPECT_EQ(tags_left(faces({{8}, {8}}, {{3, 6, 5, 2}})), (Tags{1, 2}));
  EXPECT_EQ(tags_left(faces({{8}, {8, 9}, {8}}, {same, same})), (Tags{1, 2}));
  // More than one per group, or another face, is no copy of a group.
  EXPECT_EQ(tags_left(faces({{8}, {8}}, {same, same})), (Tags{1, 2, 4}));
  EXPECT_EQ(tags_left(faces({{8}, {9}}, {same})), (Tags{1, 2, 3}));
  EXPECT_EQ(tags_left(faces({{8}, {8}}, {{5, 7, 8, 6}})), (Tags{1, 2, 3}));
}

TEST(RepeatedFacets, LeaveTheFirst) {
  std::vector<Facet> facets{{{4, 5, 6, -1}, 3},
                            {{1, 2, 3, 0}, 4},
                            {{0, 1, 2, 3}, 4},
                            {{5, 4, -1, -1}, 2},
                            {{4, 5, -1, -1}, 2}};
  drop_repeated_facets(facets);
  ASSERT_EQ(facets.size(), 3U);
  EXPECT_EQ(facets[0].count, 3);
  EXPECT_EQ(facets[1].nodes, (std::array<GlobalIndex, 4>{1, 2, 3, 0}));
  EXPECT_EQ(facets[2].nodes[0], 5);
}

}  // namespace raw_mesh_test
}  // namespace pounding
