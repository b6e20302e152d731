#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace pounding {

/// Global numbers of the ghost dofs of a rank, in the order of their local numbers, as a Halo asks
/// for them.
inline std::vector<GlobalIndex> ghost_dofs(const Mesh& mesh) {
  std::vector<GlobalIndex> ghosts(mesh.dof_count - mesh.owned_dofs);
  for (LocalIndex node = mesh.owned_nodes; node < mesh.node_count(); ++node) {
    for (int c = 0; c < 6; ++c) {
      const LocalIndex dof = mesh.dof(node, c);
      if (dof >= 0) ghosts[dof - mesh.owned_dofs] = mesh.dof_global(node, c);
    }
  }
  return ghosts;
}

}  // namespace pounding
