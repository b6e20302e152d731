#pragma once

#include <vector>

#include "interactions/laws/element_law.h"
#include "mesh/mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Laws of the regions of a structure that are marked inelastic: beams whose sections yield, shells
/// that yield in shear or crack. Throws UserError on every rank where an element cannot follow
/// them. Collective over the mesh's communicator.
std::vector<interactions::RegionLaw> inelastic_laws(const Structure& structure, const Mesh& mesh);

/// Per owned dof, whether one of them may act on it; empty where no rank has any.
std::vector<char> dofs_of_laws(const std::vector<interactions::RegionLaw>& laws, const Mesh& mesh);

/// Forces g beside K u over the owned dofs [N, N m] of elements whose history goes from nothing to
/// these displacements of the owned dofs [m, rad] at once. Collective likewise.
std::vector<double> forces_of_laws(const std::vector<interactions::RegionLaw>& laws,
                                   const Mesh& mesh, const std::vector<double>& displacement);

}  // namespace pounding
