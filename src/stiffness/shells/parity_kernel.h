#pragma once

#include <array>

#include "common/lanes.h"

/// Blocks of B, lane by lane: the common part of the kernels of rectangles and segments.
namespace pounding::stiffness {

/// c += b x for a number b.
POUNDING_INLINE void add_times(double b, const Lanes& x, Lanes& c) {
  add_product(Lanes{b, b, b, b}, x, c);
}

/// (x, y) <- B (x, y), B = 00 01 11.
POUNDING_INLINE void multiply2(const std::array<double, 3>& b, Lanes& x, Lanes& y) {
  Lanes first = b[0] * x;
  Lanes second = b[1] * x;
  add_times(b[1], y, first);
  add_times(b[2], y, second);
  x = first;
  y = second;
}

/// (x, y, z) <- B (x, y, z), B = 00 01 02 11 12 22.
POUNDING_INLINE void multiply3(const std::array<double, 6>& b, Lanes& x, Lanes& y, Lanes& z) {
  Lanes first = b[0] * x;
  Lanes second = b[1] * x;
  Lanes third = b[2] * x;
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
POUNDING_INLINE LaneMask lanes_below(int left) {
  const LaneMask lane{0, 1, 2, 3};
  return lane < LaneMask{left, left, left, left};
}

POUNDING_INLINE void mask_lanes(const LaneMask& keep, Lanes& values) {
  values = (Lanes)((LaneMask)values & keep);
}

/// Forces of the far ends at nodes i .. i + 3: those of elements i .. i + 2 reach the nodes
/// i + 1 .. i + 3, the last one's is kept in `carry` for the next call, which takes it out at i.
POUNDING_INLINE Lanes carry_over(const Lanes& far, Lanes& carry) {
  const Lanes shifted = __builtin_shufflevector(carry, far, 3, 4, 5, 6);
  carry = far;
  return shifted;
}

}  // namespace pounding::stiffness
