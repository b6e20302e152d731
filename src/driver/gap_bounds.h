#pragma once

#include <vector>

#include "contact/contact_problem.h"
#include "driver/model.h"
#include "dynamics/gap_watch.h"

namespace pounding {

/// What bounds the gap rates of a model's structures at its time step, the same on all ranks;
/// `contact` may be null. Collective over `comm`.
std::vector<GapWatch::Bound> gap_bounds(MPI_Comm comm, const Model& model,
                                        const ContactProblem* contact);

}  // namespace pounding
