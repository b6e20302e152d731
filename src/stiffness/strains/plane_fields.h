#pragma once

#include "stiffness/strains/lane_arithmetic.h"

/// Strains of a vector field in a plane, of a batch of elements at once.
namespace pounding::stiffness {

/// Gradient of a field times J: (y_r f_p - y_p f_r, x_p f_r - x_r f_p).
struct PlaneGradient {
  ElementLanes x, y;
};

/// Two vectors of the plane between which gradients are taken.
struct PlaneFrame {
  ElementLanes x_p, y_p, x_r, y_r;

  __attribute__((always_inline)) PlaneGradient gradient(const ElementLanes& f_p,
                                                        const ElementLanes& f_r) const {
    return {less(y_r * f_p, y_p, f_r), less(x_p * f_r, x_r, f_p)};
  }
  /// Force that works on f_p; the next one, on f_r.
  __attribute__((always_inline)) ElementLanes along_p(const PlaneGradient& g) const {
    return less(y_r * g.x, x_r, g.y);
  }
  __attribute__((always_inline)) ElementLanes along_r(const PlaneGradient& g) const {
    return less(x_p * g.y, y_p, g.x);
  }
};

/// Stress of plane strains: moduli of the sum, and of the difference and slip. The gradients of
/// both components become what works on them.
static inline __attribute__((always_inline)) void plane_stress(const ElementLanes* moduli,
                                                               PlaneGradient& of_x,
                                                               PlaneGradient& of_y) {
  const ElementLanes sum = moduli[0] * (of_x.x + of_y.y);
  const ElementLanes difference = moduli[1] * (of_x.x - of_y.y);
  const ElementLanes slip = moduli[1] * (of_x.y + of_y.x);
  of_x = {sum + difference, slip};
  of_y = {slip, sum - difference};
}

}  // namespace pounding::stiffness
