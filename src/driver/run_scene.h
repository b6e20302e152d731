#pragma once

#include <string>

#include <mpi.h>

#include "scene/scene.h"
#include "scene/scene_origin.h"

namespace pounding {

/// The whole job: builds the model, steps to the end time, writes the results; prints on rank 0.
/// `resolved`: the options in force, for `resolved.yaml`; `origin`: whence they are. Needs MPI,
/// PETSc and SLEPc initialised over `comm` = PETSC_COMM_WORLD. Throws UserError and DivergenceError
/// on every rank alike. Collective.
void run_scene(MPI_Comm comm, Scene scene, const std::string& resolved, const SceneOrigin& origin);

}  // namespace pounding
