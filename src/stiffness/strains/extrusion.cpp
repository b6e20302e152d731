#include "stiffness/strains/extrusion.h"

#include <algorithm>
#include <cmath>

namespace pounding::stiffness {
namespace {

constexpr double tolerance = 1e-13;  // of the element's extent

/// Nodes by the bits of their natural coordinates, as Gmsh counts them.
constexpr std::array<std::size_t, 8> node_of_bits{0, 1, 3, 2, 4, 5, 7, 6};

/// The corners as they are counted when natural direction `third` is the third one.
std::array<std::size_t, 8> corners_along(std::size_t third) {
  std::array<std::size_t, 8> corners{};
  for (std::size_t bits = 0; bits < 8; ++bits) {
    std::size_t turned = 0;
    for (std::size_t d = 0; d < 3; ++d) turned |= (bits >> d & 1) << ((third + 1 + d) % 3);
    corners[node_of_bits[bits]] = node_of_bits[turned];
  }
  return corners;
}

}  // namespace

std::optional<Extrusion> Extrusion::find(std::span<const double> coordinates) {
  double extent = 0;
  for (std::size_t i = 3; i < coordinates.size(); ++i) {
    extent = std::max(extent, std::abs(coordinates[i] - coordinates[i % 3]));
  }
  const double allowed = tolerance * extent;
  for (std::size_t third = 0; third < 3; ++third) {
    const auto corners = corners_along(third);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto same = [&](std::size_t a, std::size_t b, std::size_t d) {
        return std::abs(coordinates[3 * corners[a] + d] - coordinates[3 * corners[b] + d]) <=
               allowed;
      };
      bool alike = true;
      for (std::size_t a = 0; a < 4 && alike; ++a) {
        alike = same(a, a + 4, (axis + 1) % 3) && same(a, a + 4, (axis + 2) % 3) &&
                same(a, 0, axis) && same(a + 4, 4, axis);
      }
      if (alike) return Extrusion{axis, corners};
    }
  }
  return std::nullopt;
}

}  // namespace pounding::stiffness
