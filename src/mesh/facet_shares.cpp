#include "mesh/facet_shares.h"

#include <cmath>

#include "common/matrix3.h"

namespace pounding {

std::array<double, 4> facet_shares(const GlobalMesh& mesh, const Facet& facet) {
  const auto at = [&](std::size_t i) { return mesh.position(facet.nodes[i]); };
  std::array<double, 4> shares{};
  if (facet.count == 2) {
    const double length = norm(minus(at(1), at(0)));
    return {length / 2, length / 2, 0, 0};
  }
  if (facet.count == 3) {
    const double area = norm(cross(minus(at(1), at(0)), minus(at(2), at(0)))) / 2;
    return {area / 3, area / 3, area / 3, 0};
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
    const double area = norm(cross(along[0], along[1]));
    for (std::size_t a = 0; a < 4; ++a) shares[a] += shape[a] * area;
  }
  return shares;
}

}  // namespace pounding
