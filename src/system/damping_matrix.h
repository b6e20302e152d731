#pragma once

#include "common/petsc.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"

namespace pounding {

/// Damping beside alpha M + beta K as one matrix [N s/m, N m s], rows and columns over the owned
/// dofs: the extra damping D of the system and the dashpots among its links. Null if there is
/// neither. For export: a step takes them apart. Collective.
MatHandle damping_matrix(const Structure& structure, const Mesh& mesh, const LinearSystem& system);

}  // namespace pounding
