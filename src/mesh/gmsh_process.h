#pragma once

#include <memory>
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

/// Run of Gmsh in a process of its own, which begins with the object and ends with it, with this
/// process or at the time limit. To be used on one rank only.
class GmshRun {
 public:
  /// Throws UserError where pounding-mesh cannot be run.
  explicit GmshRun(MeshRequest request);
  GmshRun(const GmshRun&) = delete;
  GmshRun& operator=(const GmshRun&) = delete;
  ~GmshRun();

  /// Waits for the answer, from now on as long as the time limit; once only. Throws UserError where
  /// Gmsh reports an error, crashes, takes too long, or is stopped since the file asks for more
  /// than to be read.
  RawAnswer answer();

 private:
  class Process;
  MeshRequest request_;
  std::unique_ptr<Process> process_;
};

}  // namespace pounding
