#include "interactions/interaction.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pounding::interactions {

void LinkRecords::watch(std::vector<std::size_t> links, bool push_only) {
  push_only_ = push_only;
  links_ = std::move(links);
  elongation_.assign(links_.size(), 0.0);
  force_.assign(links_.size(), 0.0);
  totals_.assign(links_.size(), {});
}

void LinkRecords::note(std::size_t k, double elongation, double force, bool yielded) {
  elongation_[k] = elongation;
  force_[k] = force;
  LinkTotals& totals = totals_[k];
  const double size = push_only_ ? std::max(0.0, elongation) : std::abs(elongation);
  totals.largest_elongation = std::max(totals.largest_elongation, size);
  totals.largest_force = std::max(totals.largest_force, std::abs(force));
  if (yielded) totals.yielded = 1;
}

void LinkRecords::keep(const std::vector<std::string>& names, const StateKeeper& state) {
  for (std::size_t k = 0; k < links_.size(); ++k) {
    LinkTotals& t = totals_[k];
    state.numbers(names[k], t.largest_elongation, t.largest_force, t.work, t.yielded);
  }
}

}  // namespace pounding::interactions
