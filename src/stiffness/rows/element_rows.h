#pragma once

#include <array>
#include <vector>

#include "common/types.h"

/// Elements in rows: which nodes follow each other along an axis, which elements lie between them.
/// Elements have a near and a far node on each of `lines` edges along that axis: four edges for
/// bricks, two for rectangles.
namespace pounding::stiffness {

/// An element of a shape (congruent elements share one); nodes by corner bits, see ElementFrames.
template <std::size_t lines>
struct RowElement {
  int shape = 0;
  std::array<LocalIndex, 2 * lines> nodes{};
};

/// Consecutive elements of one shape between the same chains of nodes.
template <std::size_t lines>
struct ElementRun {
  int shape = 0;
  /// Chains through the corners near on the run axis. Bricks: near both other axes, beyond the next
  /// one in cyclic order, beyond the one after, beyond both. Rectangles: near, beyond.
  std::array<int, lines> chain{};
  std::array<int, lines> offset{};  ///< of the first node in its chain
  int count = 0;
};

template <std::size_t lines>
struct ElementRows {
  int run_axis = 0;
  std::vector<std::vector<LocalIndex>> chains;  ///< nodes in a row, ordered by their middle node
  std::vector<ElementRun<lines>> runs;          ///< in the order of their first chain
  /// Numbers of the elements that fit in no chain: meshes that do not conform.
  std::vector<std::size_t> left_over;
};

/// Rows of the elements along an axis of their shape: bricks 0-2, rectangles 0-1.
template <std::size_t lines>
ElementRows<lines> find_rows(const std::vector<RowElement<lines>>& elements, LocalIndex node_count,
                             int run_axis);

/// Rows along the axis for which a product is expected to take least time: few vector operations,
/// nodes of a chain close to each other in memory.
template <std::size_t lines>
ElementRows<lines> best_rows(const std::vector<RowElement<lines>>& elements, LocalIndex node_count);

using BrickElement = RowElement<4>;
using BrickRows = ElementRows<4>;
using RectangleElement = RowElement<2>;
using RectangleRun = ElementRun<2>;
using RectangleRows = ElementRows<2>;

}  // namespace pounding::stiffness
