#pragma once

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Adds the element of the soil under a structure's mat: on the node of the mat's group that has
/// rotations and is nearest, in plan, to the middle of the box around the group. Components must be
/// known. Throws UserError: no such group, no node with rotations, a clamped node, a mat without
/// extents whose size is not given. Serial.
void add_soil(const Structure& structure, GlobalMesh& mesh);

/// Outline of the mat under a structure. The middle of its underside is that of the box around
/// its nodes, at the level of the lowest of them. Serial.
MatOutline mat_outline(const Structure& structure, const GlobalMesh& mesh);

}  // namespace pounding
