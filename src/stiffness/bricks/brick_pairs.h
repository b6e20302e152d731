#pragma once

#include <array>
#include <vector>

#include "stiffness/bricks/brick_kernel.h"
#include "stiffness/rows/element_rows.h"
#include "stiffness/rows/product.h"

/// Chains of nodes that face each other through the thickness of their bricks, and the order in
/// which the bricks between pairs of chains are done.
namespace pounding::stiffness {

/// Node near_begin + p of one chain faces node far_begin + p of another, p < length.
struct ChainPair {
  int near = 0;
  int far = 0;
  int near_begin = 0;
  int far_begin = 0;
  int length = 0;
  /// All of both chains, and neither is in another pair: the bricks are one layer.
  bool alone = false;
};

/// Forces that the displacements of one pair cause, on itself and on its neighbours, through
/// `count` bricks of one shape in a row on one side of it or on both.
struct PairStep {
  int shape = 0;
  Sides sides = Sides::both;
  /// The pair itself, the one before it, the one behind it; -1 where there are no bricks.
  std::array<int, 3> pair{-1, -1, -1};
  std::array<int, 3> offset{};  ///< of the first node in each pair
  int count = 0;
};

struct BrickPairs {
  /// Along the run, along the row of pairs, through the thickness: axes (0-2) of the frame.
  std::array<int, 3> axes{};
  std::vector<ChainPair> pairs;
  std::vector<PairStep> steps;  ///< pair by pair, in the order in which the runs come to them
};

/// Pairs the chains of all runs. Of the two axes across them the thickness is the one that leaves
/// clearly fewer steps (in a slab one brick thick, its own), else the one along which runs follow
/// each other less often: pairs that follow each other then share chains, and few are in use at a
/// time.
BrickPairs pair_chains(const BrickRows& rows);

}  // namespace pounding::stiffness
