#pragma once

#include <array>

#include "mesh/global_mesh.h"

namespace pounding {

/// Share of each corner in the area of a facet [m2], or of an end in the length of an edge [m]: the
/// integrals of the shape functions.
std::array<double, 4> facet_shares(const GlobalMesh& mesh, const Facet& facet);

}  // namespace pounding
