#pragma once

#include <span>
#include <vector>

#include <mpi.h>

#include "driver/model.h"
#include "interactions/pairing/find_interface.h"
#include "mesh/global_mesh.h"
#include "mesh/gmsh_reader.h"
#include "mesh/partition.h"
#include "scene/scene.h"

namespace pounding {

/// The meshes of a scene as rank 0 has them before they are cut, and findings in them beside the
/// model's own part.
struct WholeMeshes {
  std::vector<GlobalMesh> meshes;                  ///< per structure
  std::vector<MatPlace> mats;                      ///< likewise, of those on soil
  std::vector<interactions::GapShare> gap_shares;  ///< of the rows of the interface
};

/// Takes the mesh of a structure, the next of `reader`, lays its soil under the mat and finds its
/// nodes on absorbing faces, spread springs and supports. `comm`: for lines of progress, rank 0
/// alone calls. Serial. Throws UserError.
void read_whole_mesh(MPI_Comm comm, Scene& scene, std::size_t s, MeshReader& reader,
                     WholeMeshes& whole, Model& model);

/// The meshes of all structures, checked, with contacts, probes and forces found in them. Throws
/// UserError for faults of meshes. Rank 0.
WholeMeshes read_whole_meshes(MPI_Comm comm, Scene& scene, Model& model);

/// Per structure the one of `ranks` ranks that has all generalised coordinates of a reduced one,
/// else -1. No rank takes more than it must; neighbours in the scene's list stay together.
std::vector<int> owners_of_reduced(int ranks, const Scene& scene);

/// Shares the meshes out among `parts` ranks. Rank 0.
Partition cut_meshes(const Scene& scene, std::span<const GlobalMesh> meshes,
                     const interactions::Interface& interface, int parts);

}  // namespace pounding
