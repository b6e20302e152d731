#pragma once

#include <string>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// Stiffness, dashpots and further properties of a spring; makes it one that acts on rotations
/// where its numbers say so. Throws UserError.
void read_spring(OptionReader& options, const OptionReader::Names& names, Region& region);

/// The dashpot of a bar, where it yields, and the slack of one that resists stretching only; makes
/// it a yielding_bar. Throws UserError.
void read_nonlinear_bar(OptionReader& options, const OptionReader::Names& names, Region& region);

/// End of the names of options and results that are per length or area: "_per_area"; nothing where
/// a region is not spread.
inline std::string per_extent(Spread spread) {
  if (spread == Spread::none) return "";
  return spread == Spread::area ? "_per_area" : "_per_length";
}

}  // namespace pounding
