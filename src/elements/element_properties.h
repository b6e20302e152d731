#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <stdexcept>

#include "common/types.h"

namespace pounding {

/// An element that cannot be: inverted, zero length, an axis along the beam. The caller adds which
/// one it is.
class ElementError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Spring and dashpot to the ground along one motion of a node with rotations.
struct GroundSpring {
  std::array<double, 6> motion{};  ///< elongation per displacement and rotation of the node
  double stiffness = 0;
  double dashpot = 0;
};

/// Everything an element needs to know besides its coordinates; properties that it does not use
/// stay 0. [SI]
struct ElementProperties {
  double young = 0;
  double poisson = 0;
  double density = 0;
  double area = 0;
  double inertia_y = 0;
  double inertia_z = 0;
  double torsion = 0;
  double shear_area_y = 0;  ///< of a beam, for forces along local y; 0: no flexibility in shear
  double shear_area_z = 0;
  double resolved_frequency = 0;  ///< of a beam [rad/s], see beam2.h; 0: its own rotary inertia
  Vector3 z_axis{0, 0, 1};
  double thickness = 0;
  double rotary_inertia_factor = 0;   ///< of shells, see flat_shell.h
  double drilling_factor = 1;         ///< of shells, see flat_shell.h
  double added_mass = 0;              ///< of a shell [kg/m2], of a beam or bar [kg/m]
  double mass = 0;                    ///< of a point
  Vector3 mass_along{1, 1, 1};        ///< parts of it that move along x, y, z
  Vector3 rotary_inertia{0, 0, 0};    ///< of a point, about x, y, z
  std::array<double, 6> stiffness{};  ///< of a spring: along x, y, z, about x, y, z
  std::array<double, 6> dashpot{};    ///< of its dashpot, in the same order [N s/m, N m s]
  std::span<const GroundSpring> ground_springs{};  ///< of soil; borrowed from its region
};

/// Number of nodes, and of components (3 or 6) at each of them.
struct ElementLayout {
  int nodes = 0;
  int components = 0;
  constexpr int size() const { return nodes * components; }
};

/// A face of a solid by the places of its nodes in the element, in order around it.
struct ElementFace {
  std::array<std::size_t, 4> nodes{};
  int count = 0;  ///< 3 or 4
  std::span<const std::size_t> corners() const {
    return {nodes.data(), static_cast<std::size_t>(count)};
  }
};

inline constexpr int max_element_nodes = 8;
inline constexpr int max_element_size = 24;

/// Node coordinates relative to the first node, so that an element far from the origin keeps its
/// digits.
template <std::size_t node_count>
std::array<Vector3, node_count> relative_nodes(std::span<const double> coordinates) {
  std::array<Vector3, node_count> nodes{};
  for (std::size_t a = 0; a < node_count; ++a) {
    for (std::size_t i = 0; i < 3; ++i) nodes[a][i] = coordinates[3 * a + i] - coordinates[i];
  }
  return nodes;
}

}  // namespace pounding
