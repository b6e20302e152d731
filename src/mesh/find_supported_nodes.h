#pragma once

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Sets `supported` and `ground_support` of a mesh: the clamped nodes on supports, and the support
/// with which all the ground of the structure moves; empty and -1 where it is on none, or on such
/// as move with the ground only. Throws UserError where a support's group is not in the mesh or has
/// no clamped node, where a clamped node is on no support or on two, and where one is tied. Serial,
/// rank 0.
void find_supported_nodes(const Scene& scene, const Structure& structure, GlobalMesh& mesh);

}  // namespace pounding
