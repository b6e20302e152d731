#include "links/law_of.h"

#include <algorithm>
#include <utility>

#include "links/dashpot_law.h"
#include "links/relieving_law.h"
#include "links/tension_law.h"

namespace pounding {

bool has_links(const Region& region) {
  return !is_linear(region.element) ||
         (is_spring(region.element) &&
          std::ranges::any_of(region.dashpot, [](double rate) { return rate > 0; }));
}

std::unique_ptr<LinkLaw> law_of(const LinkOrigin& origin, double time_step) {
  const Region& region = *origin.region;
  if (is_spring(region.element)) {
    return std::make_unique<DashpotLaw>(region.dashpot[origin.component] / (2 * time_step));
  }
  const double stiffness = region.material.young * region.area / origin.length;
  auto law = std::make_unique<TensionLaw>(stiffness, origin.beta * stiffness / (2 * time_step));
  if (!origin.in_stiffness) return law;
  return std::make_unique<RelievingLaw>(std::move(law));
}

}  // namespace pounding
