#include "scene/hysteresis.h"

namespace pounding {

std::vector<std::string> YieldingSection::names() const {
  std::vector<std::string> names;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::string name(1, "yz"[axis]);
    if (shear[axis]) names.push_back("shear_" + name);
    if (bending[axis]) names.push_back("bending_" + name);
  }
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
