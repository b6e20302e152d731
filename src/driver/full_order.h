#pragma once

#include <cstddef>
#include <optional>

#include "driver/model.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/element_forces.h"
#include "system/linear_system.h"

namespace pounding {

/// System of structure `s` of the scene at full order, whether a run steps it so or a basis is made
/// of it: on a mesh of it, with its loads and its start. `structure` may differ from the scene's in
/// its step. Collective over the ranks of the mesh.
LinearSystem assemble_structure(const Model& model, std::size_t s, const Structure& structure,
                                const Mesh& mesh, StiffnessMethod method, bool with_matrix);

/// Refuses matrices from files that give energy and columns that buckle under their axial forces.
/// Needs the matrix of the system. Throws UserError on every rank alike. Collective.
void require_stable(const Structure& structure, const Mesh& mesh, const LinearSystem& system,
                    const std::optional<LargestCompression>& compression);

/// How the system follows the supports of its structure, where these move on their own, and the
/// ends of its links with it. Needs its matrix. Collective.
void follow_supports(const Model& model, const Structure& structure, const Mesh& mesh,
                     SolverChoice solver, LinearSystem& system);

}  // namespace pounding
