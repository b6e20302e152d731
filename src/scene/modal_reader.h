#pragma once

#include <optional>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// How a structure is reduced; nothing where it is not. `structure` holds its regions: dashpots,
/// bars with tension_only and regions with damping of their own have no modes that are independent
/// of each other, and are refused. Throws UserError.
std::optional<ModalModel> read_modal_model(OptionReader& options, const Structure& structure);

}  // namespace pounding
