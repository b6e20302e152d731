#pragma once

#include <array>
#include <vector>

#include "common/types.h"

/// Bricks in rows: which nodes follow each other along an axis, which bricks lie between them.
namespace pounding {

/// A brick of a shape (congruent bricks share one); nodes by corner bits as in Brick.
struct BrickElement {
  int shape = 0;
  std::array<LocalIndex, 8> nodes{};
};

/// Consecutive bricks of one shape between the same four chains of nodes.
struct BrickRun {
  int shape = 0;
  /// Chains through the corners near on the run axis: near both other axes, beyond the next one in
  /// cyclic order, beyond the one after, beyond both.
  std::array<int, 4> chain{};
  std::array<int, 4> offset{};  ///< of the first node in its chain
  int count = 0;
};

struct BrickRows {
  int run_axis = 0;
  std::vector<std::vector<LocalIndex>> chains;  ///< nodes in a row, ordered by their first node
  std::vector<BrickRun> runs;                   ///< in the order of their first chain
  /// Numbers of the bricks that fit in no chain: meshes that do not conform.
  std::vector<std::size_t> left_over;
};

/// Rows of the bricks along an axis (0-2) of their frame.
BrickRows find_brick_rows(const std::vector<BrickElement>& bricks, LocalIndex node_count,
                          int run_axis);

/// Rows along the axis for which a product is expected to take least time: few vector operations,
/// nodes of a chain close to each other in memory.
BrickRows best_brick_rows(const std::vector<BrickElement>& bricks, LocalIndex node_count);

}  // namespace pounding
