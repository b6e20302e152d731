#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "stiffness/strains/hexahedron_strains.h"

namespace pounding::stiffness {

/// Strains of a hexahedron of general shape by the numbers of HexahedronStrains in 32 bits, energy
/// as multiples of mu times the volume, the `scale`, which is the sum of two numbers as lambda is:
///
///     K = scale B' S B,    (B, S)_k rounded to 24 binary digits, scale and lambda to 48
///
/// B takes differences of displacements, so that translations give nothing, and linear fields have
/// their gradients to 6e-8. A factor on Young's modulus is in the scale alone.
struct SingleHexahedron {
  using Number = float;
  using Strains = HexahedronStrains<false>;
  static constexpr std::size_t node_count = Strains::node_count;
  static constexpr std::size_t components = Strains::components;
  static constexpr std::size_t size = Strains::size;
  static constexpr std::size_t scale = Strains::number_count;
  static constexpr std::size_t number_count = scale + 2;

  using Numbers = std::array<Number, number_count>;

  /// The numbers of a hexahedron with node coordinates, shape (8, 3) [m], and this stiffness, shape
  /// (24, 24). Nothing where rounding moves the energy of one of the twelve c_m by more than
  /// `largest_change` of it.
  static std::optional<Numbers> find(std::span<const double> coordinates,
                                     std::span<const double> stiffness);
  static constexpr double largest_change = 1e-5;

  /// See HexahedronStrains.
  template <typename In>
  static void product(In numbers, ElementLanes* values);
};

}  // namespace pounding::stiffness
