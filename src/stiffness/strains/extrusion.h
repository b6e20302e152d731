#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace pounding::stiffness {

/// How a hexahedron whose ends are alike, and across a global axis, is seen along that axis.
struct Extrusion {
  std::size_t axis;                    ///< across the ends
  std::array<std::size_t, 8> corners;  ///< its nodes, in the order that Gmsh has for axis 2

  /// Nothing for other shapes; `coordinates`: shape (8, 3) [m].
  static std::optional<Extrusion> find(std::span<const double> coordinates);

  /// The direction that is number `direction` when the axis is number 2.
  std::size_t direction(std::size_t direction) const { return (axis + 1 + direction) % 3; }
};

}  // namespace pounding::stiffness
