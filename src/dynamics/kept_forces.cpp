#include "dynamics/kept_forces.h"

#include <algorithm>
#include <limits>

#include "common/batch_value.h"

namespace pounding {

template <typename Number>
void KeptForces<Number>::watch(std::span<const LocalIndex> dofs) {
  if (dofs.empty()) return;
  if (!dofs_.empty()) dofs_.pop_back();
  dofs_.insert(dofs_.end(), dofs.begin(), dofs.end());
  std::ranges::sort(dofs_);
  dofs_.erase(std::ranges::unique(dofs_).begin(), dofs_.end());
  forces_.assign(dofs_.size(), {});
  first_.assign(dof_count_ / block + 1, 0);
  std::size_t k = 0;
  for (std::size_t b = 0; b < first_.size(); ++b) {
    while (k < dofs_.size() && static_cast<std::size_t>(dofs_[k]) < b * block) ++k;
    first_[b] = static_cast<std::int32_t>(k);
  }
  dofs_.push_back(std::numeric_limits<LocalIndex>::max());
}

template <typename Number>
void KeptForces<Number>::take(LocalIndex begin, LocalIndex end, const Number* force,
                              std::span<const Number> inelastic, const Filters<Number>& filters,
                              std::span<const std::vector<Number>> memories) {
  for (std::size_t k = slot(begin); dofs_[k] < end; ++k) {
    const auto dof = static_cast<std::size_t>(dofs_[k]);
    const Number q = force[dofs_[k] - begin];
    const auto memory = [&](std::size_t i) { return memories[i][dof]; };
    const Number apart = inelastic.empty() ? Number{} : inelastic[dof];
    forces_[k] = {q, filtered_force(filters, q + apart, memory) - apart};
  }
}

template class KeptForces<double>;
template class KeptForces<BatchValue>;

}  // namespace pounding
