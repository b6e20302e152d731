#pragma once

#include "mesh/global_mesh.h"
#include "scene/scene.h"

namespace pounding {

/// Limits of what Gmsh may do for one mesh.
struct MeshLimits {
  double time = 600;            ///< [s]
  bool allow_commands = false;  ///< of .geo files
};

/// Reads a structure's mesh by means of Gmsh, in a process of its own: a .geo file is meshed with
/// the parameters of `mesh_set`, anything else is opened as a mesh. Keeps the groups of the scene's
/// regions as elements and every named group as nodes and facets; marks rotations and clamped
/// nodes. To be called on one rank only. Throws UserError (missing file, unknown group, wrong
/// element kind, element in two regions, no elements).
GlobalMesh read_mesh(const Structure& structure, const MeshLimits& limits);

}  // namespace pounding
