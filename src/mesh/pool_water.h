#pragma once

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Adds the water of a structure's pools to its mesh, an element set for each region of theirs: the
/// nodes of the walls and the floor with their shares of the impulsive masses, and a node for each
/// wave, which moves along one axis, with springs to the walls. `GlobalMesh::pools` gets the
/// outlines, those of water with cells as well. Components must be known. Throws UserError: no such
/// group, faces that are no rectangle along the axes with a level floor, a surface above the walls
/// or below the floor, walls with too few nodes. Serial.
void add_pools(const Structure& structure, GlobalMesh& mesh);

}  // namespace pounding
