#pragma once

#include <vector>

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// The clamped nodes of a structure that stand on supports, sorted; empty where it stands on none,
/// or on such as move with the ground only. Throws UserError where a support's group is not in the
/// mesh or has no clamped node, where a clamped node stands on no support or on two, and where one
/// is tied. Serial, rank 0.
std::vector<SupportedNode> find_supported_nodes(const Scene& scene, const Structure& structure,
                                                const GlobalMesh& mesh);

}  // namespace pounding
