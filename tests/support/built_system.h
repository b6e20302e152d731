#pragma once

#include "common/parallel.h"
#include "mesh/mesh.h"
#include "system/finite_element_system.h"
#include "system/mass_scaling.h"

namespace pounding::testing_support {

struct BuiltSystem {
  Mesh mesh;
  LinearSystem system;
};

/// Assembles one structure over all ranks of a communicator. Collective.
inline BuiltSystem build_system(MPI_Comm comm, const GlobalMesh& global, const Structure& structure,
                                const Partition& partition) {
  BuiltSystem built{distribute_mesh(comm, structure.name, global, partition, 0), {}};
  built.system = pounding::build_system(structure, built.mesh);
  return built;
}

/// Partitions and assembles one structure over all ranks, as the program does. Collective.
inline BuiltSystem build_system(const GlobalMesh& global, const Structure& structure) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  Partition partition;
  if (rank_of(comm) == 0) {
    partition =
        partition_meshes({&global, 1}, {}, size_of(comm), {}, coupled_nodes(structure, global, 0));
  }
  return build_system(comm, global, structure, partition);
}

}  // namespace pounding::testing_support
