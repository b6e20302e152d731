#pragma once

#include <string>
#include <vector>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// The groups of a structure that move together. Throws UserError if one is listed twice.
std::vector<RigidGroup> read_rigid_groups(OptionReader& options, const std::string& structure);

/// Makes the mat of a structure on soil rigid, unless it is already.
void make_mat_rigid(Structure& structure);

}  // namespace pounding
