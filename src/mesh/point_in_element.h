#pragma once

#include <span>

#include "common/types.h"

namespace pounding {

/// Whether a point lies within `reach` [m] of an element with flat faces: a line (2 corners), a
/// shell (3 or 4) or a hexahedron (8, in Gmsh's order).
bool is_in_element(const Vector3& point, std::span<const Vector3> corners, double reach);

}  // namespace pounding
