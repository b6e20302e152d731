#pragma once

#include <nlohmann/json_fwd.hpp>

#include "contact/absorbing_faces.h"
#include "scene/scene.h"

namespace pounding {

/// Prints the absorbing faces of a structure and which of them the motion enters through; nothing
/// without such faces.
void print_absorbing(const Structure& structure, const AbsorbingReport& report);

/// Absorbing faces of a structure for the summary, in SI.
nlohmann::ordered_json describe_absorbing(const Structure& structure,
                                          const AbsorbingReport& report);

/// Frequency of a0 = 2, up to which the impedances of a mat's soil are meant to hold [Hz].
double largest_soil_frequency(const Soil& soil, const Foundation& foundation);

/// Prints the soil under a structure's mat, its impedances and the frequency up to which they hold;
/// nothing without soil.
void print_soil(const Structure& structure);

/// Soil under a mat for the summary, in SI. The structure has soil and its foundation is known.
nlohmann::ordered_json describe_soil(const Structure& structure);

}  // namespace pounding
