#pragma once

#include <array>
#include <span>

#include "common/types.h"
#include "elements/element_traits.h"
#include "mesh/global_mesh.h"

namespace pounding {

/// Point of a facet that is nearest to a point.
struct FacetPoint {
  Vector3 x{0, 0, 0};              ///< [m]
  double distance = 0;             ///< of the point [m]
  std::array<double, 4> shares{};  ///< N_i of the corners there; their sum is 1
  /// Bulge of edge i, from corner i to the next one: quadratic, 1 in its middle, 0 on other edges.
  std::array<double, 4> bulges{};
  std::array<Vector3, 4> gradients{};  ///< of N_i along the facet [1/m]; 0 on a line
  Vector3 normal{0, 0, 0};             ///< of length 1; 0 on a line, or where there is no area
  double size = 0;                     ///< area [m2], or length of a line [m]
};

/// Nearest point of a facet to `x`: of a line (2 corners), a triangle (3), or a quadrangle (4)
/// between whose corners coordinates are bilinear. Pure.
FacetPoint nearest_point(std::span<const Vector3> corners, const Vector3& x);

/// Share of each corner in the area of a facet [m2], or of an end in the length of an edge [m]: the
/// integrals of the shape functions.
std::array<double, 4> facet_shares(const GlobalMesh& mesh, const Facet& facet);

/// Share of each corner of a facet of 3 or 4 corners in its area along the normal about which they
/// go round [m2]: the integrals of the shape functions times the normal, so that those of a closed
/// surface add up to nothing, warped facets included.
std::array<Vector3, 4> facet_normal_shares(const GlobalMesh& mesh, const Facet& facet);

/// Whether a point lies within `reach` [m] of an element with flat faces, given by its type and the
/// positions of its nodes; in no element of a single node.
bool is_in_element(ElementType type, std::span<const Vector3> corners, const Vector3& point,
                   double reach);

}  // namespace pounding
