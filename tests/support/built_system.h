#pragma once

#include "common/parallel.h"
#include "mesh/mesh.h"
#include "system/finite_element_system.h"

namespace pounding::testing {

struct BuiltSystem {
  Mesh mesh;
  LinearSystem system;
};

/// Partitions and assembles one structure over all ranks, as the program does. Collective.
inline BuiltSystem build_system(const GlobalMesh& global, const Structure& structure) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  Partition partition;
  if (rank_of(comm) == 0) {
    partition = partition_meshes({&global, 1}, {}, size_of(comm));
  }
  BuiltSystem built{distribute_mesh(comm, structure.name, global, partition, 0), {}};
  built.system = build_finite_element_system(structure, built.mesh);
  return built;
}

}  // namespace pounding::testing
