#pragma once

#include <string>

#include "scene/option_table.h"
#include "scene/scene.h"

namespace pounding {

struct ReadScene {
  Scene scene;
  OptionValues resolved;                  ///< all options in force, see resolved_values
  std::vector<double> stiffness_factors;  ///< per structure; those at full order have them already
  std::string ensemble;                   ///< table of runs to be made at once; empty: one run
};

/// The scene that the options describe. Throws UserError: an option missing, unknown (with the
/// nearest known name), of the wrong kind, out of range, or at odds with another one.
ReadScene read_scene(const OptionsDatabase& database);

}  // namespace pounding
