#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scene/scene.h"

namespace pounding {

/// Describes the groups of a structure for summary.json, as they were used: element, material and
/// section with their names and numbers, standard ones in full, and whatever else is not nothing.
/// SI units.
nlohmann::ordered_json describe_regions(const Structure& structure);

}  // namespace pounding
