#pragma once

#include <array>
#include <map>
#include <vector>

#include "common/types.h"

namespace pounding {

/// Owned dofs of one node, at most six, that follow each other.
struct NodeDofs {
  LocalIndex begin = 0;
  int count = 0;
};

/// Six by six numbers of a pair of nodes, row by row; 0 where a node has no dof.
using NodeBlock = std::array<double, 36>;

/// A symmetric matrix over the dofs of a few nodes of this rank, by blocks of two nodes.
struct NodeBlocks {
  std::vector<NodeDofs> nodes;                     ///< by their dofs
  std::map<std::array<int, 2>, NodeBlock> blocks;  ///< (row, column) into nodes, row >= column
};

}  // namespace pounding
