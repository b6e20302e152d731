#pragma once

#include <optional>

#include "interactions/pairing/contact_face.h"

namespace pounding::interactions {

/// Where two edges of two nodes each pass each other.
struct Crossing {
  double first = 0;   ///< place on the first edge, 0 at its first node, 1 at its second
  double second = 0;  ///< on the second edge
  double gap = 0;     ///< from the first to the second along the direction [m]
};

/// Crossing of two edges seen along a unit vector, or nothing where they pass beside each other or
/// run alongside (sine of the angle between them below 0.1). Places within a relative 1e-6 of an
/// end are the end.
std::optional<Crossing> cross_edges(const GlobalMesh& first_mesh, const Facet& first,
                                    const GlobalMesh& second_mesh, const Facet& second,
                                    const Vector3& direction);

}  // namespace pounding::interactions
