#pragma once

#include "soil/impedance.h"

namespace pounding {

/// Underside of a mat: a rectangle with its sides along x and y, or a disk.
struct Footprint {
  bool disk = false;
  std::array<double, 2> sides{};  ///< full, along x and y; of a disk both the diameter [m]
  double embedment = 0;           ///< depth of the underside below the surface; rectangle only [m]

  /// B, half of the shorter side, or R, the radius: the length of a0 = omega B / V_s [m].
  double half_width() const { return (sides[0] < sides[1] ? sides[0] : sides[1]) / 2; }
};

/// a0 up to which the frequency dependence of the formulas is meant to hold [-].
inline constexpr double largest_a0 = 2;

/// Impedances of a mat's soil, by the rectangle or the disk.
Impedances impedances_of(const HalfSpace& soil, const Footprint& footprint);

/// Impedances that do not depend on the frequency: the static springs of those given, and dashpots
/// to the ground with the rates that they have at a0 = 1.
Impedances without_frequency_dependence(Impedances impedances, const HalfSpace& soil,
                                        const Footprint& footprint);

}  // namespace pounding
