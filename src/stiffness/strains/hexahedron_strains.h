#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "stiffness/strains/element_lanes.h"

namespace pounding::stiffness {

/// Strains of a hexahedron. With the eight signs xi, eta, zeta of its corners, and their products
/// eta zeta, zeta xi, xi eta, xi eta zeta, the sums U_k and U_m of a nodal field over them, and
/// those X_kj, X_mj of the coordinates:
///
///     g_j = (X^-1)_jk U_k                      (gradient at the centre)
///     c_m = U_m - T_mk U_k, T = X_m. X^-1      (zero for linear fields)
///     mean gradient = g_j + M_mj c_m
///
/// The six strains of the mean gradients are isotropic and uncoupled from the twelve c_m of the
/// three displacements; the quadratic modes that the element condenses have no mean, and change
/// only how the c_m work on each other.
///
/// An extruded one has its ends across axis 2, along which zeta runs, at right angles: most of
/// these numbers are zero then, and the c_m fall into two groups that its mid-plane tells apart.
template <bool extruded>
struct HexahedronStrains {
  using Number = double;
  static constexpr std::size_t node_count = 8;
  static constexpr std::size_t components = 3;
  static constexpr std::size_t size = node_count * components;
  static constexpr std::size_t mode_count = 4;
  static constexpr std::size_t strain_count = mode_count * components;
  static constexpr std::size_t even_count = extruded ? 5 : strain_count;  ///< of the first group

  // Offsets of the numbers.
  static constexpr std::size_t lame = 0;                             ///< lambda, mu; times V
  static constexpr std::size_t inverse = lame + 2;                   ///< X^-1, row by row
  static constexpr std::size_t skew = inverse + (extruded ? 5 : 9);  ///< T, row by row
  static constexpr std::size_t mean = skew + (extruded ? 2 : strain_count);   ///< M, row by row
  static constexpr std::size_t modes = mean + (extruded ? 3 : strain_count);  ///< of c
  static constexpr std::size_t other_modes = modes + packed_size(even_count);
  static constexpr std::size_t number_count = other_modes + packed_size(strain_count - even_count);

  /// The numbers of an element with node coordinates of shape (8, 3) [m] and this stiffness, shape
  /// (24, 24). Of another element than hex8 and hex8_full they make another matrix, and so they do
  /// of one that is not extruded along axis 2 if it should be.
  static std::array<double, number_count> numbers(std::span<const double> coordinates,
                                                  std::span<const double> stiffness);

  /// Forces in the place of displacements, of a batch of elements (NumbersOfBatch) or of one in
  /// several runs (NumbersOfOne).
  template <typename Numbers>
  static void product(Numbers numbers, ElementLanes* values);
};

/// Numbers with mu as the unit of energy, in whose place are the last digits of lambda: that is the
/// same in all elements of a material, and a part lost of it would not average out.
template <typename In>
struct OfUnitShear {
  In numbers;

  __attribute__((always_inline)) ElementLanes operator[](std::size_t k) const {
    if (k == HexahedronStrains<false>::lame) return numbers[k] + numbers[k + 1];
    return k == HexahedronStrains<false>::lame + 1 ? all_wide(1) : numbers[k];
  }
  In operator+(std::size_t k) const { return numbers + k; }
};

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
