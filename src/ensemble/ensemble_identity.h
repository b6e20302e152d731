#pragma once

#include <string>
#include <vector>

#include <mpi.h>

#include "scene/member_table.h"

namespace pounding {

/// Lines of the sources of an ensemble's results: the scene's options but those that leave them as
/// they are, and the table. `resolved`: options in force.
std::vector<std::string> ensemble_identity(const std::string& resolved, const MemberTable& table);

/// Lines of the files that scene and table name, and of `opened`, of which the meshes are made: by
/// their content. Rank 0 reads the files, and knows `opened`. Throws UserError. Collective.
std::vector<std::string> identity_of_files(MPI_Comm comm, const std::string& resolved,
                                           const MemberTable& table,
                                           const std::vector<std::string>& opened);

}  // namespace pounding
