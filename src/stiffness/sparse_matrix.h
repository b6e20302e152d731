#pragma once

#include <functional>
#include <vector>

#include "common/petsc.h"
#include "mesh/mesh.h"

/// Empty PETSc matrices, from which an assembly starts.
namespace pounding::stiffness {

/// An empty symmetric AIJ matrix with room for what the elements of some blocks of a structure
/// couple (all if `chosen` is empty); rows and columns over its owned dofs. Collective.
MatHandle create_matrix(const Mesh& mesh,
                        const std::function<bool(const ElementBlock&)>& chosen = {});

/// Global numbers of all local dofs, owned then ghost.
std::vector<PetscInt> global_numbers(const Mesh& mesh);

}  // namespace pounding::stiffness
