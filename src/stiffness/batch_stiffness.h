#pragma once

#include <memory>
#include <vector>

#include "common/batch_value.h"
#include "common/memory.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "stiffness/rows/product.h"

namespace pounding::stiffness {

/// K of a structure in eight runs at once. Boxes and rectangles count as elements of general shape.
/// Local: this rank has the whole structure.
///
///     per window of dofs (BatchWindows):
///     w, as far as its elements reach -> elements, rows -> the window's forces are handed over
///
/// So state and forces of a dof go through the memory once, whatever the number of its elements.
class BatchStiffness {
 public:
  BatchStiffness(const Structure& structure, const Mesh& mesh);
  ~BatchStiffness();

  /// Memory of one, at most [bytes].
  static double memory(const Mesh& mesh);

  /// K w [N, N m], handed over window by window. Allocates nothing.
  void apply(const ArgumentOf<BatchValue>& w, ReceiverOf<BatchValue>& receiver) const;

 private:
  struct Elements;
  using Values = std::vector<BatchValue, LargePageAllocator<BatchValue>>;

  LocalIndex dofs_;
  std::unique_ptr<Elements> elements_;
  /// Places of the ring, and one after it for clamped dofs, which stay at rest.
  mutable Values argument_;
  mutable Values force_;
};

}  // namespace pounding::stiffness
