#pragma once

#include <array>

#include "common/wide_lanes.h"

/// Blocks of B, lane by lane, and elements of a run beside each other.
namespace pounding::stiffness {

/// c += b x for a number b.
POUNDING_INLINE void add_times(double b, const WideLanes& x, WideLanes& c) {
  add_product(all_wide(b), x, c);
}

/// (x, y) <- B (x, y), B = 00 01 11.
POUNDING_INLINE void multiply2(const std::array<double, 3>& b, WideLanes& x, WideLanes& y) {
  WideLanes first = b[0] * x;
  WideLanes second = b[1] * x;
  add_times(b[1], y, first);
  add_times(b[2], y, second);
  x = first;
  y = second;
}

/// (x, y, z) <- B (x, y, z), B = 00 01 02 11 12 22.
POUNDING_INLINE void multiply3(const std::array<double, 6>& b, WideLanes& x, WideLanes& y,
                               WideLanes& z) {
  WideLanes first = b[0] * x;
  WideLanes second = b[1] * x;
  WideLanes third = b[2] * x;
  add_times(b[1], y, first);
  add_times(b[3], y, second);
  add_times(b[4], y, third);
  add_times(b[2], z, first);
  add_times(b[4], z, second);
  add_times(b[5], z, third);
  x = first;
  y = second;
  z = third;
}

/// All bits set in the lanes of elements that a run of which `left` are left still has.
POUNDING_INLINE WideMask lanes_below(int left) {
  return lane_numbers < static_cast<std::int64_t>(left);
}

/// Forces of the far ends at the nodes of a vector from node i on: those of the elements from i on
/// reach the nodes from i + 1 on, the last one's is kept in `carry` for the next call, which takes
/// it out at its first node.
POUNDING_INLINE WideLanes carry_over(const WideLanes& far, WideLanes& carry) {
  const WideLanes shifted = shifted_back(carry, far);
  carry = far;
  return shifted;
}

}  // namespace pounding::stiffness
