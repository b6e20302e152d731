#pragma once

#include <limits>

#include "stability/resolved_motion.h"

namespace pounding {

/// Bounds of the time step of a run.
struct StepLimits {
  double stable = std::numeric_limits<double>::infinity();  ///< the stable step [s]
  ResolvedMotion resolved;                                  ///< the fastest motion to be resolved
};

/// The limit that a time step in force comes from.
enum class StepSource { given, stability, resolution, samples };

}  // namespace pounding
