#pragma once

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// Three numbers along x, y, z, or six, also about them. Throws UserError.
std::array<double, 6> read_six(OptionReader& options, std::string_view pattern,
                               const OptionReader::Names& names);

/// Where a spring yields and how its dashpots go, beside stiffness and dashpots read already.
/// Throws UserError.
void read_nonlinear_spring(OptionReader& options, const OptionReader::Names& names, Region& region);

/// Where a bar yields, and the slack of one that resists stretching only; makes it a yielding_bar.
/// Throws UserError.
void read_nonlinear_bar(OptionReader& options, const OptionReader::Names& names, Region& region);

}  // namespace pounding
