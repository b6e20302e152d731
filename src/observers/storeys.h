#pragma once

#include <vector>

#include "model/model.h"
#include "observers/storey_drifts.h"
#include "scene/scene.h"

namespace pounding {

/// Lowest nodes of each structure with a storey above its ground, where these can move against the
/// ground: free ones (soil, isolators, a motion from below) and clamped ones on a support that
/// moves on its own. Named after the structure. Needs meshes and probes. Collective.
std::vector<ResolvedProbe> find_storey_bases(MPI_Comm comm, const Scene& scene, const Model& model);

/// Storeys between the probes that the scene calls floors, structure by structure from below.
/// Throws UserError for two floors of a structure at one height. Collective.
std::vector<Storey> find_storeys(MPI_Comm comm, const Scene& scene, const Model& model);

}  // namespace pounding
