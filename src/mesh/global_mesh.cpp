#include "mesh/global_mesh.h"

#include <algorithm>
#include <cmath>

namespace pounding {

Vector3 centroid(const GlobalMesh& mesh, std::span<const GlobalIndex> nodes) {
  Vector3 sum{0, 0, 0};
  for (const GlobalIndex node : nodes) {
    const Vector3 x = mesh.position(node);
    for (std::size_t d = 0; d < 3; ++d) sum[d] += x[d] / static_cast<double>(nodes.size());
  }
  return sum;
}

double distance(const Vector3& x, const Vector3& y) {
  return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}

void BoundingBox::include(const Vector3& x) {
  for (std::size_t d = 0; d < 3; ++d) {
    low[d] = std::min(low[d], x[d]);
    high[d] = std::max(high[d], x[d]);
  }
}

double BoundingBox::longest_side() const {
  return std::ranges::max(sides());
}

BoundingBox bounding_box(const GlobalMesh& mesh, std::span<const GlobalIndex> nodes) {
  BoundingBox box;
  for (const GlobalIndex node : nodes) box.include(mesh.position(node));
  return box;
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

std::vector<SpreadReport> find_spread_springs(const GlobalMesh& mesh) {
  std::vector<SpreadReport> found;
  for (const ElementSet& set : mesh.regions) {
    if (set.share.empty() || !is_grounded(set.type)) continue;
    SpreadReport& report = found.emplace_back();
    report.region = set.region;
    report.nodes = static_cast<std::int64_t>(set.tags.size());
    for (const double share : set.share) report.extent += share;
  }
  return found;
}

}  // namespace pounding
