#pragma once

#include <mpi.h>

#include "observers/observed_run.h"

namespace pounding {

/// Links that the scene wants recorded: finds them, has their steps record them, and brings
/// elongation and force of each to the history. A link is named after its item, the element's
/// number in the mesh file, and the component ("frame:pads.17.x", a bar's "axial", a dashpot's
/// "x.dashpot"); a pair with filler after its contact and its number among the pairs. Throws
/// UserError for a group without links. Collective.
OutputKind loops_output();

/// Takes every law in one dimension of a scene through cycles of `law_cycles`, from nothing, two of
/// each amplitude, and writes laws.csv into its output folder: elongation, force, energy held and
/// lost. No mesh is read: laws of bars are those of their strain, per length. Throws UserError
/// where the scene has none. Collective.
void write_law_loops(MPI_Comm comm, const Scene& scene);
OutputKind law_loops_output();

}  // namespace pounding
