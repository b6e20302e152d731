#include "mesh/point_in_element.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/matrix3.h"

namespace pounding {
namespace {

Vector3 centre(std::span<const Vector3> corners) {
  Vector3 sum{0, 0, 0};
  for (const Vector3& corner : corners) {
    for (std::size_t d = 0; d < 3; ++d) {
      sum[d] += corner[d] / static_cast<double>(corners.size());
    }
  }
  return sum;
}

bool is_on_line(const Vector3& point, const Vector3& a, const Vector3& b, double reach) {
  const Vector3 along = minus(b, a);
  const double share = std::clamp(dot(minus(point, a), along) / dot(along, along), 0.0, 1.0);
  const Vector3 foot{a[0] + share * along[0], a[1] + share * along[1], a[2] + share * along[2]};
  const Vector3 away = minus(point, foot);
  return dot(away, away) <= reach * reach;
}

bool is_on_shell(const Vector3& point, std::span<const Vector3> corners, double reach) {
  const Vector3 normal = normalised(
      cross(minus(corners[2], corners[0]), minus(corners[corners.size() - 1], corners[1])));
  const Vector3 middle = centre(corners);
  if (std::abs(dot(minus(point, middle), normal)) > reach) {
    return false;
  }
  for (std::size_t a = 0; a < corners.size(); ++a) {
    const Vector3& next = corners[(a + 1) % corners.size()];
    Vector3 outward = normalised(cross(minus(next, corners[a]), normal));
    const double side = dot(minus(middle, corners[a]), outward) > 0 ? -1 : 1;
    if (side * dot(minus(point, corners[a]), outward) > reach) {
      return false;
    }
  }
  return true;
}

bool is_in_hexahedron(const Vector3& point, std::span<const Vector3> corners, double reach) {
  constexpr std::array<std::array<std::size_t, 4>, 6> faces{
      {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  const Vector3 middle = centre(corners);
  for (const auto& face : faces) {
    const std::array<Vector3, 4> at{corners[face[0]], corners[face[1]], corners[face[2]],
                                    corners[face[3]]};
    const Vector3 normal = normalised(cross(minus(at[2], at[0]), minus(at[3], at[1])));
    const Vector3 face_middle = centre(at);
    const double side = dot(minus(middle, face_middle), normal) > 0 ? -1 : 1;
    if (side * dot(minus(point, face_middle), normal) > reach) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool is_in_element(const Vector3& point, std::span<const Vector3> corners, double reach) {
  switch (corners.size()) {
    case 2:
      return is_on_line(point, corners[0], corners[1], reach);
    case 8:
      return is_in_hexahedron(point, corners, reach);
    default:
      return corners.size() > 2 && is_on_shell(point, corners, reach);
  }
}

}  // namespace pounding
