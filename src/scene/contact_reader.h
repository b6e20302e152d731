#pragma once

#include <string>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// A contact of the scene, whose structures are read: its sides, gap, filler, strip or stop. Places
/// given by points become groups of their structures. Throws UserError on gaps that it cannot have,
/// tables that are none, and options that do not go together.
Contact read_contact(OptionReader& options, Scene& scene, const std::string& name);

}  // namespace pounding
