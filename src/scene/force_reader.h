#pragma once

#include <string>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// An item of `forces`. Throws UserError.
ForceItem read_force(OptionReader& options, const Scene& scene, const std::string& name);

}  // namespace pounding
