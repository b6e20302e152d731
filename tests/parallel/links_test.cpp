#include "system/links.h"

#include <gtest/gtest.h>

#include "common/parallel.h"
#include "common/petsc.h"
#include "support/built_system.h"
#include "system/trace.h"

namespace pounding {
namespace links_test {

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

Structure ties() {
  Structure structure;
  structure.name = "chain";
  Region region;
  region.group = "ties";
  region.element = ElementType::tension_bar;
  region.material = {"steel", 200, 0.3, 1};
  region.area = 0.5;
  structure.regions.push_back(region);
  return structure;
}

TEST(Links, ThatShareNodesLiveOnOneRank) {
  constexpr int cells = 9;
  const auto built = testing_support::build_system(chain(cells), ties());
  ASSERT_TRUE(built.system.links);
  const auto here = static_cast<int>(built.system.links->links().size());
  EXPECT_TRUE(here == 0 || here == cells);
  int all = here;
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_SUM, PETSC_COMM_WORLD);
  EXPECT_EQ(all, cells);
}

TEST(Links, MeasureElongationsAlongTheirAxes) {
  const auto built = testing_support::build_system(chain(4), ties());
  const Links& bars = *built.system.links;
  const Mesh& mesh = built.mesh;
  std::vector<double> w(static_cast<std::size_t>(mesh.owned_dofs), 0.0);
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    const GlobalIndex number = mesh.file_node[static_cast<std::size_t>(node)];
    w[static_cast<std::size_t>(mesh.dof(node, 0))] = 0.01 * static_cast<double>(number * number);
    w[static_cast<std::size_t>(mesh.dof(node, 1))] = 5;
  }
  std::vector<double> field(bars.trace().known().size());
  bars.trace().apply(w.data(), field.data(), 1);
  for (std::size_t b = 0; b < bars.links().size(); ++b) {
    const Link& bar = bars.links()[b];
    double elongation = 0;
    for (std::size_t i = 0; i < bar.point.size(); ++i) {
      if (bar.point[i] >= 0) elongation += bar.weight[i] * field[bar.point[i]];
    }
    EXPECT_NEAR(elongation, 0.01 * (2 * static_cast<double>(b) + 1), 1e-14);
    EXPECT_DOUBLE_EQ(bar.origin.length, 1);
  }
}

TEST(Links, AreNotMadeForAStructureWithoutThem) {
  GlobalMesh global = chain(3);
  global.regions[0].type = ElementType::bar;
  Structure structure;
  structure.regions.emplace_back();
  Partition partition;
  if (rank_of(PETSC_COMM_WORLD) == 0) {
    partition = partition_meshes({&global, 1}, {}, size_of(PETSC_COMM_WORLD));
  }
  const Mesh mesh = distribute_mesh(PETSC_COMM_WORLD, "chain", global, partition, 0);
  EXPECT_FALSE(Links::build(structure, mesh));
}

}  // namespace links_test
}  // namespace pounding
