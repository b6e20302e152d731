#pragma once

#include <array>
#include <cstddef>

#include "common/types.h"

namespace pounding {

/// Row of a rigid motion: displacement (component 0-2) or rotation (3-5) of a point at `arm` from
/// the origin under unit translations along x, y, z and unit rotations about them there,
/// u = t + theta x arm.
inline std::array<double, 6> rigid_motion_row(std::size_t component, const Vector3& arm) {
  std::array<double, 6> row{};
  row[component] = 1;
  if (component < 3) {
    const std::size_t next = (component + 1) % 3;
    const std::size_t last = (component + 2) % 3;
    row[3 + next] = arm[last];
    row[3 + last] = -arm[next];
  }
  return row;
}

}  // namespace pounding
