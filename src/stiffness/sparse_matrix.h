#pragma once

#include <vector>

#include "common/petsc.h"
#include "mesh/mesh.h"

/// What an assembly into a PETSc matrix starts from.
namespace pounding {

/// An empty symmetric AIJ matrix with room for what the elements of a structure couple; rows and
/// columns over its owned dofs. Collective.
MatHandle create_matrix(const Mesh& mesh);

/// Global numbers of all local dofs, owned then ghost.
std::vector<PetscInt> global_numbers(const Mesh& mesh);

}  // namespace pounding
