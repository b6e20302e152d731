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

/// Throws UserError on every rank, naming the element, where one of them is beyond a first corner
/// under the displacements of the owned dofs at rest [m, rad]. Collective likewise.
void require_elastic_rest(const std::vector<interactions::RegionLaw>& laws, const Mesh& mesh,
                          const std::vector<double>& displacement);

}  // namespace pounding
