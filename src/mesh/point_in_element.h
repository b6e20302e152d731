#pragma once

#include <span>

#include "elements/element_traits.h"

namespace pounding {

/// Whether a point lies within `reach` [m] of an element with flat faces, given by its type and the
/// positions of its nodes; in no element of a single node.
bool is_in_element(ElementType type, std::span<const Vector3> corners, const Vector3& point,
                   double reach);

}  // namespace pounding
