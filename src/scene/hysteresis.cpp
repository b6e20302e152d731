#include "scene/hysteresis.h"

namespace pounding {

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
