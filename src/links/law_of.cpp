#include "links/law_of.h"

#include <algorithm>
#include <utility>

#include "links/dashpot_law.h"
#include "links/relieving_law.h"
#include "links/soil_law.h"
#include "links/tension_law.h"

namespace pounding {

bool has_links(const Region& region) {
  return is_one_way(region) || region.foundation ||
         (is_spring(region.element) &&
          std::ranges::any_of(region.dashpot, [](double rate) { return rate > 0; }));
}

bool is_pressed(const LinkOrigin& origin) {
  return origin.region != nullptr && is_spring(origin.region->element) &&
         origin.region->compression_only && origin.component == 2;
}

std::unique_ptr<LinkLaw> law_of(const LinkOrigin& origin, double time_step) {
  if (origin.region == nullptr) {
    return std::make_unique<DashpotLaw>(origin.absorbing / (2 * time_step));
  }
  const Region& region = *origin.region;
  if (region.foundation) {
    return std::make_unique<SoilLaw>(region.foundation->impedances[origin.component], time_step);
  }
  const bool pressed = is_pressed(origin);
  if (is_spring(region.element) && !pressed) {
    return std::make_unique<DashpotLaw>(region.dashpot[origin.component] / (2 * time_step));
  }
  // The elongation of a compression-only spring is how far it is pressed down.
  const double stiffness =
      pressed ? region.stiffness[2] : region.material.young * region.area / origin.length;
  const double damping = origin.beta * stiffness + (pressed ? region.dashpot[2] : 0);
  auto law = std::make_unique<TensionLaw>(stiffness, damping / (2 * time_step));
  if (!origin.in_stiffness) return law;
  return std::make_unique<RelievingLaw>(std::move(law));
}

}  // namespace pounding
