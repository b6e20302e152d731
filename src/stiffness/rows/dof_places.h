#pragma once

#include <array>
#include <vector>

#include "common/types.h"

namespace pounding::stiffness {

/// Where the value of a dof stands: owned dofs in an array of their own, ghosts in another. A place
/// below owned_dofs is an owned dof; owned_dofs + i is ghost value i; -1 is a clamped component.
struct DofPlaces {
  LocalIndex owned_dofs = 0;
  std::vector<LocalIndex> of_dof;                  ///< per local dof, owned then ghost
  std::vector<std::array<LocalIndex, 6>> of_node;  ///< per local node: its components
  std::vector<LocalIndex> node_end;                ///< per owned node: one beyond its last dof
};

/// Value at a place; 0 at -1. `owned` is indexed by dof.
template <typename Values>
inline double value_at(LocalIndex place, LocalIndex owned_dofs, const Values& owned,
                       const double* ghosts) {
  if (place < 0) return 0;
  return place < owned_dofs ? owned[place] : ghosts[place - owned_dofs];
}

}  // namespace pounding::stiffness
