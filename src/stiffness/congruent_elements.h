#pragma once

#include <array>
#include <vector>

#include "common/lanes.h"
#include "common/types.h"
#include "elements/element.h"

namespace pounding {

/// Elements of 24 dofs that share one dense matrix, lane_count of them at a time.
class CongruentElements {
 public:
  using Places = std::array<LocalIndex, max_element_size>;  ///< as in DofPlaces

  /// `stiffness`: shape (24, 24).
  CongruentElements(LocalIndex owned_dofs, const std::vector<double>& stiffness,
                    const std::vector<Places>& elements);

  /// Owned dofs of the elements, some more than once.
  std::vector<LocalIndex> touched_dofs() const;

  /// q += K w on owned dofs. Allocates nothing.
  void apply(const double* owned, const double* ghosts, double* q) const;

 private:
  /// Places of lane_count elements, dof by dof; -1 fills the last batch.
  using Batch = std::array<std::array<LocalIndex, lane_count>, max_element_size>;

  LocalIndex owned_dofs_;
  std::vector<double> stiffness_;
  std::vector<Batch> batches_;
};

}  // namespace pounding
