#include "interactions/yield_groups.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace pounding::interactions {

YieldGroups::YieldGroups(std::span<const Link> links) {
  std::map<std::int64_t, std::size_t> circles;  // by element
  std::map<std::int64_t, int> gauges;
  for (std::size_t b = 0; b < links.size(); ++b) {
    const LinkOrigin& origin = links[b].origin;
    const auto component = static_cast<std::size_t>(origin.component);
    if (origin.part == SpringPart::gauge) gauges[links[b].number] = static_cast<int>(b);
    if (origin.section) groups_.push_back({{b}});
    if (origin.section || origin.part != SpringPart::stiffness || origin.region == nullptr ||
        !origin.region->nonlinear.yields(component)) {
      continue;
    }
    const NonlinearSpring& spring = origin.region->nonlinear;
    std::size_t place = groups_.size();
    if (spring.is_in_circle(component)) {
      place = circles.try_emplace(links[b].number, place).first->second;
    }
    if (place == groups_.size()) groups_.emplace_back();
    groups_[place].links.push_back(b);
    groups_[place].pressing = origin.region->stiffness[spring.circle[2]];
    // Hardening carries its part without friction; a pendulum's slope is apart from it.
    const double part = spring.radius > 0 ? 1 : 1 - spring.hardening;
    groups_[place].friction = spring.friction * part * groups_[place].pressing;
  }
  for (const auto& [number, place] : circles) {
    const auto gauge = gauges.find(number);
    if (gauge != gauges.end()) groups_[place].gauge = gauge->second;
  }
}

void YieldGroups::yield(std::span<const std::unique_ptr<LinkLaw>> laws, std::span<const double> now,
                        LawMemory& memory) const {
  for (const Group& group : groups_) {
    const double pressed = group.gauge < 0 ? 0 : std::max(0.0, -now[group.gauge]);
    double square = 0;
    for (const std::size_t b : group.links) {
      square += std::pow(laws[b]->trial(now[b], memory[b]), 2);
    }
    const double size = std::sqrt(square);
    const double capacity =
        group.gauge < 0 ? laws[group.links.front()]->capacity() : group.friction * pressed;
    const double kept = size > capacity ? capacity / size : 1;
    for (const std::size_t b : group.links) {
      laws[b]->yield(now[b], kept, memory[b]);
      if (group.gauge >= 0) laws[b]->press(group.pressing * pressed, memory[b]);
    }
  }
}

}  // namespace pounding::interactions
