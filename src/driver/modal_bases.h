#pragma once

#include <span>
#include <vector>

#include "common/profile.h"
#include "driver/model.h"
#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Bases of the reduced structures of a scene into `model.buildings`: out of a structure's file if
/// that still belongs to it, else computed, several structures at a time, and written there. A
/// basis is computed by the rank alone that has all the structure, so that it has the same bits on
/// any number of ranks, unless the structure asks for several ranks. `meshes` are read on rank 0
/// only; the model has its meshes, contacts, probes, forces, loads and starts. Throws UserError on
/// every rank alike. Collective.
void find_bases(MPI_Comm comm, const Scene& scene, std::span<const GlobalMesh> meshes,
                Profile& profile, Model& model);

}  // namespace pounding
