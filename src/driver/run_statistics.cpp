#include "driver/run_statistics.h"

#include <algorithm>
#include <cmath>

namespace pounding {

interactions::LinkTotals LoopReport::whole() const {
  interactions::LinkTotals most;
  for (const interactions::LinkTotals& link : totals) {
    most.largest_elongation = std::max(most.largest_elongation, link.largest_elongation);
    most.largest_force = std::max(most.largest_force, link.largest_force);
    most.work += link.work;
    most.yielded += link.yielded;
  }
  return most;
}

std::size_t ForceReport::largest(std::size_t component) const {
  std::size_t best = 0;
  const auto size = [&](std::size_t e) {
    return std::abs(peaks[e * components.size() + component].value);
  };
  for (std::size_t e = 1; e < elements.size(); ++e) best = size(e) > size(best) ? e : best;
  return best;
}

}  // namespace pounding
