#pragma once

#include <mpi.h>

#include "driver/run_scene.h"
#include "scene/command_line.h"
#include "scene/option_table.h"
#include "scene/scene_reader.h"

namespace pounding {

/// Runs a scene, see run_scene, and where it asks for that estimates the error of its reduced
/// structures, of its step and its mesh. `mesh`: the last of these, where it is known. Throws
/// UserError also where that cannot be done. Collective.
RunOutcome run_estimated(MPI_Comm comm, ReadScene read, const SceneOrigin& origin,
                         const ErrorPart* mesh = nullptr);

/// Runs a scene with as few modes as an accepted error of its floor spectra allows, `read` being
/// the scene with that target and `database` its options: every structure that is not said to stay
/// at full order is reduced to its lowest modes and attachment vectors, the error is estimated
/// (full_order_window.h), and where it is too large the number of modes grows, or the step is cut
/// where its error is the larger, until the error is within the target or full order is as cheap,
/// which is then run. An error of the mesh beyond the target is reported, with the size of elements
/// that would do. The results in the scene's folder are those of the last run. Throws UserError (a
/// target that nothing can be done for), DivergenceError, StoppedBySignal on every rank alike.
/// Collective.
void run_within_target(MPI_Comm comm, const ReadScene& read, const OptionsDatabase& database,
                       const SceneOrigin& origin);

}  // namespace pounding
