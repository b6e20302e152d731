#pragma once

#include <nlohmann/json_fwd.hpp>

#include "motion/ground_motion.h"
#include "motion/support_motion.h"

/// Describes the ground motion as it was understood, for the user to see.
namespace pounding {

/// Two lines per direction on standard output: the file and how it was read, then how it is scaled;
/// and a line for each component in which a support moves otherwise. `supports` may be null.
void print_motion(const GroundMotion& motion, const SupportMotion* supports);

/// Describes the motion for summary.json: an object per direction, null without a motion.
nlohmann::ordered_json describe_motion(const GroundMotion& motion);

/// Describes the supports likewise: an object per component in which one moves otherwise.
nlohmann::ordered_json describe_supports(const SupportMotion& supports);

}  // namespace pounding
