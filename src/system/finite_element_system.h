#pragma once

#include "elements/element.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"

namespace pounding {

/// Properties of a region's elements as the element functions want them.
ElementProperties element_properties(const Region& region);

/// Assembles a structure's finite-element model: lumped mass, stiffness (PETSc AIJ), influence
/// vectors, element bound of omega. Sums run over the elements in file order on every rank, so that
/// mass and stiffness do not depend on the number of ranks. Throws UserError naming the element if
/// one is impossible, and the node if a free dof has no mass. Collective.
LinearSystem build_finite_element_system(const Structure& structure, const Mesh& mesh,
                                         StiffnessMethod method = StiffnessMethod::assembled);

}  // namespace pounding
