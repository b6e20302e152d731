#pragma once

#include <string>
#include <vector>

#include "mesh/raw_mesh.h"

namespace pounding {

/// Request to the program pounding-mesh.
struct MeshRequest {
  std::string option;  ///< "-left_mesh left.geo": at the head of messages
  std::string file;    ///< absolute path
  bool make = false;   ///< a geometry to mesh, not a mesh to open
  std::vector<std::pair<std::string, std::string>> parameters;  ///< of a geometry: names and values
  double time_limit = 600;                                      ///< [s]
};

/// Runs Gmsh in a process of its own and takes its answer through a pipe; the process is killed at
/// the time limit, and ends with this one. Throws UserError where Gmsh reports an error, crashes,
/// takes too long, or is stopped since the file asks for more than to be read. To be called on one
/// rank only.
RawAnswer run_gmsh(const MeshRequest& request);

}  // namespace pounding
