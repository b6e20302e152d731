#include "system/tension_bars.h"

#include <gtest/gtest.h>

#include "common/parallel.h"
#include "common/petsc.h"

namespace pounding {
namespace {

/// A chain of bars along x, one metre each, nodes 0 .. cells.
GlobalMesh chain(int cells) {
  GlobalMesh mesh;
  ElementSet set;
  set.group = "ties";
  set.type = ElementType::tension_bar;
  for (int i = 0; i <= cells; ++i) {
    mesh.node_tags.push_back(i + 1);
    mesh.coordinates.insert(mesh.coordinates.end(), {static_cast<double>(i), 0, 0});
    if (i < cells) {
      set.tags.push_back(i + 1);
      set.connectivity.insert(set.connectivity.end(), {i, i + 1});
    }
  }
  mesh.regions.push_back(std::move(set));
  mesh.components.assign(mesh.node_tags.size(), 0x07);
  mesh.free_components = mesh.components;
  return mesh;
}

TEST(TensionBars, PullWhenStretchedAndAreSlackWhenShortened) {
  constexpr int cells = 9;
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const GlobalMesh global = chain(cells);
  Structure structure;
  structure.name = "chain";
  Region region;
  region.group = "ties";
  region.element = ElementType::tension_bar;
  region.material = {"steel", 200, 0.3, 1};
  region.area = 0.5;
  structure.regions.push_back(region);
  Partition partition;
  if (rank_of(comm) == 0) {
    partition = partition_meshes({&global, 1}, {}, size_of(comm));
  }
  const Mesh mesh = distribute_mesh(comm, "chain", global, partition, 0);
  const auto bars = TensionBars::build(structure, mesh);
  ASSERT_TRUE(bars);
  EXPECT_EQ(bars->count(), cells);
  // Bar i is stretched by +0.01 if i is even, shortened if it is odd.
  std::vector<double> w(static_cast<std::size_t>(mesh.owned_dofs), 0.0);
  std::vector<double> force(w.size(), 0.0);
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    const GlobalIndex number = mesh.file_node[static_cast<std::size_t>(node)];
    w[static_cast<std::size_t>(mesh.dof(node, 0))] = number % 2 == 0 ? 0 : 0.01;
  }
  bars->add_force(w.data(), force.data());
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    const GlobalIndex number = mesh.file_node[static_cast<std::size_t>(node)];
    // 100 N/m x 0.01 m; the end of a chain of odd length hangs on a stretched bar too.
    const double expected = number % 2 == 0 ? -1.0 : 1.0;
    EXPECT_NEAR(force[static_cast<std::size_t>(mesh.dof(node, 0))], expected, 1e-12) << number;
    EXPECT_EQ(force[static_cast<std::size_t>(mesh.dof(node, 1))], 0);
  }
}

TEST(TensionBars, AreNotMadeForAStructureWithoutThem) {
  GlobalMesh global = chain(3);
  global.regions[0].type = ElementType::bar;
  Structure structure;
  structure.regions.emplace_back();
  Partition partition;
  if (rank_of(PETSC_COMM_WORLD) == 0) {
    partition = partition_meshes({&global, 1}, {}, size_of(PETSC_COMM_WORLD));
  }
  const Mesh mesh = distribute_mesh(PETSC_COMM_WORLD, "chain", global, partition, 0);
  EXPECT_FALSE(TensionBars::build(structure, mesh));
}

}  // namespace
}  // namespace pounding
