#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pounding {

/// Index on this rank (owned then ghost), and index over all ranks.
using LocalIndex = int;
using GlobalIndex = std::int64_t;

using Vector3 = std::array<double, 3>;

inline constexpr std::array<const char*, 3> direction_names{"x", "y", "z"};

/// The elements a mesh can hold; `hex8` is the one with incompatible modes, `shell3` the triangle
/// of shell meshes. A `tension_bar` resists stretching only. Springs act along and about the global
/// axes; those named 6 also on rotations.
enum class ElementType {
  hex8,
  hex8_full,
  beam,
  bar,
  tension_bar,
  shell4,
  shell3,
  point_mass,
  point_mass6,
  grounded_spring,
  grounded_spring6,
  spring,
  spring6
};

constexpr bool is_hexahedron(ElementType type) {
  return type == ElementType::hex8 || type == ElementType::hex8_full;
}

constexpr bool is_shell(ElementType type) {
  return type == ElementType::shell4 || type == ElementType::shell3;
}

/// Name as printed.
const char* element_name(ElementType type);

}  // namespace pounding
