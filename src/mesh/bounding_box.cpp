#include "mesh/bounding_box.h"

#include <algorithm>
#include <cmath>

namespace pounding {

double distance(const Vector3& x, const Vector3& y) {
  return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}

void BoundingBox::include(const Vector3& x) {
  for (std::size_t d = 0; d < 3; ++d) {
    low[d] = std::min(low[d], x[d]);
    high[d] = std::max(high[d], x[d]);
  }
}

Vector3 BoundingBox::sides() const {
  return {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
}

double BoundingBox::longest_side() const {
  return std::ranges::max(sides());
}

BoundingBox bounding_box(std::span<const GlobalMesh> meshes) {
  BoundingBox box;
  for (const GlobalMesh& mesh : meshes) {
    for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
      box.include(mesh.position(node));
    }
  }
  return box;
}

}  // namespace pounding
