#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "stiffness/strains/element_lanes.h"

namespace pounding::stiffness {

/// Strains of a quadrangle of a shell in axes of its own, z normal to its mean plane. With the
/// diagonals p = x_3 - x_1, r = x_4 - x_2, J = |p x r| and f_p, f_r the differences of a nodal
/// field f along them:
///
///     J df/dx = y_r f_p - y_p f_r       J df/dy = x_p f_r - x_r f_p       (at the centre)
///     f_h = f_1 - f_2 + f_3 - f_4 - a f_p - b f_r                         (zero for linear fields)
///
/// of the membrane, u and v: three strains, u_h and v_h, and the four drilling angles
/// r_z - (dv/dx - du/dy) / 2; of the plate, the fibres (r_y, -r_x): three curvatures, two of the
/// second line, and the shear along the four edges. The strains and curvatures are isotropic and
/// uncoupled from all others; the quadratic modes that the element condenses change only how u_h,
/// v_h and the drilling angles work on each other.
struct QuadrangleStrains {
  using Number = double;
  static constexpr std::size_t node_count = 4;
  static constexpr std::size_t components = 6;
  static constexpr std::size_t size = node_count * components;

  // Offsets of the numbers.
  static constexpr std::size_t axes = 0;           ///< rows x, y, z
  static constexpr std::size_t height = axes + 9;  ///< nodes 2 and 4 above, 1 and 3 below the plane
  static constexpr std::size_t edges = height + 1;   ///< x, y from node 1 to 2, 2 to 3, 3 to 4
  static constexpr std::size_t spin = edges + 6;     ///< 1 / (2 J)
  static constexpr std::size_t skew = spin + 1;      ///< a, b
  static constexpr std::size_t stretch = skew + 2;   ///< of the sum, of difference and slip
  static constexpr std::size_t bend = stretch + 2;   ///< of the plate: sum, difference and slip
  static constexpr std::size_t membrane = bend + 2;  ///< of u_h, v_h, drilling
  static constexpr std::size_t twist = membrane + packed_size(6);  ///< of the fibres' f_h
  static constexpr std::size_t shear = twist + packed_size(2);     ///< of the edges
  static constexpr std::size_t number_count = shear + packed_size(4);

  /// The numbers of an element with node coordinates of shape (4, 3) [m] and this stiffness, shape
  /// (24, 24). Of another element than shell4 they make another matrix.
  static std::array<double, number_count> numbers(std::span<const double> coordinates,
                                                  std::span<const double> stiffness);

  /// See HexahedronStrains.
  template <typename Numbers>
  static void product(Numbers numbers, ElementLanes* values);
};

/// Strains of a triangle of a shell in axes of its own, x along its first edge, z normal: three of
/// the membrane, three curvatures, three drilling angles and the shear along the three edges, as
/// those of QuadrangleStrains. With p = x_2 - x_1 and r = x_3 - x_1 gradients are exact.
struct TriangleStrains {
  using Number = double;
  static constexpr std::size_t node_count = 3;
  static constexpr std::size_t components = 6;
  static constexpr std::size_t size = node_count * components;

  // Offsets of the numbers.
  static constexpr std::size_t axes = 0;              ///< rows x, y, z
  static constexpr std::size_t edges = axes + 9;      ///< x_p, x_r, y_r
  static constexpr std::size_t spin = edges + 3;      ///< 1 / (2 J)
  static constexpr std::size_t stretch = spin + 1;    ///< of the sum, of difference and slip
  static constexpr std::size_t bend = stretch + 2;    ///< of the plate: sum, difference and slip
  static constexpr std::size_t drilling = bend + 2;   ///< of an angle and of the sum of the three
  static constexpr std::size_t shear = drilling + 1;  ///< of the edges
  static constexpr std::size_t number_count = shear + packed_size(3);

  /// The numbers of an element with node coordinates of shape (3, 3) [m] and this stiffness, shape
  /// (18, 18). Of another element than shell3 they make another matrix.
  static std::array<double, number_count> numbers(std::span<const double> coordinates,
                                                  std::span<const double> stiffness);

  /// See HexahedronStrains.
  template <typename Numbers>
  static void product(Numbers numbers, ElementLanes* values);
};

}  // namespace pounding::stiffness
