#pragma once

#include "mesh/mesh.h"
#include "system/linear_system.h"

namespace pounding {

/// The exact stable time step [s] of central differences with lagged damping for any damping: the
/// dt at which 4 M - 2 dt C - dt^2 K, C with dashpots and the regions' own damping and every
/// tension-only bar taut, stops being positive definite. Iteration: the eigenvector of the largest
/// eigenvalue of
///
///     A(dt) = M^-1/2 (2 dt C + dt^2 K) M^-1/2
///
/// at one dt gives the next, its `critical_time_step`; they fall to the limit, the last ones
/// quadratically. The error bound of the eigenvalue is taken off, so that the result is on the safe
/// side. Infinite where nothing vibrates. Throws std::runtime_error if an eigenvalue does not
/// converge. Collective.
double stability_limit(const LinearSystem& system, const Mesh& mesh);

/// Smallest eigenvalue of M^-1 (M - dt/2 C - dt^2/4 K) [-], any damping, from the same A(dt), on
/// the safe side likewise: see `energy_margin` of plain Rayleigh damping. Collective.
double smallest_energy_margin(const LinearSystem& system, const Mesh& mesh, double time_step);

}  // namespace pounding
