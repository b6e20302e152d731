#include "scene/stiffness_factor.h"

namespace pounding {

void scale_stiffness(double factor, Region& region) {
  region.material.young *= factor;
  for (double& stiffness : region.stiffness) stiffness *= factor;
  NonlinearSpring& spring = region.nonlinear;
  for (double& stiffness : spring.dashpot_stiffness) stiffness *= factor;
  spring.law = scaled(spring.law, 1 / factor, 1);
  if (spring.radius > 0) spring.hardening /= factor;  // of its dish, which stays
  for (auto* const laws : {&region.yielding.shear, &region.yielding.bending}) {
    for (std::optional<Hysteresis>& law : *laws) {
      if (law) law = scaled(*law, 1 / factor, 1);
    }
  }
  if (auto& law = region.yielding_shell.shear) law = scaled(*law, 1 / factor, 1);
}

void scale_stiffness(double factor, Structure& structure) {
  for (Region& region : structure.regions) scale_stiffness(factor, region);
}

double read_stiffness_factor(OptionReader& options, Structure& structure) {
  constexpr std::string_view pattern = "<structure>_stiffness_factor";
  const double factor = options.real(pattern, {structure.name});
  if (factor == 1) return factor;
  options.refuse_if(!structure.matrices.empty() && !structure.modal, pattern, {structure.name},
                    "not with -<structure>_matrices at full order; scale stiffness.mtx");
  if (structure.modal && structure.scales_as_a_whole()) return factor;
  scale_stiffness(factor, structure);
  return 1;
}

}  // namespace pounding
