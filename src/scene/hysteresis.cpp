#include "scene/hysteresis.h"

namespace pounding {

std::vector<YieldingSection::Law> YieldingSection::laws() const {
  std::vector<Law> laws;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    const std::string name(1, " yz"[axis]);
    if (const auto& law = shear[axis - 1]) laws.push_back({"shear_" + name, &*law, true, axis});
    if (const auto& law = bending[axis - 1]) {
      laws.push_back({"bending_" + name, &*law, false, axis});
    }
  }
  return laws;
}

std::vector<std::string> YieldingSection::names() const {
  std::vector<std::string> names;
  for (const Law& law : laws()) names.push_back(law.name);
  return names;
}

Hysteresis scaled(const Hysteresis& law, double length, double strength) {
  Hysteresis result = law;
  for (Skeleton* skeleton : {&result.positive, &result.negative}) {
    skeleton->last_slope *= strength / length;
    for (SkeletonBreak& corner : skeleton->breaks) {
      corner.elongation *= length;
      corner.force *= strength;
    }
  }
  result.lasting_energy *= length * strength;
  return result;
}

}  // namespace pounding
