#pragma once

#include <string_view>

#include "scene/option_reader.h"
#include "scene/region.h"

namespace pounding {

/// The option that gives a group by points.
inline constexpr std::string_view points_option = "<structure>_<group>_points";

/// A group of elements with its material, section, springs and laws. `names`: of the structure and
/// of the group; `inherited`: damping of the structure. Throws UserError.
Region read_region(OptionReader& options, const OptionReader::Names& names,
                   const Rayleigh& inherited);

}  // namespace pounding
