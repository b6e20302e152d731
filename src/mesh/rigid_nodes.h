#pragma once

#include <vector>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Nodes of a structure that move together, but for ties; their groups are in the mesh and have
/// nodes. Throws UserError naming the place of a node that would follow two motions, or is clamped
/// in a component that follows one, and where a pin finds no nodes on each other. Serial.
std::vector<RigidNodes> find_rigid_nodes(const Structure& structure, const GlobalMesh& mesh);

}  // namespace pounding
