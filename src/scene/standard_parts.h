#pragma once

#include <string>
#include <string_view>

#include "scene/option_table.h"

namespace pounding {

/// The options, with those of the standard sections and materials that they name and that the user
/// did not give himself: whose own option there is wins. A section takes the numbers of its
/// `profile`, or if it has none those of its name. Throws UserError for a profile that is no
/// standard section.
OptionsDatabase with_standard_parts(const OptionsDatabase& given);

/// "; did you mean HEB160?" of the standard sections and materials, or "".
std::string standard_section_suggestion(std::string_view name);
std::string standard_material_suggestion(std::string_view name);

}  // namespace pounding
