#pragma once

#include <mpi.h>

#include "driver/model.h"
#include "scene/scene.h"

namespace pounding {

/// `model.h5` and `model.xdmf` in the scene's output folder: the meshes as the options made them,
/// for ParaView. Beside the arrays of write_mesh(), per cell
///
///     material, section      number in `materials`, in `sections`, from 1; 0: none
///     thickness, area [m, m2], young [Pa], density [kg/m3], mass [kg] of point masses
///     spring_stiffness       (cells, 3) along x, y, z [N/m]
///
/// the pairs of the contacts as lines from the secondary side to the place that it faces, with
/// their contact (from 1) and initial gap [m], and the nodes of the probes as points, with the
/// number of the probe (from 1). Numbers mean the names in `contacts` and `probes`. Needs the
/// distributed meshes, the interface and the probes, nothing else. Throws UserError on every rank
/// alike (no space). Collective.
void write_model(MPI_Comm comm, const Scene& scene, const Model& model);

}  // namespace pounding
