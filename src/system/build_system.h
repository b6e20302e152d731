#pragma once

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"

namespace pounding {

/// A structure at full order: from its matrices where the scene names some, else from its elements.
/// See build_matrix_system and build_finite_element_system. Collective.
LinearSystem build_system(const Structure& structure, const Mesh& mesh,
                          StiffnessMethod method = StiffnessMethod::assembled,
                          bool with_matrix = false);

}  // namespace pounding
