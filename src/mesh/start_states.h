#pragma once

#include <span>
#include <vector>

#include "mesh/global_mesh.h"
#include "mesh/nodal_load.h"
#include "scene/scene.h"

namespace pounding {

/// Displacements and velocities at t = 0 of nodes that differ from those of all nodes, per
/// structure: of groups, and of the nodes in a file, which win. Throws UserError: nodes of two
/// groups that start differently, a file that is no table of nodes, a node that is not in the mesh,
/// one that is clamped in a component that is to move, a displacement beside a static start.
/// Serial, rank 0.
std::vector<NodalStart> find_start_states(const Scene& scene, std::span<const GlobalMesh> meshes);

}  // namespace pounding
