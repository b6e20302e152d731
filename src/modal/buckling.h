#pragma once

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/element_forces.h"
#include "system/linear_system.h"

namespace pounding {

/// Throws UserError (one line, on every rank alike) if the stiffness of a structure whose elements
/// have axial forces has a negative eigenvalue: it buckles. A factorisation counts those below
/// -1e-13 of K scaled to a unit diagonal. The group is that whose axial forces do most work in the
/// motion of the lowest one, which inverse iteration finds. Needs the matrix of the system.
/// Collective.
void require_no_buckling(const Structure& structure, const Mesh& mesh, const LinearSystem& system,
                         const LargestCompression& largest);

}  // namespace pounding
