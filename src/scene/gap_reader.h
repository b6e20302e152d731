#pragma once

#include <string>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// The gap of a contact of the name: values, random part, and patches. Throws UserError on values
/// that it cannot have, by their count or of a wall without one.
InitialGap read_gap(OptionReader& options, const std::string& contact, bool is_wall);

}  // namespace pounding
