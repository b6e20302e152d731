#pragma once

#include <span>
#include <vector>

#include "dynamics/gap_watch.h"
#include "interactions/contact_problem.h"
#include "system/linear_system.h"

namespace pounding {

/// Bounds of the gap rates of structures at a time step [s] with their energy margins (see
/// EnergyNorm), the same on all ranks; `contact` may be null. `progress_interval` [s]: see
/// Progress. Collective over `comm`.
std::vector<GapWatch::Bound> gap_bounds(MPI_Comm comm, std::span<const LinearSystem> systems,
                                        std::span<const double> energy_margins, double time_step,
                                        const interactions::ContactProblem* contact,
                                        double progress_interval);

}  // namespace pounding
