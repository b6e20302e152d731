#pragma once

#include <string>
#include <vector>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// The supports of a structure: physical groups, each with the components that it loses if those
/// are not all of them, `mid:y+rx+rz`. Throws UserError.
std::vector<Clamp> read_clamps(OptionReader& options, const std::string& structure);

}  // namespace pounding
