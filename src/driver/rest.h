#pragma once

#include <string>
#include <vector>

#include <mpi.h>

#include "common/profile.h"
#include "driver/model.h"
#include "scene/scene.h"

namespace pounding {

/// Lets the systems of a model start from their static equilibrium, where the scene asks for it,
/// and keeps its results. `meshes`: those of its structures. Collective.
void put_at_rest(MPI_Comm comm, const Scene& scene, std::span<const Mesh> meshes, Profile& profile,
                 Model& model);

/// Doubts about an equilibrium: settlements that small displacements do not describe, and forces
/// that do not sum up to the weight.
std::vector<std::string> rest_warnings(const Model& model);

}  // namespace pounding
