#pragma once

#include <memory>
#include <vector>

#include "common/batch_value.h"
#include "common/memory.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "stiffness/rows/product.h"

namespace pounding::stiffness {

class AssembledRows;
class BeamElements;
struct GeneralElements;

/// K of a structure in eight runs at once, one element after the other: the rows of its dofs, eight
/// values in each, are whole vectors, and the numbers of the element are those of all runs. Boxes
/// and rectangles count as elements of general shape. Local: this rank has the whole structure.
class BatchStiffness {
 public:
  using Values = std::vector<BatchValue, LargePageAllocator<BatchValue>>;

  BatchStiffness(const Structure& structure, const Mesh& mesh);
  ~BatchStiffness();

  /// Memory of one, at most [bytes].
  static double memory(const Mesh& mesh);

  /// K w [N, N m], handed over range by range. Allocates nothing.
  void apply(const ArgumentOf<BatchValue>& w, ReceiverOf<BatchValue>& receiver) const;

 private:
  std::size_t dofs_;
  std::unique_ptr<GeneralElements> general_;
  std::unique_ptr<BeamElements> beams_;
  std::unique_ptr<AssembledRows> sparse_;
  /// Dofs, and six that stay at rest for clamped nodes.
  mutable Values argument_;
  mutable Values force_;  ///< of dofs zero between products
};

}  // namespace pounding::stiffness
