#pragma once

#include <string>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// A structure with its regions (in alphabetical order of their groups), materials and sections.
/// Throws UserError.
Structure read_structure(OptionReader& options, const std::string& name);

}  // namespace pounding
