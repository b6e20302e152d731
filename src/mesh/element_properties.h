#pragma once

#include "elements/element_traits.h"
#include "scene/scene.h"

namespace pounding {

/// Properties of a region's elements as the element functions want them. What compression-only
/// springs do along z is no part of them: a link does it. `share`: of the element in the values
/// of its region (ElementSet).
ElementProperties element_properties(const Region& region, double share = 1);

}  // namespace pounding
