#pragma once

#include <mpi.h>

#include "scene/scene_origin.h"
#include "scene/scene_reader.h"

namespace pounding {

/// The whole job: builds the model, steps to the end time, writes the results; prints on rank 0.
/// `origin`: whence the options are. Needs MPI, PETSc and SLEPc initialised over `comm` =
/// PETSC_COMM_WORLD. Throws UserError and DivergenceError on every rank alike. Collective.
void run_scene(MPI_Comm comm, ReadScene read, const SceneOrigin& origin);

}  // namespace pounding
