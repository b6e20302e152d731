#pragma once

#include <string>

#include "scene/scene.h"

namespace pounding {

/// End of the names of options and results that are per length or area: "_per_area"; nothing where
/// a region is not spread.
inline std::string per_extent(Spread spread) {
  if (spread == Spread::none) return "";
  return spread == Spread::area ? "_per_area" : "_per_length";
}

}  // namespace pounding
