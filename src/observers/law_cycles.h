#pragma once

#include <mpi.h>

#include "scene/scene.h"

namespace pounding {

/// Takes every law in one dimension of a scene through cycles of `law_cycles`, from nothing, two of
/// each amplitude, and writes laws.csv into its output folder: elongation, force, energy held and
/// lost. No mesh is read: laws of bars are those of their strain, per length. Throws UserError
/// where the scene has none. Collective.
void write_law_loops(MPI_Comm comm, const Scene& scene);

}  // namespace pounding
