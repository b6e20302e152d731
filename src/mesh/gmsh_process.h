#pragma once

#include <string>

#include "mesh/raw_mesh.h"

namespace pounding {

/// Request to the program pounding-mesh.
struct MeshRequest {
  std::string option;           ///< "-left_mesh left.geo": at the head of messages
  std::string file;             ///< absolute path
  bool make = false;            ///< a geometry to mesh, not a mesh to open
  bool allow_commands = false;  ///< it may write files
  double time_limit = 600;      ///< [s]
};

/// Runs Gmsh in a process of its own and takes its answer through a pipe; the process is killed at
/// the time limit, and ends with this one. Throws UserError where Gmsh reports an error, crashes,
/// or takes too long. To be called on one rank only.
RawMesh run_gmsh(const MeshRequest& request);

}  // namespace pounding
