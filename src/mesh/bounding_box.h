#pragma once

#include <span>

#include "mesh/global_mesh.h"

namespace pounding {

/// Between two points [m].
double distance(const Vector3& x, const Vector3& y);

/// Bounding box of a set of nodes, its sides along the axes.
struct BoundingBox {
  Vector3 low{1e300, 1e300, 1e300};      ///< [m]
  Vector3 high{-1e300, -1e300, -1e300};  ///< [m]

  void include(const Vector3& x);
  double diagonal() const { return distance(low, high); }
  Vector3 sides() const;  ///< [m]
  double longest_side() const;
};

/// Bounding box of every node of some meshes, which have at least one. Serial.
BoundingBox bounding_box(std::span<const GlobalMesh> meshes);

}  // namespace pounding
