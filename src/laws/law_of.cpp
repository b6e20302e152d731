#include "laws/law_of.h"

#include <utility>

#include "laws/dashpot_law.h"
#include "laws/tension_law.h"
#include "laws/yield_law.h"

namespace pounding::interactions {

std::vector<SpringLink> spring_links(const Region& region) {
  std::vector<SpringLink> links;
  if (is_bar(region.element)) {
    if (region.dashpot[0] > 0) links.push_back({0, SpringPart::dashpot});
    if (is_one_way(region)) links.push_back({0, SpringPart::stiffness});
  }
  if (!is_spring(region.element)) return links;
  for (int c = 0; c < static_cast<int>(region.dashpot.size()); ++c) {
    const auto component = static_cast<std::size_t>(c);
    const bool pressed = region.compression_only && c == 2;
    if (region.dashpot[component] > 0 && !pressed) links.push_back({c, SpringPart::dashpot});
    const bool slides =
        region.nonlinear.yields(component) && !region.nonlinear.yields_alone(component);
    if (slides || pressed) links.push_back({c, SpringPart::stiffness});
  }
  if (region.nonlinear.friction > 0) {
    links.push_back({region.nonlinear.circle[2], SpringPart::gauge});
  }
  return links;
}

bool has_links(const Region& region) {
  return region.nonlinear.yields() || region.foundation || !spring_links(region).empty();
}

bool is_pressed(const LinkOrigin& origin) {
  return origin.region != nullptr && is_spring(origin.region->element) &&
         origin.region->compression_only && origin.component == 2 &&
         origin.part == SpringPart::stiffness;
}

namespace {

std::unique_ptr<LinkLaw> dashpot_of(const LinkOrigin& origin, double time_step) {
  const Region& region = *origin.region;
  const double strength = origin.share * region.dashpot[origin.component];
  const double exponent = region.nonlinear.dashpot_exponent;
  const double series = origin.share * region.nonlinear.dashpot_stiffness[origin.component];
  if (series > 0) return std::make_unique<SeriesLaw>(series, strength, exponent, time_step);
  if (exponent != 1) return std::make_unique<DamperLaw>(strength, exponent, time_step);
  return std::make_unique<DashpotLaw>(strength / (2 * time_step));
}

/// Law with these arguments, less what K holds of it already where that is so.
template <typename Law, typename... Arguments>
std::unique_ptr<LinkLaw> stiff(const LinkOrigin& origin, Arguments&&... arguments) {
  if (!origin.in_stiffness) return std::make_unique<Law>(std::forward<Arguments>(arguments)...);
  return std::make_unique<RelievingLaw<Law>>(std::forward<Arguments>(arguments)...);
}

/// Law of a bar, or of a component of a spring.
std::unique_ptr<LinkLaw> stiff_law(const LinkOrigin& origin, double time_step,
                                   const UniformDamping* uniform) {
  const Region& region = *origin.region;
  const bool spring = is_spring(region.element);
  const double stiffness = spring ? origin.share * region.stiffness[origin.component]
                                  : region.material.young * region.area / origin.length;
  if (region.nonlinear.radius > 0 && region.nonlinear.is_in_circle(origin.component)) {
    return stiff<PendulumLaw>(origin, stiffness, region.nonlinear.hardening,
                              region.nonlinear.radius);
  }
  const auto component = static_cast<std::size_t>(origin.component);
  if (region.nonlinear.yields(component)) {
    return stiff<YieldLaw>(origin, stiffness, region.nonlinear.hardening,
                           region.nonlinear.yield_force[component], region.nonlinear.friction > 0);
  }
  // The elongation of a compression-only spring is how far it is pressed down.
  const double damping = origin.beta * stiffness + (spring ? origin.share * region.dashpot[2] : 0);
  const double rate = damping / (2 * time_step);
  const double slack = region.nonlinear.slack;
  if (uniform == nullptr) return stiff<TensionLaw>(origin, stiffness, rate, slack);
  std::vector<MaxwellBranch> branches;
  for (const DampingFilter& filter : uniform->filters) {
    branches.push_back({uniform->at_rest() * filter.weight * stiffness, filter.rate});
  }
  return stiff<TensionLaw>(origin, stiffness, rate, slack, uniform->at_rest(), std::move(branches),
                           time_step);
}

}  // namespace

std::unique_ptr<LinkLaw> law_of(const LinkOrigin& origin, double time_step,
                                const UniformDamping* uniform) {
  if (origin.region == nullptr) {
    return std::make_unique<DashpotLaw>(origin.absorbing / (2 * time_step));
  }
  const Region& region = *origin.region;
  if (region.foundation) {
    return std::make_unique<SoilLaw>(region.foundation->impedances[origin.component].impedance,
                                     time_step);
  }
  if (origin.part == SpringPart::gauge) return std::make_unique<GaugeLaw>();
  if (origin.part == SpringPart::dashpot) return dashpot_of(origin, time_step);
  return stiff_law(origin, time_step, uniform);
}

}  // namespace pounding::interactions
