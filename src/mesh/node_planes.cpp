#include "mesh/node_planes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/bounding_box.h"

namespace pounding {
namespace {

/// Coordinates closer than this part of the longest extent lie in one plane.
constexpr double same_plane = 1e-7;

}  // namespace

NodePlanes::NodePlanes(const GlobalMesh& mesh) {
  const BoundingBox box = bounding_box({&mesh, 1});
  const auto extent = [&](std::size_t d) { return box.high[d] - box.low[d]; };
  std::stable_sort(axes_.begin(), axes_.end(),
                   [&](std::size_t a, std::size_t b) { return extent(a) > extent(b); });
  std::swap(axes_[1], axes_[2]);
  low_ = box.low;
  spacing_ = same_plane * extent(axes_[0]);
}

std::array<std::int64_t, 3> NodePlanes::place(const Vector3& x) const {
  std::array<std::int64_t, 3> place{};
  for (std::size_t d = 0; d < 3 && spacing_ > 0; ++d) {
    place[d] = std::llround((x[axes_[d]] - low_[axes_[d]]) / spacing_);
  }
  return place;
}

}  // namespace pounding
