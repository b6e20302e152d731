#include "stiffness/element_frames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pounding::stiffness {
namespace {

constexpr std::size_t rectangle_size = 4 * 3;

/// Nodes in some axes, relative to the first one, and the box around them.
struct LocalNodes {
  LocalNodes(const Matrix3& axes, std::span<const double> coordinates)
      : count(coordinates.size() / 3) {
    for (std::size_t a = 0; a < count; ++a) {
      Vector3 x{};
      for (std::size_t d = 0; d < 3; ++d) x[d] = coordinates[3 * a + d] - coordinates[d];
      positions[a] = multiply(axes, x);
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], positions[a][d]);
        high[d] = std::max(high[d], positions[a][d]);
      }
    }
    for (std::size_t d = 0; d < 3; ++d) lengths[d] = high[d] - low[d];
  }

  std::size_t count;
  std::array<Vector3, 8> positions{};
  Vector3 low{1e300, 1e300, 1e300};
  Vector3 high{-1e300, -1e300, -1e300};
  Vector3 lengths{};
};

/// The box or rectangle in known axes, if it is one there.
std::optional<Box> box_in(const Matrix3& axes, std::span<const double> coordinates,
                          double tolerance) {
  const LocalNodes nodes(axes, coordinates);
  Box box;
  box.lengths = nodes.lengths;
  std::array<std::size_t, 3> thinnest_first{0, 1, 2};
  std::stable_sort(thinnest_first.begin(), thinnest_first.end(),
                   [&](std::size_t a, std::size_t b) { return box.lengths[a] < box.lengths[b]; });
  const bool flat = coordinates.size() == rectangle_size;
  const double allowed = tolerance * box.lengths[thinnest_first[flat ? 1 : 0]];
  if (flat) {
    const std::size_t normal = thinnest_first[0];
    if (!(box.lengths[normal] <= allowed)) return std::nullopt;
    box.normal = static_cast<int>(normal);
    box.lengths[normal] = 0;
  }
  box.corner.fill(-1);
  for (std::size_t a = 0; a < nodes.count; ++a) {
    const Vector3& x = nodes.positions[a];
    std::size_t bits = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      if (static_cast<int>(d) == box.normal) continue;
      const bool far = x[d] - nodes.low[d] > box.lengths[d] / 2;
      const double face = far ? nodes.high[d] : nodes.low[d];
      if (!(std::abs(x[d] - face) <= allowed)) return std::nullopt;
      bits |= static_cast<std::size_t>(far) << d;
    }
    if (box.corner[bits] >= 0) return std::nullopt;
    box.corner[bits] = static_cast<int>(a);
  }
  return box;
}

/// Orthonormal axes along the first edges of an element; nothing if they do not span a plane.
std::optional<Matrix3> edge_axes(std::span<const double> coordinates) {
  const auto edge = [&](std::size_t node) {
    Vector3 e{};
    for (std::size_t d = 0; d < 3; ++d) e[d] = coordinates[3 * node + d] - coordinates[d];
    return e;
  };
  const auto unit = [](Vector3 e) {
    const double length = norm(e);
    for (double& x : e) x /= length;
    return e;
  };
  const Vector3 x = unit(edge(1));
  const Vector3 z = unit(cross(x, edge(3)));
  const Matrix3 axes{x, cross(z, x), z};
  return std::isfinite(determinant(axes)) ? std::optional(axes) : std::nullopt;
}

}  // namespace

std::optional<Box> ElementFrames::recognise(std::span<const double> coordinates,
                                            double tolerance) const {
  for (std::size_t frame = 0; frame < axes_.size(); ++frame) {
    if (auto box = box_in(axes_[frame], coordinates, tolerance)) {
      box->frame = static_cast<int>(frame);
      return box;
    }
  }
  return std::nullopt;
}

std::optional<Matrix3> ElementFrames::axes_of_box(std::span<const double> coordinates,
                                                  double tolerance) {
  const auto axes = edge_axes(coordinates);
  return axes && box_in(*axes, coordinates, tolerance) ? axes : std::nullopt;
}

}  // namespace pounding::stiffness
