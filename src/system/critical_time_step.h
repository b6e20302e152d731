#pragma once

#include <cmath>

namespace pounding {

/// Time step [s] above which central differences with lagged damping let a motion x grow, from its
/// Rayleigh quotients c = x^T C x / x^T M x [1/s] and k = x^T K x / x^T M x [1/s2]:
///
///     4 - 2 dt c - dt^2 k = 0,      dt = 4 / (c + sqrt(c^2 + 4 k))
///
/// The scheme is stable if and only if dt is below this for every x, that is, if 4 M - 2 dt C -
/// dt^2 K is positive definite. Infinite where c and k are 0.
inline double critical_time_step(double damping_rate, double squared_frequency) {
  return 4 / (damping_rate + std::hypot(damping_rate, 2 * std::sqrt(squared_frequency)));
}

}  // namespace pounding
