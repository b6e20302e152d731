#pragma once

#include <span>

#include "interactions/pairing/interface.h"
#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding::interactions {

/// Rows and report of a contact that is a stop, `number` among the scene's: for every node of the
/// secondary side and the primary node nearest to it (none beside a wall) a row along the stop's
/// direction, and one against it where it stops both ways. Serial, rank 0. Throws UserError for an
/// unknown group, nodes that cannot move, and two nodes at one place that have no direction given.
void add_stop_rows(const Scene& scene, std::span<const GlobalMesh> meshes, int number,
                   Interface& interface);

}  // namespace pounding::interactions
