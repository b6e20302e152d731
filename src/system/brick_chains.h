#pragma once

#include <vector>

#include "system/dof_places.h"
#include "system/stiffness.h"

namespace pounding {

/// Nodes of bricks in a row, and where their dofs are.
struct BrickChain {
  int begin = 0;  ///< into the places: one per moving node if plain, else x, y, z of each node
  int length = 0;
  int first = 0;   ///< nodes before this one are clamped
  int moving = 0;  ///< nodes from there on that may move; those behind them are clamped
  /// Every moving node owns x, y, z in a row, and one more dof follows.
  bool plain = false;
  bool row = false;  ///< plain, and the nodes' dofs follow each other, no rotations between
  /// Ghosts only, whose values follow each other from this place of those received; -1: not so.
  LocalIndex ghost_row = -1;
  /// All dofs of the moving nodes, rotations included, if they are owned and follow each other;
  /// else empty.
  DofRange range;
  bool whole_row() const { return row && moving == length; }
};

class BrickChains {
 public:
  /// Adds a chain; returns it.
  const BrickChain& add(const DofPlaces& places, const std::vector<LocalIndex>& nodes);
  const BrickChain& at(int number) const { return chains_[static_cast<std::size_t>(number)]; }
  /// Of a component (0-2) of a chain's node; -1 where there is none.
  LocalIndex place(const BrickChain& chain, int node, int component) const;
  /// See BrickChain::begin.
  const LocalIndex* places(const BrickChain& chain) const { return places_.data() + chain.begin; }

 private:
  std::vector<BrickChain> chains_;
  std::vector<LocalIndex> places_;
};

}  // namespace pounding
