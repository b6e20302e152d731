#include "mesh/bounding_box.h"

#include <algorithm>
#include <cmath>

namespace pounding {

double distance(const Vector3& x, const Vector3& y) {
  return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}

double BoundingBox::longest_side() const {
  return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

BoundingBox bounding_box(std::span<const GlobalMesh> meshes) {
  BoundingBox box;
  for (const GlobalMesh& mesh : meshes) {
    for (GlobalIndex node = 0; node < mesh.node_count(); ++node) {
      const Vector3 x = mesh.position(node);
      for (std::size_t d = 0; d < 3; ++d) {
        box.low[d] = std::min(box.low[d], x[d]);
        box.high[d] = std::max(box.high[d], x[d]);
      }
    }
  }
  return box;
}

}  // namespace pounding
