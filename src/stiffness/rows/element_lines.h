#pragma once

#include <vector>

#include "stiffness/rows/product.h"

namespace pounding::stiffness {

/// The product of elements in rows, of one kind and one frame. It visits chains of nodes in the
/// order of the mesh's numbering and keeps those in use in a small buffer, so that w is read and q
/// written once. The forces of a chain whose dofs nothing else touches later need not go to q: they
/// are handed over.
class ElementLines {
 public:
  virtual ~ElementLines() = default;

  /// Chains in the order in which `apply` is done with them.
  virtual std::size_t chain_count() const = 0;
  /// Owned dofs of a chain to which the elements add.
  virtual std::vector<LocalIndex> chain_dofs(std::size_t place) const = 0;
  /// All dofs of the chain's nodes, those included to which the elements do not add, if they are
  /// owned and follow each other; else an empty range.
  virtual DofRange chain_range(std::size_t place) const = 0;
  /// Decides for every chain whether its forces, final as they are, are handed over and not added
  /// to q; only for those with a range. Call once.
  virtual void set_handed_over(const std::vector<char>& handed_over) = 0;

  /// q += K w on the owned dofs that these elements touch, but for forces that are handed over.
  /// Allocates nothing.
  virtual void apply(const StiffnessArgument& w, const double* ghosts, double* q,
                     ForceReceiver& receiver) const = 0;
};

}  // namespace pounding::stiffness
