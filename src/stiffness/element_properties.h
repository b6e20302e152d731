#pragma once

#include "elements/element.h"
#include "scene/scene.h"

namespace pounding {

/// Properties of a region's elements as the element functions want them.
ElementProperties element_properties(const Region& region);

}  // namespace pounding
