#include "mesh/global_mesh.h"

namespace pounding {

Vector3 centroid(const GlobalMesh& mesh, std::span<const GlobalIndex> nodes) {
  Vector3 sum{0, 0, 0};
  for (const GlobalIndex node : nodes) {
    const Vector3 x = mesh.position(node);
    for (std::size_t d = 0; d < 3; ++d) sum[d] += x[d] / static_cast<double>(nodes.size());
  }
  return sum;
}

}  // namespace pounding
