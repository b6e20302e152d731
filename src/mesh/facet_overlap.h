#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/types.h"

namespace pounding {

/// A point of a facet that lies over another one.
struct OverlapPoint {
  Vector3 x{0, 0, 0};              ///< on the facet [m]
  std::array<double, 4> shares{};  ///< N_i of the facet's corners there; their sum is 1
  std::array<double, 4> bulges{};  ///< of its edges, as in FacetPoint
  double weight = 0;               ///< of the point in an integral [m2], of lines [m]
};

/// Gauss points of the part of a facet that lies over `other`, both seen along the facet's normal,
/// or of lines along the line: the overlap of polygons or intervals, in triangles. Exact for
/// products of the facets' shares where both are lines, triangles or parallelograms; an eight-point
/// rule per direction for other quadrangles. Empty where they do not overlap, where one is a line
/// and the other is not, and of facets without area. Pure.
std::vector<OverlapPoint> overlap_points(std::span<const Vector3> facet,
                                         std::span<const Vector3> other);

}  // namespace pounding
