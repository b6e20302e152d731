#pragma once

#include <map>
#include <string>

#include "driver/model.h"
#include "output/checkpoint.h"

namespace pounding {

/// The options that a continued run has in common with the run before; `resolved`: those in force.
/// On rank 0 also the contents of matrices brought in. Throws UserError on every rank alike.
/// Collective.
std::map<std::string, std::string> lasting_options(MPI_Comm comm, const std::string& resolved);

/// Identity of a run, with which a checkpoint is compared. Collective.
RunIdentity identity_of(MPI_Comm comm, const std::string& resolved, const Model& model);

}  // namespace pounding
