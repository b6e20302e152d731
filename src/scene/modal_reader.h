#pragma once

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// Reads how a structure is reduced, if it is. `structure` holds its regions: dashpots, bars with
/// tension_only and regions with damping of their own have no modes that are independent of each
/// other, and are refused. Throws UserError.
void read_model(OptionReader& options, Structure& structure);

/// Refuses parts of a scene that go with no switched structure, once contacts, loops and forces are
/// read. Throws UserError.
void check_switched(const OptionReader& options, const Scene& scene, bool ensemble);

}  // namespace pounding
