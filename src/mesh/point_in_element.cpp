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
    for (std::size_t d = 0; d < 3; ++d) sum[d] += corner[d] / static_cast<double>(corners.size());
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
  if (std::abs(dot(minus(point, middle), normal)) > reach) return false;
  for (std::size_t a = 0; a < corners.size(); ++a) {
    const Vector3& next = corners[(a + 1) % corners.size()];
    Vector3 outward = normalised(cross(minus(next, corners[a]), normal));
    const double side = dot(minus(middle, corners[a]), outward) > 0 ? -1 : 1;
    if (side * dot(minus(point, corners[a]), outward) > reach) return false;
  }
  return true;
}

bool is_in_solid(const Vector3& point, std::span<const Vector3> corners,
                 std::span<const ElementFace> faces, double reach) {
  const Vector3 middle = centre(corners);
  for (const ElementFace& face : faces) {
    std::array<Vector3, 4> nodes;
    std::ranges::transform(face.corners(), nodes.begin(),
                           [&](std::size_t a) { return corners[a]; });
    const std::span<const Vector3> at(nodes.data(), face.corners().size());
    const Vector3 normal = normalised(cross(minus(at[2], at[0]), minus(at[at.size() - 1], at[1])));
    const Vector3 face_middle = centre(at);
    const double side = dot(minus(middle, face_middle), normal) > 0 ? -1 : 1;
    if (side * dot(minus(point, face_middle), normal) > reach) return false;
  }
  return true;
}

}  // namespace

bool is_in_element(ElementType type, std::span<const Vector3> corners, const Vector3& point,
                   double reach) {
  if (is_solid(type)) return is_in_solid(point, corners, traits_of(type).faces, reach);
  if (is_shell(type)) return is_on_shell(point, corners, reach);
  return joins_two_nodes(type) && is_on_line(point, corners[0], corners[1], reach);
}

}  // namespace pounding
