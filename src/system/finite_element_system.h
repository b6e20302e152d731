#pragma once

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"

namespace pounding {

/// A structure at full order, from its matrices where the scene names some (build_matrix_system),
/// else its finite-element model: lumped mass, stiffness, influence vectors, element bound of
/// omega. Sums run over the elements in file order on every rank, so that mass and matrix do not
/// depend on the number of ranks. The stiffness is assembled (PETSc AIJ) only where products need
/// it, or `with_matrix` asks for LinearSystem::stiffest_matrix beside the element-wise product.
/// Throws UserError naming the element if one is impossible, and the node if a free dof has no
/// mass. Collective.
LinearSystem build_system(const Structure& structure, const Mesh& mesh,
                          StiffnessMethod method = StiffnessMethod::assembled,
                          bool with_matrix = false);

}  // namespace pounding
