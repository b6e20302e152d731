#pragma once

#include <array>
#include <vector>

#include "common/types.h"

namespace pounding {

/// A node that a tied one follows, and how: entry 6 i + j is the part of component i of the tied
/// node (displacements, then rotations) by component j of the carrier [-, m, 1/m].
struct Carrier {
  GlobalIndex node = 0;  ///< file order
  std::array<double, 36> block{};
};

/// A node that follows a facet: u = sum of B_i u_i over its carriers, for its displacements and its
/// rotations. Rigid motions of the carriers are the same of the node.
struct TiedNode {
  GlobalIndex node = 0;  ///< file order
  int group = 0;         ///< index into the structure's rigid groups
  std::vector<Carrier> carriers;
};

}  // namespace pounding
