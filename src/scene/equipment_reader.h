#pragma once

#include <string>

#include "scene/equipment.h"
#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// Item of equipment `name` of a scene whose probes and spectra are known. Throws UserError: no
/// such probe, one that records single nodes, a damping ratio without spectra, a band upside down.
Equipment read_equipment(OptionReader& options, const Scene& scene, const std::string& name);

}  // namespace pounding
