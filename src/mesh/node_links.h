#pragma once

#include <vector>

#include "common/types.h"

namespace pounding {

/// Two nodes, of any two structures, that should live on one rank: facing nodes of a contact.
struct NodeLink {
  int structure_a = 0;
  GlobalIndex node_a = 0;
  int structure_b = 0;
  GlobalIndex node_b = 0;
};

/// Nodes of one structure that one rank must own.
struct NodeCluster {
  int structure = 0;
  std::vector<GlobalIndex> nodes;
};

}  // namespace pounding
