#pragma once

#include <array>
#include <span>
#include <vector>

#include "stiffness/rows/product.h"

namespace pounding::stiffness {

/// A node outside the core of its chain: its number in the chain, where x, y, z are (-1: nowhere).
struct ChainEnd {
  int node = 0;
  std::array<LocalIndex, 3> slot{};
};

/// Nodes of bricks in a row, and where their dofs are. Most of them form a core whose dofs follow
/// each other; nodes before and behind it may be clamped, ghosts, or numbered elsewhere.
struct BrickChain {
  int length = 0;
  int first = 0;     ///< node of the core
  int core = 0;      ///< owned nodes of the core, at least half of all; else none
  DofRange range;    ///< all dofs of the core, rotations included
  bool row = false;  ///< no rotations are between them
  int begin = 0;     ///< into the slots: one per node of the core
  int ends = 0;      ///< into the ends

  bool in_core(int node) const { return first <= node && node < first + core; }
};

class BrickChains {
 public:
  /// Adds a chain; returns it.
  const BrickChain& add(const DofSlots& slots, const std::vector<LocalIndex>& nodes);
  const BrickChain& at(int number) const { return chains_[number]; }
  /// Dof of a component (0-2) of a chain's node; -1 where there is none.
  LocalIndex slot(const BrickChain& chain, int node, int component) const;
  /// First dof of each node of the core.
  const LocalIndex* slots(const BrickChain& chain) const { return slots_.data() + chain.begin; }
  /// Nodes outside the core, in their order.
  std::span<const ChainEnd> ends(const BrickChain& chain) const {
    return {ends_.data() + chain.ends, static_cast<std::size_t>(chain.length - chain.core)};
  }

 private:
  std::vector<BrickChain> chains_;
  std::vector<LocalIndex> slots_;
  std::vector<ChainEnd> ends_;
};

}  // namespace pounding::stiffness
