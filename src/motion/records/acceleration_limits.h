#pragma once

namespace pounding {

/// One g [m/s2]: the standard value, used for every file in g.
inline constexpr double standard_gravity = 9.80665;

/// Peak of a file in g beyond any ground motion [m/s2], 20 g: the unit is wrong.
inline constexpr double largest_peak = 20 * standard_gravity;

/// Beyond any study of a scheme's limits and any system of units [m/s2], ten thousand g.
inline constexpr double impossible_peak = 1e4 * standard_gravity;

/// Displacement [m] of a ground up to which it may jump whatever the acceleration.
inline constexpr double possible_jump = 1;

}  // namespace pounding
