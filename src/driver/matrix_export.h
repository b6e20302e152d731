#pragma once

#include <mpi.h>

#include "model/model.h"
#include "scene/scene.h"

namespace pounding {

/// Writes the matrices of every structure into folders of their names below
/// `scene.export_matrices`, in the form that system/matrix_system.h reads: dofs.csv, stiffness.mtx,
/// mass.mtx (a column), damping.mtx where there is damping beside alpha M + beta K. Beside them
/// influence.mtx, one column per direction of the ground; contact.mtx and gaps.csv, the structure's
/// columns of L and the initial gaps; probes.mtx, three rows per probe, and probes.csv, their
/// names. Rows and columns are in the order of the nodes in the mesh file, whatever the number of
/// ranks. Rank 0 holds a whole matrix meanwhile. Throws UserError on every rank alike. Collective.
void export_matrices(MPI_Comm comm, const Scene& scene, const Model& model);

}  // namespace pounding
