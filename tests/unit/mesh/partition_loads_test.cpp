#include "support/partition_loads.h"

#include <gtest/gtest.h>

#include "elements/element_traits.h"

namespace pounding {
namespace partition_loads_test {

using testing_support::part_loads;
using testing_support::PartLoad;

constexpr std::uint8_t translations = 0x07;

/// Bars in a line whose first node is held.
GlobalMesh bars(int count) {
  GlobalMesh mesh;
  ElementSet set{"bars", 0, ElementType::bar, {}, {}, {}};
  for (int e = 0; e < count; ++e) {
    set.tags.push_back(e + 1);
    set.connectivity.insert(set.connectivity.end(), {e, e + 1});
  }
  mesh.regions.push_back(set);
  mesh.free_components.assign(static_cast<std::size_t>(count) + 1, translations);
  mesh.free_components[0] = 0;
  for (int n = 0; n <= count; ++n) {
    mesh.node_tags.push_back(n + 1);
    mesh.coordinates.insert(mesh.coordinates.end(), {static_cast<double>(n), 0, 0});
  }
  return mesh;
}

TEST(PartitionLoads, CountElementsAtTheCutOnBothSides) {
  const std::vector meshes{bars(4)};
  Partition partition;
  partition.parts = 2;
  partition.node_owner = {{0, 0, 0, 1, 1}};
  const std::vector<PartLoad> loads = part_loads(meshes, partition);
  ASSERT_EQ(loads.size(), 2u);
  EXPECT_EQ(loads[0].elements, 3);
  EXPECT_EQ(loads[1].elements, 2);
  for (const PartLoad& load : loads) {
    EXPECT_EQ(load.dofs, 6);  // a node is held
    EXPECT_EQ(load.cost, load.elements * traits_of(ElementType::bar).cost);
    EXPECT_EQ(load.sent, 3);
    EXPECT_EQ(load.received, 3);
    EXPECT_EQ(load.messages, 1);
    EXPECT_EQ(load.neighbours, 1);
  }
}

TEST(PartitionLoads, ElementsThatYieldCostMore) {
  constexpr int yielding = 10;
  GlobalMesh mesh = bars(80);
  ElementSet& elastic = mesh.regions.front();
  ElementSet inelastic{"bars", 1, ElementType::bar, {}, {}, {}, true};
  inelastic.tags.assign(elastic.tags.begin(), elastic.tags.begin() + yielding);
  inelastic.connectivity.assign(elastic.connectivity.begin(),
                                elastic.connectivity.begin() + 2 * yielding);
  elastic.tags.erase(elastic.tags.begin(), elastic.tags.begin() + yielding);
  elastic.connectivity.erase(elastic.connectivity.begin(),
                             elastic.connectivity.begin() + 2 * yielding);
  mesh.regions.push_back(inelastic);
  const std::vector meshes{mesh};
  const std::vector<PartLoad> loads = part_loads(meshes, partition_meshes(meshes, {}, 2));
  const double all = static_cast<double>(loads[0].cost + loads[1].cost);
  EXPECT_GT(inelastic.cost(), 10 * mesh.regions.front().cost());
  for (const PartLoad& load : loads) EXPECT_LT(load.cost, 0.62 * all);
}

TEST(PartitionLoads, HeldNodesAreNotSent) {
  const std::vector meshes{bars(2)};
  Partition partition;
  partition.parts = 2;
  partition.node_owner = {{0, 1, 1}};
  const std::vector<PartLoad> loads = part_loads(meshes, partition);
  EXPECT_EQ(loads[0].dofs, 0);
  EXPECT_EQ(loads[0].received, 3);
  EXPECT_EQ(loads[0].sent, 0);
  EXPECT_EQ(loads[1].sent, 3);
  EXPECT_EQ(loads[1].received, 0);
  EXPECT_EQ(loads[0].messages, 0);
  EXPECT_EQ(loads[0].neighbours, 1);
}

TEST(PartitionLoads, StructuresExchangeApart) {
  const std::vector meshes{bars(3), bars(3)};
  Partition partition;
  partition.parts = 2;
  partition.node_owner = {{0, 0, 1, 1}, {0, 0, 1, 1}};
  const std::vector<PartLoad> loads = part_loads(meshes, partition);
  EXPECT_EQ(loads[0].messages, 2);
  EXPECT_EQ(loads[0].neighbours, 1);
  EXPECT_EQ(loads[0].sent, 6);
  EXPECT_EQ(loads[0].dofs, 6);
  EXPECT_EQ(loads[1].dofs, 12);
  EXPECT_EQ(loads[1].elements, 4);
}

}  // namespace partition_loads_test
}  // namespace pounding
