#pragma once

#include "mesh/mesh.h"
#include "modal/lanczos.h"
#include "modal/modal_analysis.h"
#include "modal/modal_basis.h"
#include "scene/scene.h"
#include "system/linear_system.h"

namespace pounding {

/// Damping ratio at a circular frequency [rad/s]: alpha / (2 omega) + beta omega / 2; 0 at rest.
double damping_ratio(const Rayleigh& damping, double omega);

/// Critical time step [s] of central differences with lagged Rayleigh damping at omega_max [rad/s]:
/// Eq. 12 of Ambiel et al. 2022, which is exact for this scheme, in the form that does not cancel,
/// 2 / (sqrt(omega^2 + (xi omega)^2) + xi omega). Infinite where nothing vibrates. For a structure
/// whose damping is Rayleigh's everywhere; see `stability_limit` for the others.
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

/// The stable time step [s] of central differences with lagged damping for any damping: the dt at
/// which 4 M - 2 dt C - dt^2 K, C with the regions' own damping and every tension-only
/// bar taut, stops being positive definite, that is, at which the largest eigenvalue of
///
///     A(dt) = M^-1/2 (2 dt C + dt^2 K) M^-1/2
///
/// is 4. Iteration: it grows like dt^p with p from 1 to 2, found from the last two dt. The result
/// is that of the last one's upper bound and of A(s dt) <= s A(dt) for s < 1, s^2 A(dt) for s > 1:
/// on the safe side, by no more than the bound is. Infinite where nothing vibrates. Collective.
double stability_limit(const LinearSystem& system, const Mesh& mesh,
                       const EigenvalueEffort& effort = {});

/// Smallest eigenvalue of M^-1 (M - dt/2 C - dt^2/4 K) [-], any damping, from the same A(dt), on
/// the safe side: see `energy_margin` of plain Rayleigh damping. Collective.
double smallest_energy_margin(const LinearSystem& system, const Mesh& mesh, double time_step,
                              const EigenvalueEffort& effort = {});

/// Limits of the time step of a structure, of whatever kind it is. This is the only place that
/// chooses between the frequencies of a basis, the closed form of plain Rayleigh damping (Eq. 12 of
/// Ambiel et al. 2022) and an eigenvalue iteration for any other damping.
struct StructureLimits {
  LargestFrequency largest;     ///< omega_max and where it is
  double stable_time_step = 0;  ///< exact [s]; infinite where nothing vibrates
};

/// `basis` is null for a structure that is not reduced. Collective.
StructureLimits limits_of(const Structure& structure, const LinearSystem& system, const Mesh& mesh,
                          const ModalBasis* basis, const EigenvalueEffort& effort);

/// Smallest eigenvalue of M^-1 (M - dt/2 C - dt^2/4 K) at a time step [-], positive if and only if
/// the step is stable: see `energy_margin` of a system. Collective.
double energy_margin_of(const Structure& structure, const LinearSystem& system, const Mesh& mesh,
                        const ModalBasis* basis, const StructureLimits& limits, double time_step,
                        const EigenvalueEffort& effort);

}  // namespace pounding
