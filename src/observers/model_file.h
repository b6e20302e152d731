#pragma once

#include <mpi.h>

#include "observers/observed_run.h"
#include "output/mesh_grid.h"
#include "scene/scene.h"

namespace pounding {

/// `model.h5` and `model.xdmf` in the scene's output folder: the meshes as the options made them,
/// for ParaView. Beside the arrays of write_mesh(), per cell
///
///     material, section      number in `materials`, in `sections`, from 1; 0: none
///     thickness, area [m, m2], young [Pa], density [kg/m3], mass [kg] of point masses
///     spring_stiffness       (cells, 3) along x, y, z [N/m]
///
/// per node of faces through which a motion from below enters
///
///     absorbing_base         (nodes, 4) x, y, z [m] and its share of their area [m2]
///
/// the pairs of the contacts as lines from the secondary side to the place that it faces, with
/// their contact (from 1) and initial gap [m], and the nodes of the probes as points, with the
/// number of the probe (from 1). Numbers mean the names in `contacts` and `probes`. Needs the
/// distributed meshes, the interface and the probes, nothing else. Throws UserError on every rank
/// alike (no space). Collective.
void write_model(MPI_Comm comm, const Scene& scene, const Model& model);

/// Groups and contacts of a scene as its pictures name them. Local.
MeshLabels mesh_labels(const Scene& scene, const interactions::Interface& interface);

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
