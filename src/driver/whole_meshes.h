#pragma once

#include <span>
#include <vector>

#include <mpi.h>

#include "interactions/pairing/find_interface.h"
#include "mesh/global_mesh.h"
#include "mesh/partition.h"
#include "model/model.h"
#include "scene/scene.h"

namespace pounding {

/// The meshes of a scene as rank 0 has them before they are cut, and findings in them beside the
/// model's own part.
struct WholeMeshes {
  std::vector<GlobalMesh> meshes;               ///< per structure
  std::vector<MatOutline> mats;                 ///< likewise, of those on soil
  std::vector<std::vector<PoolOutline>> pools;  ///< of each structure
  int splits = 0;  ///< how often their elements are split when they are read
};

/// Hands all that ranks have to know of the whole meshes beside their parts to
/// `stream(values...)`.
void pass_shared_findings(auto& whole, auto& model, auto&& stream) {
  stream(whole.mats, whole.pools, model.interface, model.probes, model.recorded, model.forces,
         model.loads, model.starts);
}

/// The meshes of all structures, checked, with contacts, probes and forces found in them; every
/// element is split `splits` times. Throws UserError for faults of meshes. Rank 0.
WholeMeshes read_whole_meshes(MPI_Comm comm, Scene& scene, Model& model, int splits = 0);

/// Per structure the one of `ranks` ranks that has all generalised coordinates of a reduced one,
/// else -1. No rank takes more than it must; neighbours in the scene's list stay together.
std::vector<int> owners_of_reduced(int ranks, const Scene& scene);

/// Shares the meshes out among `parts` ranks. Rank 0.
Partition cut_meshes(const Scene& scene, std::span<const GlobalMesh> meshes,
                     const interactions::Interface& interface, int parts);

}  // namespace pounding
