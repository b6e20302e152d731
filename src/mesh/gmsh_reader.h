#pragma once

#include "mesh/divide_beams.h"
#include "mesh/global_mesh.h"
#include "mesh/mesh_files.h"
#include "scene/scene.h"

namespace pounding {

/// Mesh that was read, and its files.
struct MeshRead {
  GlobalMesh mesh;
  MeshFiles files;
  std::vector<DividedLines> divided;
};

/// Reads a structure's mesh by means of Gmsh, in a process of its own: a .geo file is meshed with
/// the parameters of `mesh_set`, anything else is opened as a mesh. Keeps the groups of the scene's
/// regions as elements and every named group as nodes and facets; marks rotations and clamped
/// nodes. `time_limit`: of Gmsh [s]. To be called on one rank only. Throws UserError (missing file,
/// unknown group, wrong element kind, element in two regions, no elements).
MeshRead read_mesh(const Structure& structure, double time_limit);

}  // namespace pounding
