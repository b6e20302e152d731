#pragma once

#include <span>
#include <string>

#include "mesh/mesh_guard.h"
#include "mesh/raw_mesh.h"

namespace pounding {

/// Task of the program pounding-mesh.
struct MeshTask {
  std::string file;            ///< absolute path
  bool make = false;           ///< a geometry to mesh, not a mesh to open
  std::span<char*> arguments;  ///< parameters as Gmsh's own command takes them, behind a first word
};

/// Lets the Gmsh library open a mesh, or make one of a geometry, and takes over its content. The
/// process is guarded before the file is opened; denied calls go to `denied`. Errors that Gmsh
/// reports come as the answer's; its crashes end the process. Part of the program pounding-mesh
/// only.
RawAnswer gmsh_mesh(const MeshTask& task, Denied denied);

}  // namespace pounding
