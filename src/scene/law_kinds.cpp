#include "scene/law_kinds.h"

#include <algorithm>
#include <array>

namespace pounding {
namespace {

constexpr LawTrait in_k = is_nonlinear | has_element_law;
constexpr LawTrait beside_k = is_nonlinear | follows_law;

// clang-format off
constexpr std::array law_kinds{
    LawKind{"<structure>_<group>_shear_skeleton_y", [](const Region& r) { return r.yielding.shear[0].has_value(); }, in_k},
    LawKind{"<structure>_<group>_shear_skeleton_z", [](const Region& r) { return r.yielding.shear[1].has_value(); }, in_k},
    LawKind{"<structure>_<group>_bending_skeleton_y", [](const Region& r) { return r.yielding.bending[0].has_value(); }, in_k},
    LawKind{"<structure>_<group>_bending_skeleton_z", [](const Region& r) { return r.yielding.bending[1].has_value(); }, in_k},
    LawKind{"<structure>_<group>_bending_axial", [](const Region& r) { return r.yielding.axial_strength > 0; }, is_full_order},
    LawKind{"<structure>_<group>_shear_skeleton", [](const Region& r) { return r.yielding_shell.shear.has_value(); }, in_k | is_full_order},
    LawKind{"<structure>_<group>_cracking_force", [](const Region& r) { return r.yielding_shell.cracking.has_value(); }, in_k | is_full_order},
    LawKind{"<structure>_<group>_compression_only", [](const Region& r) { return r.compression_only; }, beside_k | is_one_way},
    LawKind{"<structure>_<group>_sliding_friction", [](const Region& r) { return r.nonlinear.friction > 0; }, beside_k},
    LawKind{"<structure>_<group>_skeleton", [](const Region& r) { return r.nonlinear.has_skeleton(); }, beside_k | has_element_law},
    LawKind{"<structure>_<group>_yield_force", [](const Region& r) { return r.nonlinear.yields_alone(); }, beside_k | has_element_law},
    LawKind{"<structure>_<group>_yield_force", [](const Region& r) { return r.nonlinear.yields(); }, beside_k},
    LawKind{"<structure>_<group>_tension_only", [](const Region& r) { return r.element == ElementType::tension_bar; }, beside_k | is_one_way},
    LawKind{"<structure>_<group>_dashpot_exponent", [](const Region& r) { return r.nonlinear.dashpot_exponent != 1; }, has_power},
    LawKind{"<structure>_<group>_dashpot_stiffness", [](const Region& r) { return *std::ranges::max_element(r.nonlinear.dashpot_stiffness) > 0; }, has_series},
};
// clang-format on

}  // namespace

const LawKind* LawTrait::of(const Region& region) const {
  const auto* const kind = std::ranges::find_if(law_kinds, [&](const LawKind& each) {
    return (each.traits.bits & bits) != 0 && each.is_of(region);
  });
  return kind == law_kinds.end() ? nullptr : kind;
}

std::vector<OwnLaw> own_laws(const Region& region) {
  std::vector<OwnLaw> laws;
  const NonlinearSpring& spring = region.nonlinear;
  const YieldingSection& beam = region.yielding;
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
    if (const auto& law = beam.shear[axis - 1]) laws.push_back({"shear_" + name, *law, axis, true});
    if (const auto& law = beam.bending[axis - 1]) laws.push_back({"bending_" + name, *law, axis});
  }
  if (const auto& law = region.yielding_shell.shear) laws.push_back({"shear", *law});
  return laws;
}

}  // namespace pounding
