#pragma once

#include "scene/scene.h"

namespace pounding {

/// Damping ratio at a circular frequency [rad/s]: alpha / (2 omega) + beta omega / 2; 0 at rest.
double damping_ratio(const Rayleigh& damping, double omega);

/// Critical time step [s] of central differences with lagged Rayleigh damping at omega_max [rad/s]:
/// Eq. 12 of Ambiel et al. 2022, which is exact for this scheme, in the form that does not cancel,
/// 2 / (sqrt(omega^2 + (xi omega)^2) + xi omega). Infinite where nothing vibrates. For a structure
/// whose damping is Rayleigh's everywhere; see stability/stability_limit.h for the others.
/// `stiffening`: factor of uniform damping on K for the fastest motions, see
/// LinearSystem::stiffening.
double stable_time_step(const Rayleigh& damping, double omega_max, double stiffening = 1);

/// Smallest eigenvalue of M^-1 (M - dt/2 C - dt^2/4 s K) [-], reached at omega_max, s the
/// stiffening: the part of the kinetic energy that bounds the discrete energy from below. Positive
/// if and only if dt is stable.
double energy_margin(const Rayleigh& damping, double omega_max, double time_step,
                     double stiffening = 1);

/// `value` rounded down to six significant digits: a time step that does not depend on the last
/// bits of an eigenvalue.
double round_down(double value);

}  // namespace pounding
