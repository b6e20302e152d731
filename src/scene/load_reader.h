#pragma once

#include <string>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// Load `name` of a scene whose structures are known. Reads its table, if it has one. Throws
/// UserError: no such structure, no force or only zeros, a history of two kinds, a table that is
/// none, options of another load that is worked out no further.
Load read_load(OptionReader& options, const Scene& scene, const std::string& name);

/// An item of `forces`. Throws UserError.
ForceItem read_force(OptionReader& options, const Scene& scene, const std::string& name);

}  // namespace pounding
