#include "support/partition_loads.h"

#include <gtest/gtest.h>
#include <petscsys.h>

#include "common/parallel.h"
#include "mesh/halo.h"
#include "mesh/mesh.h"
#include "support/box_mesh.h"

namespace pounding {
namespace partition_loads_test {

/// The loads that run/scaling models parts by are those of the ranks when they are there.
TEST(PartitionLoads, AreThoseOfTheRanks) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  GlobalMesh whole = testing_support::box_mesh({0, 0, 0}, {4, 3, 2}, {8, 6, 4});
  whole.components.assign(whole.node_tags.size(), 0x07);
  whole.free_components = whole.components;
  for (const GlobalIndex node : whole.groups.at("z_min").nodes) whole.free_components[node] = 0;
  const Partition partition = partition_meshes({&whole, 1}, {}, size_of(comm));
  const testing_support::PartLoad load =
      testing_support::part_loads({&whole, 1}, partition)[rank_of(comm)];
  const Mesh mesh = distribute_mesh(comm, "block", whole, partition, 0);
  EXPECT_EQ(load.dofs, mesh.owned_dofs);
  std::int64_t held = 0;
  for (const ElementBlock& block : mesh.blocks) held += static_cast<std::int64_t>(block.count());
  EXPECT_EQ(load.elements, held);
  std::vector<GlobalIndex> ghosts;
  for (LocalIndex node = mesh.owned_nodes; node < mesh.node_count(); ++node) {
    for (int component = 0; component < 6; ++component) {
      if (mesh.dof(node, component) >= 0) ghosts.push_back(mesh.dof_global(node, component));
    }
  }
  EXPECT_EQ(load.received, static_cast<std::int64_t>(ghosts.size()));
  const Halo halo(comm, mesh.first_owned_dof, mesh.owned_dofs, ghosts);
  EXPECT_EQ(load.neighbours, halo.neighbour_count());
  std::int64_t balance = load.sent - load.received;
  MPI_Allreduce(MPI_IN_PLACE, &balance, 1, MPI_INT64_T, MPI_SUM, comm);
  EXPECT_EQ(balance, 0);
  EXPECT_EQ(size_of(comm) > 1, load.messages > 0);
}

}  // namespace partition_loads_test
}  // namespace pounding
