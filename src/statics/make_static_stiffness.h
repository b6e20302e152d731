#pragma once

#include <memory>

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "statics/static_stiffness.h"
#include "system/linear_system.h"

namespace pounding {

/// Static stiffness of a structure, reduced or at full order; that at full order needs
/// LinearSystem::stiffest_matrix. `shift` [1/s2]. Throws UserError naming the structure where the
/// factorisation fails. Collective.
std::unique_ptr<StaticStiffness> make_static_stiffness(const LinearSystem& system, const Mesh& mesh,
                                                       double shift, SolverChoice solver);

}  // namespace pounding
