#pragma once

#include <mpi.h>

#include "scene/command_line.h"
#include "scene/option_table.h"
#include "scene/scene_reader.h"

namespace pounding {

/// Many runs of one scene at once: builds the model, steps the members of its table in groups of
/// eight that the ranks share out, and writes ensemble.h5 and ensemble.csv; prints on rank 0. An
/// ensemble of the same scene and table in the same folder is continued. `database`: the scene's
/// options, `origin`: whence they are. Throws UserError, StoppedBySignal, on every rank alike.
/// Collective.
void run_ensemble(MPI_Comm comm, ReadScene read, const OptionsDatabase& database,
                  const SceneOrigin& origin);

/// One run (see run_scene), or the ensemble whose table the options name. Collective.
void run_as_asked(MPI_Comm comm, ReadScene read, const OptionsDatabase& database,
                  const SceneOrigin& origin);

}  // namespace pounding
