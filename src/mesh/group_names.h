#pragma once

#include <string>

#include "mesh/global_mesh.h"

namespace pounding {

/// Names of a mesh's groups, for a message: "base, face1, slab".
inline std::string group_names(const GlobalMesh& mesh) {
  std::string names;
  for (const auto& [name, group] : mesh.groups) names += (names.empty() ? "" : ", ") + name;
  return names;
}

}  // namespace pounding
