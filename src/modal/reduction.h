#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/profile.h"
#include "interactions/pairing/interface.h"
#include "mesh/force_places.h"
#include "mesh/global_mesh.h"
#include "mesh/probe_set.h"
#include "modal/modal_basis.h"
#include "scene/scene.h"
#include "system/load_shapes.h"

namespace pounding {

/// Per structure the one of `ranks` ranks that has all generalised coordinates of a reduced one,
/// else -1. No rank takes more than it must; neighbours in the scene's list stay together.
std::vector<int> owners_of_reduced(int ranks, const Scene& scene);

/// Per structure the basis of a reduced one, nothing for the others: out of its file if that still
/// belongs to the structure, else computed, several structures at a time, and written there. A
/// basis is computed by one rank alone, so that it has the same bits on any number of ranks, unless
/// the structure asks for several. `meshes` are read on rank 0 only. `columns`: motions of the
/// scene's supports; `loads`: all of the scene; `starts`: per structure. Throws UserError on
/// every rank alike. Collective.
std::vector<std::optional<ModalBasis>> find_bases(
    MPI_Comm comm, const Scene& scene, std::span<const GlobalMesh> meshes,
    const interactions::Interface& interface, std::span<const ResolvedProbe> probes,
    std::span<const ResolvedForce> forces, std::span<const ResolvedProbe> storey_bases,
    std::span<const SupportColumn> columns, const SceneLoads& loads,
    std::span<const NodalStart> starts, Profile& profile);

}  // namespace pounding
