#pragma once

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// Stiffness, dashpots and further properties of a spring; makes it one that acts on rotations
/// where its numbers say so. Throws UserError.
void read_spring(OptionReader& options, const OptionReader::Names& names, Region& region);

/// Where a bar yields, and the slack of one that resists stretching only; makes it a yielding_bar.
/// Throws UserError.
void read_nonlinear_bar(OptionReader& options, const OptionReader::Names& names, Region& region);

}  // namespace pounding
