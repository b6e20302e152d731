#pragma once

#include <string>
#include <vector>

#include <mpi.h>

#include "scene/member_table.h"

namespace pounding {

/// Lines that tell what the results of an ensemble follow from: the scene's options but those that
/// leave them as they are, the table, the files that both name (by their content) and the time step
/// [s]. `resolved`: options in force; `opened`: further files, of which the meshes are made. Rank 0
/// reads the files, and knows `opened`. Throws UserError. Collective.
std::vector<std::string> ensemble_identity(MPI_Comm comm, const std::string& resolved,
                                           const MemberTable& table,
                                           const std::vector<std::string>& opened,
                                           double time_step);

}  // namespace pounding
