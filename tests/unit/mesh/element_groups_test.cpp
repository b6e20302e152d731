#include "mesh/element_groups.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "mesh/partition.h"
#include "support/box_mesh.h"

namespace pounding {
namespace element_groups_test {

using Cells = std::array<int, 3>;

/// Cubes of 1 m, numbered along x, then y, then z.
std::vector<GlobalMesh> cubes(const Cells& cells) {
  return {testing_support::box_mesh({0, 0, 0}, {1.0 * cells[0], 1.0 * cells[1], 1.0 * cells[2]},
                                    cells)};
}

TEST(NodePlanes, LayersAcrossTheLongestExtentRowsAlongTheSecondLongest) {
  const std::vector<GlobalMesh> meshes = cubes({4, 7, 2});
  const NodePlanes planes(meshes[0]);
  const auto origin = planes.place({0, 0, 0});
  EXPECT_LT(planes.place({4, 0, 2}), planes.place({0, 1, 0}));  // y: layers
  EXPECT_LT(planes.place({4, 0, 1}), planes.place({0, 0, 2}));  // z: rows in a layer
  EXPECT_LT(origin, planes.place({1, 0, 0}));
  EXPECT_EQ(origin, planes.place({1e-9, -1e-9, 1e-9}));
}

TEST(NodePlanes, AStructureOfOnePointHasOnePlace) {
  GlobalMesh point;
  point.coordinates = {1, 2, 3};
  point.node_tags = {1};
  EXPECT_EQ(NodePlanes(point).place({1, 2, 3}), (std::array<std::int64_t, 3>{}));
}

/// Elements per group; alone: -1.
std::map<int, int> sizes_of(const ElementGroups& groups) {
  std::map<int, int> sizes;
  for (const int group : groups.of) ++sizes[group];
  return sizes;
}

TEST(ElementGroups, RowsArePartedIntoEqualPieces) {
  const std::vector<GlobalMesh> meshes = cubes({7, 12, 3});  // 36 rows of 7
  const ElementList list = list_elements(meshes, {});
  const idx_t cost = list.cost[0];
  struct Expected {
    idx_t most;  ///< elements of a piece
    int groups;
    std::set<int> sizes;
  };
  for (const auto& [most, count, sizes] :
       {Expected{7, 36, {7}}, Expected{100, 36, {7}}, Expected{6, 72, {3, 4}},
        Expected{3, 108, {2, 3}}, Expected{1, 0, {252}}, Expected{0, 0, {252}}}) {
    const ElementGroups groups = group_rows(meshes, list, most * cost);
    EXPECT_EQ(groups.count, count) << most;
    for (const auto& [group, size] : sizes_of(groups)) {
      EXPECT_EQ(group < 0, count == 0);
      EXPECT_TRUE(sizes.contains(size)) << most;
    }
    for (std::size_t e = 1; e < groups.of.size() && most >= 7; ++e) {
      EXPECT_EQ(groups.of[e] == groups.of[e - 1], e % 7 != 0) << e;
    }
  }
}

TEST(ElementGroups, AMergedListHoldsEveryNodeAndCostOnce) {
  const std::vector<GlobalMesh> meshes = cubes({5, 6, 1});
  const ElementList list = list_elements(meshes, {});
  const ElementList merged = merge_groups(list, group_rows(meshes, list, 5 * list.cost[0]));
  ASSERT_EQ(merged.count(), 6);
  for (std::size_t row = 0; row < 6; ++row) {
    EXPECT_EQ(merged.nodes_of(row).size(), 24U);
    EXPECT_EQ(merged.cost[row], 5 * list.cost[0]);
  }
  for (std::size_t e = 0; e < 30; ++e) EXPECT_EQ(merged.entry[e], static_cast<idx_t>(e / 5));
}

TEST(ElementGroups, ClustersStayBesideRows) {
  std::vector<GlobalMesh> meshes = cubes({3, 4, 1});
  ElementSet beams;
  beams.type = ElementType::beam;
  beams.tags = {101, 102};
  beams.connectivity = {0, 1, 1, 2};
  meshes[0].regions.push_back(beams);
  const ElementList list = list_elements(meshes, {});
  ElementGroups groups = group_rows(meshes, list, 3 * list.cost[0]);
  const std::vector<NodeCluster> clusters{{0, {0, 1}}};
  group_clusters(list, clusters, groups);
  EXPECT_EQ(groups.first_cluster, 4);
  EXPECT_EQ(groups.of[12], 4);   // inside the cluster
  EXPECT_EQ(groups.of[13], -1);  // half inside
  EXPECT_EQ(merge_groups(list, groups).count(), 6);
}

TEST(Partition, RowsStayWholeAndPartsEven) {
  const Cells cells{24, 30, 20};
  const std::vector<GlobalMesh> meshes = cubes(cells);
  for (const int parts : {2, 3, 4}) {
    const Partition partition = partition_meshes(meshes, {}, parts);
    EXPECT_LT(partition.imbalance, 1.02) << parts;
    for (std::size_t e = 1; e < partition.element_owner[0].size(); ++e) {
      if (e % 24 != 0) {
        ASSERT_EQ(partition.element_owner[0][e], partition.element_owner[0][e - 1]);
      }
    }
    const std::set<int> owners(partition.element_owner[0].begin(),
                               partition.element_owner[0].end());
    EXPECT_EQ(static_cast<int>(owners.size()), parts);
  }
}

}  // namespace element_groups_test
}  // namespace pounding
