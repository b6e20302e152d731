#include "scene/law_kinds.h"

namespace pounding {

std::vector<OwnLaw> own_laws(const Region& region) {
  std::vector<OwnLaw> laws;
  const NonlinearSpring& spring = region.nonlinear;
  const bool bar = is_bar(region.element);
  for (std::size_t c = 0; c < spring.yield_force.size(); ++c) {
    if (!spring.yields_alone(c)) continue;
    const double stiffness = bar ? region.material.young * region.area : region.stiffness[c];
    Hysteresis law = spring.law;
    if (!spring.has_skeleton()) {
      const double force = spring.yield_force[c];
      law.positive = law.negative = {{{force / stiffness, force}}, spring.hardening * stiffness};
    }
    laws.push_back({bar ? "axial" : std::string(motion_names[c]), std::move(law), c});
  }
  for (std::size_t axis = 1; axis < 3; ++axis) {
    const std::string name(1, " yz"[axis]);
    const auto& [shear, bending, axial_strength, axial_exponent] = region.yielding;
    if (const auto& law = shear[axis - 1]) laws.push_back({"shear_" + name, *law, axis, true});
    if (const auto& law = bending[axis - 1]) laws.push_back({"bending_" + name, *law, axis});
  }
  if (const auto& law = region.yielding_shell.shear) laws.push_back({"shear", *law});
  return laws;
}

bool has_element_law(const Region& region) {
  return region.yielding_shell.cracking || !own_laws(region).empty();
}

}  // namespace pounding
