#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace pounding {

/// Doubts about a synthetic motion that are there before it is made. Throws UserError as
/// GroundMotion does, but for a target that stays out of reach. `name` is that of messages.
std::vector<std::string> synthetic_doubts(const std::string& name,
                                          const MotionComponent& component);

}  // namespace pounding
