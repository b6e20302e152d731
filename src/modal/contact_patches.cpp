#include "modal/contact_patches.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pounding {
namespace {

using Patch = std::vector<std::size_t>;

double square_between(const Vector3& a, const Vector3& b) {
  const Vector3 d{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

/// Patches of points that move along one axis.
std::vector<Patch> patches_of(const Patch& points, std::span<const Vector3> positions,
                              std::size_t count) {
  std::vector<double> square(points.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> nearest(points.size(), 0);
  std::size_t middle = 0;
  for (std::size_t patch = 0; patch < count; ++patch) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double own = square_between(positions[points[i]], positions[points[middle]]);
      if (!(own < square[i])) continue;
      square[i] = own;
      nearest[i] = patch;
    }
    middle = static_cast<std::size_t>(std::ranges::max_element(square) - square.begin());
  }
  std::vector<Patch> patches(count);
  for (std::size_t i = 0; i < points.size(); ++i) patches[nearest[i]].push_back(points[i]);
  std::erase_if(patches, [](const Patch& patch) { return patch.empty(); });  // points that coincide
  return patches;
}

}  // namespace

std::vector<std::vector<std::size_t>> contact_patches(std::span<const TracePoint> points,
                                                      std::span<const Vector3> positions,
                                                      std::size_t count) {
  std::vector<Patch> all;
  for (int component = 0; component < 6; ++component) {
    Patch along;
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (points[p].component == component) along.push_back(p);
    }
    if (along.empty()) continue;
    const double share = static_cast<double>(along.size()) / static_cast<double>(points.size());
    const auto own = static_cast<std::size_t>(std::lround(share * static_cast<double>(count)));
    std::ranges::move(patches_of(along, positions, std::clamp<std::size_t>(own, 1, along.size())),
                      std::back_inserter(all));
  }
  return all;
}

}  // namespace pounding
