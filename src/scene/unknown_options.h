#pragma once

#include <string>
#include <vector>

#include "scene/option_table.h"

namespace pounding {

/// Refuses the first option that no pattern of the table explains for these structures, naming the
/// nearest one that does. A material, section, contact or probe that is defined but not used is
/// allowed: it may be a library, or switched off by `-contacts none`. Throws UserError.
void refuse_unknown_options(const OptionsDatabase& database,
                            const std::vector<std::string>& structures);

}  // namespace pounding
