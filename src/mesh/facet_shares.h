#pragma once

#include <array>

#include "mesh/global_mesh.h"

namespace pounding {

/// Share of each corner in the area of a facet [m2], or of an end in the length of an edge [m]: the
/// integrals of the shape functions.
std::array<double, 4> facet_shares(const GlobalMesh& mesh, const Facet& facet);

/// Share of each corner of a facet of 3 or 4 corners in its area along the normal about which they
/// go round [m2]: the integrals of the shape functions times the normal, so that those of a closed
/// surface add up to nothing, warped facets included.
std::array<Vector3, 4> facet_normal_shares(const GlobalMesh& mesh, const Facet& facet);

}  // namespace pounding
