#include "mesh/facet_point.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/matrix3.h"

namespace pounding {
namespace {

/// Coordinates of a facet, -1 to 1 of a quadrangle, 0 to 1 of a triangle.
using Local = std::array<double, 2>;

/// Closer to a border than this, in such coordinates, is on it.
constexpr double on_border = 1e-9;

struct Shape {
  std::array<double, 4> value{};
  std::array<Local, 4> slope{};
};

Shape shape_at(std::size_t corners, const Local& s) {
  if (corners == 3) return {{1 - s[0] - s[1], s[0], s[1]}, {{{-1, -1}, {1, 0}, {0, 1}}}};
  Shape shape;
  constexpr std::array<Local, 4> at{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const double a = 1 + at[i][0] * s[0];
    const double b = 1 + at[i][1] * s[1];
    shape.value[i] = a * b / 4;
    shape.slope[i] = {at[i][0] * b / 4, a * at[i][1] / 4};
  }
  return shape;
}

Local corner_at(std::size_t corners, std::size_t i) {
  constexpr std::array<Local, 3> triangle{{{0, 0}, {1, 0}, {0, 1}}};
  constexpr std::array<Local, 4> quadrangle{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  return corners == 3 ? triangle[i] : quadrangle[i];
}

/// See FacetPoint::bulges.
std::array<double, 4> bulges_at(std::size_t corners, const Local& s) {
  const Shape shape = shape_at(corners, s);
  std::array<double, 4> bulges{};
  for (std::size_t i = 0; i < corners && corners == 3; ++i) {
    bulges[i] = 4 * shape.value[i] * shape.value[(i + 1) % 3];
  }
  if (corners == 4) {
    const double x = 1 - s[0] * s[0];
    const double y = 1 - s[1] * s[1];
    bulges = {x * (1 - s[1]) / 2, y * (1 + s[0]) / 2, x * (1 + s[1]) / 2, y * (1 - s[0]) / 2};
  }
  return bulges;
}

template <typename Weight>
Vector3 combine(std::span<const Vector3> corners, const Weight& weight) {
  Vector3 sum{0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t d = 0; d < 3; ++d) sum[d] += weight(i) * corners[i][d];
  }
  return sum;
}

Vector3 point_of(std::span<const Vector3> corners, const Shape& shape) {
  return combine(corners, [&](std::size_t i) { return shape.value[i]; });
}

Vector3 tangent(std::span<const Vector3> corners, const Shape& shape, std::size_t direction) {
  return combine(corners, [&](std::size_t i) { return shape.slope[i][direction]; });
}

/// Part of the way from a to b at which a line is nearest to x.
double share_along(const Vector3& a, const Vector3& b, const Vector3& x) {
  const Vector3 line = minus(b, a);
  const double square = dot(line, line);
  const double t = square > 0 ? std::clamp(dot(minus(x, a), line) / square, 0.0, 1.0) : 0;
  if (t < on_border) return 0;
  return t > 1 - on_border ? 1 : t;
}

/// Whether coordinates are those of a point on the facet; a point nearly on a border is put there.
bool settle_inside(std::size_t corners, Local& s) {
  const double low = corners == 3 ? 0 : -1;
  for (double& value : s) {
    if (!(value >= low - on_border && value <= 1 + on_border)) return false;
    if (value < low + on_border) value = low;
    if (value > 1 - on_border) value = 1;
  }
  if (corners == 3 && s[0] + s[1] > 1 - on_border) {
    if (s[0] + s[1] > 1 + on_border) return false;
    s[1] = 1 - s[0];
  }
  return true;
}

/// Newton's iteration for the point p where x - p is normal to the facet; whether there is one.
bool find_foot(std::span<const Vector3> corners, const Vector3& x, Local& s) {
  s = corners.size() == 3 ? Local{1.0 / 3, 1.0 / 3} : Local{0, 0};
  const Vector3 twist =
      corners.size() == 3
          ? Vector3{0, 0, 0}
          : combine(corners, [](std::size_t i) { return i % 2 == 0 ? 0.25 : -0.25; });
  for (int turn = 0; turn < 50; ++turn) {
    const Shape shape = shape_at(corners.size(), s);
    const Vector3 left = minus(x, point_of(corners, shape));
    const Vector3 a = tangent(corners, shape, 0);
    const Vector3 b = tangent(corners, shape, 1);
    const double aa = dot(a, a);
    const double bb = dot(b, b);
    double ab = dot(a, b) - dot(left, twist);
    if (!(aa * bb > ab * ab)) ab = dot(a, b);
    const double area = aa * bb - ab * ab;
    if (!(area > 0)) return false;
    const Local step{(bb * dot(left, a) - ab * dot(left, b)) / area,
                     (aa * dot(left, b) - ab * dot(left, a)) / area};
    for (std::size_t d = 0; d < 2; ++d) s[d] = std::clamp(s[d] + step[d], -3.0, 3.0);
    if (std::abs(step[0]) + std::abs(step[1]) < 1e-15) break;
  }
  return settle_inside(corners.size(), s);
}

/// Coordinates of the nearest point of the border.
Local nearest_on_border(std::span<const Vector3> corners, const Vector3& x) {
  Local best{};
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t j = (i + 1) % corners.size();
    const double t = share_along(corners[i], corners[j], x);
    const Vector3 point{(1 - t) * corners[i][0] + t * corners[j][0],
                        (1 - t) * corners[i][1] + t * corners[j][1],
                        (1 - t) * corners[i][2] + t * corners[j][2]};
    const double distance = norm(minus(x, point));
    if (distance >= nearest) continue;
    nearest = distance;
    const Local from = corner_at(corners.size(), i);
    const Local to = corner_at(corners.size(), j);
    best = {(1 - t) * from[0] + t * to[0], (1 - t) * from[1] + t * to[1]};
  }
  return best;
}

FacetPoint on_line(std::span<const Vector3> corners, const Vector3& x) {
  FacetPoint result;
  const double t = share_along(corners[0], corners[1], x);
  result.shares = {1 - t, t};
  result.bulges = {4 * t * (1 - t)};
  result.x = combine(corners, [&](std::size_t i) { return result.shares[i]; });
  result.distance = norm(minus(x, result.x));
  result.size = norm(minus(corners[1], corners[0]));
  return result;
}

FacetPoint describe(std::span<const Vector3> corners, const Vector3& x, const Local& s) {
  FacetPoint result;
  const Shape shape = shape_at(corners.size(), s);
  result.shares = shape.value;
  result.bulges = bulges_at(corners.size(), s);
  result.x = point_of(corners, shape);
  result.distance = norm(minus(x, result.x));
  const Vector3 a = tangent(corners, shape, 0);
  const Vector3 b = tangent(corners, shape, 1);
  const Vector3 both = cross(a, b);
  const double area = norm(both);
  result.size = area * (corners.size() == 3 ? 0.5 : 4);
  if (!(area > 1e-10 * norm(a) * norm(b))) return result;
  result.normal = normalised(both);
  // Dual to the tangents: grad N = a* dN/ds + b* dN/dt.
  const Vector3 a_dual = cross(b, result.normal);
  const Vector3 b_dual = cross(result.normal, a);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t d = 0; d < 3; ++d) {
      result.gradients[i][d] =
          (shape.slope[i][0] * a_dual[d] + shape.slope[i][1] * b_dual[d]) / area;
    }
  }
  return result;
}

/// Calls `add` with the shape functions and the area along the normal of every point at which a
/// facet of 3 or 4 corners is integrated.
template <typename Function>
void integrate(const GlobalMesh& mesh, const Facet& facet, Function&& add) {
  const auto at = [&](std::size_t i) { return mesh.position(facet.nodes[i]); };
  if (facet.count == 3) {
    const Vector3 twice = cross(minus(at(1), at(0)), minus(at(2), at(0)));
    constexpr double third = 1.0 / 3;
    add(std::array<double, 4>{third, third, third, 0},
        Vector3{twice[0] / 2, twice[1] / 2, twice[2] / 2});
    return;
  }
  constexpr std::array<std::array<double, 2>, 4> corner{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const double gauss = 1 / std::sqrt(3.0);
  for (const auto& point : corner) {
    Vector3 along[2]{};
    std::array<double, 4> shape{};
    for (std::size_t a = 0; a < 4; ++a) {
      const Vector3 x = minus(at(a), at(0));
      const double s = 1 + gauss * point[0] * corner[a][0];
      const double t = 1 + gauss * point[1] * corner[a][1];
      shape[a] = s * t / 4;
      for (std::size_t d = 0; d < 3; ++d) {
        along[0][d] += corner[a][0] * t / 4 * x[d];
        along[1][d] += corner[a][1] * s / 4 * x[d];
      }
    }
    add(shape, cross(along[0], along[1]));
  }
}

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

FacetPoint nearest_point(std::span<const Vector3> corners, const Vector3& x) {
  if (corners.size() == 2) return on_line(corners, x);
  const FacetPoint border = describe(corners, x, nearest_on_border(corners, x));
  Local foot{};
  if (!find_foot(corners, x, foot)) return border;
  const FacetPoint inside = describe(corners, x, foot);
  return inside.distance <= border.distance ? inside : border;
}

std::array<double, 4> facet_shares(const GlobalMesh& mesh, const Facet& facet) {
  if (facet.count == 2) {
    const double length = norm(minus(mesh.position(facet.nodes[1]), mesh.position(facet.nodes[0])));
    return {length / 2, length / 2, 0, 0};
  }
  std::array<double, 4> shares{};
  integrate(mesh, facet, [&](const std::array<double, 4>& shape, const Vector3& area) {
    for (std::size_t a = 0; a < 4; ++a) shares[a] += shape[a] * norm(area);
  });
  return shares;
}

std::array<Vector3, 4> facet_normal_shares(const GlobalMesh& mesh, const Facet& facet) {
  std::array<Vector3, 4> shares{};
  integrate(mesh, facet, [&](const std::array<double, 4>& shape, const Vector3& area) {
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t d = 0; d < 3; ++d) shares[a][d] += shape[a] * area[d];
    }
  });
  return shares;
}

bool is_in_element(ElementType type, std::span<const Vector3> corners, const Vector3& point,
                   double reach) {
  if (is_solid(type)) return is_in_solid(point, corners, traits_of(type).faces, reach);
  if (is_shell(type)) return is_on_shell(point, corners, reach);
  return joins_two_nodes(type) && is_on_line(point, corners[0], corners[1], reach);
}

}  // namespace pounding
