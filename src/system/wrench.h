#pragma once

#include <array>
#include <cstddef>

#include "common/types.h"

namespace pounding {

/// Force along and moment about x, y, z [N, N m].
using Wrench = std::array<double, 6>;

/// Adds a force along, or a moment about, an axis at `x` to a wrench about `point`; `component` as
/// of dofs, 0-2 and 3-5.
inline void add_unit_force(const Vector3& point, const Vector3& x, int component, double force,
                           Wrench& wrench) {
  const auto c = static_cast<std::size_t>(component);
  wrench[c] += force;
  if (c >= 3) return;
  const std::size_t next = (c + 1) % 3;  // moment = arm x force
  const std::size_t last = (c + 2) % 3;
  wrench[3 + next] += (x[last] - point[last]) * force;
  wrench[3 + last] -= (x[next] - point[next]) * force;
}

}  // namespace pounding
