#pragma once

#include <vector>

#include "system/linear_system.h"

namespace pounding {

/// Whether uniform damping of a system acts on the motion about the rest that the run starts from:
/// K u_0 + s G K (u - u_0) in place of K u. False where this rank owns none of its dofs.
bool damped_about_rest(const LinearSystem& system);

/// Whether it does so, the same on all ranks. Collective over the system's communicator.
bool any_damped_about_rest(const LinearSystem& system);

/// K u_0 of the owned dofs where that is so, else nothing [N, N m]. Collective likewise.
std::vector<double> rest_forces(const LinearSystem& system);

}  // namespace pounding
