#pragma once

#include <string>
#include <vector>

namespace pounding {

/// Files of which a mesh was made.
struct MeshFiles {
  /// Opened by Gmsh beside the one that the option names, each once, in that order; paths from the
  /// working folder where they lie in it, else absolute ones.
  std::vector<std::string> opened;
  bool landlock = true;  ///< Landlock guarded Gmsh as well as seccomp
};

}  // namespace pounding
