#pragma once

#include "driver/model.h"

namespace pounding {

/// `modes.h5` in the scene's output folder: per structure a group with the arrays of write_mesh()
/// and
///     frequencies          (modes) [Hz]
///     shapes/0001 ...      (nodes, 3 or 6) x, y, z and the rotations about them, phi^T M phi = 1;
///                          0 where a node is clamped or has no rotation
///     displacements/0001   (nodes, 3) x, y, z alone, where there are rotations
/// and beside it `modes.xdmf`, in which ParaView finds the displacements of each mode as a vector
/// mode_0001 ... of the nodes. The sign of a shape has no meaning. Needs modes with their shapes.
/// Throws UserError on every rank alike (no space). Collective.
void write_mode_shapes(MPI_Comm comm, const Scene& scene, const Model& model);

}  // namespace pounding
