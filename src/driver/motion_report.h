#pragma once

#include <nlohmann/json_fwd.hpp>

#include "motion/ground_motion.h"

/// Describes the ground motion as it was understood, for the user to see.
namespace pounding {

/// Two lines per direction on standard output: the file and how it was read, then how it is scaled.
void print_motion(const GroundMotion& motion);

/// Describes the motion for summary.json: an object per direction, null without a motion.
nlohmann::ordered_json describe_motion(const GroundMotion& motion);

}  // namespace pounding
