#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/types.h"
#include "dynamics/damping_filters.h"
#include "dynamics/update.h"

namespace pounding {

/// Nodal forces of a step at a few dofs of a structure, kept as the product hands them over: q, and
/// the force f that uniform damping filters, that of inelastic elements apart. The product leaves
/// no array of them. `Number`: see StateOf.
template <typename Number>
class KeptForces {
 public:
  /// `dofs`: owned ones.
  explicit KeptForces(std::size_t dofs) : dof_count_(dofs) {}

  /// Forces at these owned dofs, too, will be kept. Allocates; before the first step.
  void watch(std::span<const LocalIndex> dofs);
  bool none() const { return dofs_.empty(); }

  /// Keeps the forces q of the dofs [begin, end), force[0] that of `begin`, and f by the memories
  /// before the step, by filter over the owned dofs; `inelastic`: forces that are filtered with q,
  /// over the owned dofs, or empty.
  void take(LocalIndex begin, LocalIndex end, const Number* force,
            std::span<const Number> inelastic, const Filters<Number>& filters,
            std::span<const std::vector<Number>> memories);
  /// Forces of a watched dof in the last step in which they were kept.
  const DofForces<Number>& at(LocalIndex dof) const { return forces_[slot(dof)]; }

 private:
  static constexpr int block = 16;  ///< dofs that share an entry of first_

  /// Number of the first watched dof that is not before `dof`.
  std::size_t slot(LocalIndex dof) const {
    auto k = static_cast<std::size_t>(first_[static_cast<std::size_t>(dof) / block]);
    while (dofs_[k] < dof) ++k;
    return k;
  }

  std::size_t dof_count_;
  std::vector<LocalIndex> dofs_;     ///< increasing, one more than all owned dofs at its end
  std::vector<std::int32_t> first_;  ///< per block, number of the first watched dof from there on
  std::vector<DofForces<Number>> forces_;
};

}  // namespace pounding
