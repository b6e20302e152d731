#pragma once

#include "mesh/mesh.h"
#include "modal/lanczos.h"
#include "system/linear_system.h"

namespace pounding {

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

}  // namespace pounding
