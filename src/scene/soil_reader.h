#pragma once

#include <optional>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// The soil under a structure's mat, if it is asked for. Throws UserError.
std::optional<Soil> read_soil(OptionReader& options, const Structure& structure);

/// The region of a soil's element, whose foundation is known once the mesh is.
Region soil_region(const Soil& soil);

/// Gives the soil of a structure its foundation: springs, dashpots, arm.
void lay_foundation(const MatOutline& outline, Structure& structure);

}  // namespace pounding
