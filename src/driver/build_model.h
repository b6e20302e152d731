#pragma once

#include <mpi.h>

#include "common/profile.h"
#include "driver/model.h"
#include "scene/scene.h"

namespace pounding {

/// Reads, partitions, distributes and assembles; finds modes, omega_max and the time step. Soil
/// gets its foundation from the mesh, and the scene keeps it. The model borrows from the scene.
/// Throws UserError on every rank alike. Collective.
Model build_model(MPI_Comm comm, Scene& scene, Profile& profile);

}  // namespace pounding
