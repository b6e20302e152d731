#pragma once

#include <mpi.h>

#include "common/profile.h"
#include "driver/model.h"
#include "scene/scene.h"

namespace pounding {

/// Reads, partitions, distributes and assembles; finds modes, omega_max and the time step. Throws
/// UserError on every rank alike. Collective.
Model build_model(MPI_Comm comm, const Scene& scene, Profile& profile);

}  // namespace pounding
