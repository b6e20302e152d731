#pragma once

#include <optional>
#include <string>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// Ground motion in direction "x", "y" or "z", or the motion of a support's own if one is named. A
/// record wins over a target; the record `none` takes the motion away. Throws UserError, also for
/// an option that would have no effect.
std::optional<MotionComponent> read_motion(OptionReader& options, const std::string& direction,
                                           const std::string& support = "");

}  // namespace pounding
