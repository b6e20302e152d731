#pragma once

#include <array>
#include <span>

#include "common/types.h"

namespace pounding {

/// The place of a facet that is nearest to a point.
struct FacetPlace {
  Vector3 place{0, 0, 0};          ///< [m]
  double distance = 0;             ///< of the point [m]
  std::array<double, 4> shares{};  ///< N_i of the corners there; their sum is 1
  /// Bulge of edge i, from corner i to the next one: quadratic, 1 in its middle, 0 on other edges.
  std::array<double, 4> bulges{};
  std::array<Vector3, 4> gradients{};  ///< of N_i along the facet [1/m]; 0 on a line
  Vector3 normal{0, 0, 0};             ///< of length 1; 0 on a line, or where there is no area
  double size = 0;                     ///< area [m2], or length of a line [m]
};

/// The nearest place of a facet to `x`: of a line (2 corners), a triangle (3), or a quadrangle (4)
/// between whose corners coordinates are bilinear. Pure.
FacetPlace nearest_place(std::span<const Vector3> corners, const Vector3& x);

}  // namespace pounding
