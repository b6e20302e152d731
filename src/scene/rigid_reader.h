#pragma once

#include <string>
#include <vector>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// The groups of a structure that move together. Throws UserError if one stands there twice.
std::vector<RigidGroup> read_rigid_groups(OptionReader& options, const std::string& structure);

}  // namespace pounding
