#include "mesh/facet_shares.h"

#include <cmath>

#include "common/matrix3.h"

namespace pounding {
namespace {

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

}  // namespace

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

}  // namespace pounding
