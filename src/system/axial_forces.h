#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"

namespace pounding {

/// The most compressed beam or bar of a structure.
struct LargestCompression {
  double force = 0;   ///< compression above 0; 0 if there is none [N]
  std::string place;  ///< the element and its group; empty if there is none
};

/// Values of a field over the owned dofs at all local dofs, ghosts included. Collective.
std::vector<double> with_ghosts(const Mesh& mesh, const std::vector<double>& owned);

/// Gives every beam and bar of a mesh the axial force that it has under the displacements of its
/// owned dofs. Forces are rounded to a power of two of 1e-9 of the largest one, so that the
/// round-off of a solution, which differs from run to run, does not reach the stiffness. The same
/// on all ranks; collective.
LargestCompression set_axial_forces(const Structure& structure,
                                    const std::vector<double>& displacement, Mesh& mesh);

}  // namespace pounding
