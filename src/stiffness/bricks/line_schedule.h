#pragma once

#include <array>
#include <vector>

#include "stiffness/bricks/brick_pairs.h"

/// When chains and pairs of chains come into a buffer, and when they leave it.
///
/// A line of the buffer holds six arrays: three of displacements, three of forces. A chain has a
/// line of its nodes' values; a pair has two lines, of sums and of differences. The chains of a
/// pair that is alone lend it theirs.
namespace pounding::stiffness {

/// Chain or pair that begins at `start` of the buffer, in the first array of a line.
struct ChainLoad {
  int chain = 0;
  int start = 0;
  bool clear = false;  ///< forces start from zero
};

struct PairSlot {
  std::array<int, 2> chain{};  ///< near, far
  std::array<int, 2> node{};   ///< start of the near chain's and the far chain's nodes
  std::array<int, 2> line{};   ///< start of the sums and of the differences
  int length = 0;
};

struct PairSplit {
  PairSlot slot;
  bool clear = false;  ///< forces start from zero
  bool load = false;   ///< the chains have not been loaded: they are lent and rows in memory
};

struct PairJoin {
  PairSlot slot;
  /// Nothing has been added to the forces of the near, of the far chain.
  std::array<bool, 2> first{};
};

struct ChainStore {
  int chain = 0;
  int start = 0;
  bool handed_over = false;  ///< its forces, which then are not added to q
};

/// A call of the kernel; the entries of the other lists up to the given ends come before it (loads,
/// splits) or after it (joins, stores).
struct LineStep {
  int shape = 0;
  Sides sides = Sides::both;
  bool first_behind = false;  ///< forces of the line behind are set, not added
  int count = 0;
  std::array<std::array<int, 2>, 3> start{};  ///< of the pair, the one before, the one behind
  std::size_t loads_end = 0;
  std::size_t splits_end = 0;
  std::size_t joins_end = 0;
  std::size_t stores_end = 0;
};

struct LineSchedule {
  std::vector<ChainLoad> loads;
  std::vector<PairSplit> splits;
  std::vector<LineStep> steps;
  std::vector<PairJoin> joins;
  std::vector<ChainStore> stores;
  int buffer_size = 0;
};

/// Chain as the schedule sees it.
struct ChainForm {
  int length = 0;
  bool row = false;  ///< its dofs follow each other in memory
};

/// Array c of a line starts c * stride doubles after the first.
LineSchedule schedule_lines(const BrickPairs& pairs, const std::vector<ChainForm>& chains,
                            int stride);

}  // namespace pounding::stiffness
