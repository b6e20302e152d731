#pragma once

#include <array>

#include "system/lanes.h"

/// What the kernels of bricks, rectangles and segments share: blocks of B, lane by lane.
namespace pounding {

#define POUNDING_INLINE static inline __attribute__((always_inline))

/// (x, y) <- B (x, y), B = 00 01 11.
POUNDING_INLINE void multiply2(const std::array<double, 3>& b, Lanes& x, Lanes& y) {
  const Lanes first = b[0] * x + b[1] * y;
  y = b[1] * x + b[2] * y;
  x = first;
}

/// (x, y, z) <- B (x, y, z), B = 00 01 02 11 12 22.
POUNDING_INLINE void multiply3(const std::array<double, 6>& b, Lanes& x, Lanes& y, Lanes& z) {
  const Lanes first = b[0] * x + b[1] * y + b[2] * z;
  const Lanes second = b[1] * x + b[3] * y + b[4] * z;
  z = b[2] * x + b[4] * y + b[5] * z;
  x = first;
  y = second;
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
  const Lanes shifted = __builtin_shuffle(carry, far, LaneMask{3, 4, 5, 6});
  carry = far;
  return shifted;
}

}  // namespace pounding
