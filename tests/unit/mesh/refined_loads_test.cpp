#include "support/refined_loads.h"

#include <gtest/gtest.h>

namespace pounding {
namespace refined_loads_test {

using testing_support::PartLoad;
using testing_support::RefinedMesh;

/// A slab on two columns, held at their feet, of cubes of edge 1/k; two columns of 2 by 2 by 2,
/// and 6 by 2 by 1 on top of them.
GlobalMesh table(int k) {
  GlobalMesh mesh;
  ElementSet set;
  set.group = "body";
  std::map<std::array<int, 3>, GlobalIndex> numbers;
  const auto node = [&](int x, int y, int z) {
    const auto [found, fresh] = numbers.try_emplace({x, y, z}, mesh.node_count());
    if (fresh) {
      mesh.node_tags.push_back(mesh.node_count() + 1);
      for (const int c : {x, y, z}) mesh.coordinates.push_back(1.0 * c / k);
      mesh.free_components.push_back(z == 0 ? 0 : 0x07);
    }
    return found->second;
  };
  for (int z = 0; z < 3 * k; ++z) {
    for (int y = 0; y < 2 * k; ++y) {
      for (int x = 0; x < 6 * k; ++x) {
        if (z / k < 2 && x / k >= 2 && x / k < 4) continue;
        set.tags.push_back(static_cast<std::int64_t>(set.tags.size()) + 1);
        for (const int top : {z, z + 1}) {
          for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            set.connectivity.push_back(node(x + a, y + b, top));
          }
        }
      }
    }
  }
  mesh.components.assign(mesh.node_tags.size(), 0x07);
  mesh.regions.push_back(set);
  return mesh;
}

/// Place on the lattice of a node of the divided mesh, `at` counted in its edges.
int point(double at, int k) {
  const int edges = static_cast<int>(std::lround(at * k));
  return 2 * (edges / k) + (edges % k != 0 ? 1 : 0);
}

TEST(RefinedLoads, AreThoseOfTheDividedMesh) {
  const std::vector whole{table(1)};
  const Partition partition = partition_meshes(whole, {}, 5);
  for (const int k : {2, 3, 5}) {
    const std::vector<RefinedMesh> refined = testing_support::refined_meshes(whole, partition, k);
    const std::vector<PartLoad> loads = testing_support::refined_loads(refined, 5, 2);

    const std::vector divided{table(k)};
    Partition same;
    same.parts = 5;
    std::vector<int>& owner = same.node_owner.emplace_back();
    for (GlobalIndex n = 0; n < divided[0].node_count(); ++n) {
      const Vector3 x = divided[0].position(n);
      owner.push_back(refined[0].owner({point(x[0], k), point(x[1], k), point(x[2], k)}));
    }
    const std::vector<PartLoad> expected = testing_support::part_loads(divided, same, 2);
    std::int64_t away = 0;
    for (std::size_t part = 0; part < 5; ++part) {
      EXPECT_EQ(loads[part].dofs, expected[part].dofs) << k;
      EXPECT_EQ(loads[part].elements, expected[part].elements) << k;
      EXPECT_EQ(loads[part].inner, expected[part].inner) << k;
      EXPECT_EQ(loads[part].cost, expected[part].cost) << k;
      EXPECT_EQ(loads[part].sent, expected[part].sent) << k;
      EXPECT_EQ(loads[part].received, expected[part].received) << k;
      EXPECT_EQ(loads[part].messages, expected[part].messages) << k;
      EXPECT_EQ(loads[part].neighbours, expected[part].neighbours) << k;
      EXPECT_EQ(loads[part].sent_away, expected[part].sent_away) << k;
      EXPECT_EQ(loads[part].messages_away, expected[part].messages_away) << k;
      EXPECT_GT(loads[part].inner, 0) << k;
      away += loads[part].messages_away;
    }
    EXPECT_GT(away, 0) << k;
  }
}

TEST(RefinedLoads, CubesWithinAnotherAreOfItsPart) {
  const std::vector whole{table(1)};
  const Partition partition = partition_meshes(whole, {}, 3);
  const auto refined = testing_support::refined_meshes(whole, partition, 3);
  const ElementSet& cubes = whole[0].regions.front();
  for (std::size_t e = 0; e < cubes.tags.size(); ++e) {
    const RefinedMesh::Place& low = refined[0].place_of(cubes.nodes_of(e).front());
    EXPECT_EQ(refined[0].owner({low[0] + 1, low[1] + 1, low[2] + 1}),
              partition.element_owner[0][e]);
  }
}

}  // namespace refined_loads_test
}  // namespace pounding
