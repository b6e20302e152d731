#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "stiffness/strains/element_lanes.h"
#include "stiffness/strains/lane_arithmetic.h"

namespace pounding::stiffness {

/// Strains of a triangle of a shell in axes of its own, x along its first edge, z normal: three of
/// the membrane, three curvatures, three drilling angles and the shear along the three edges, as
/// those of QuadrangleStrains. With p = x_2 - x_1 and r = x_3 - x_1 gradients are exact.
struct TriangleStrains {
  static constexpr std::size_t node_count = 3;
  static constexpr std::size_t components = 6;
  static constexpr std::size_t size = node_count * components;

  // Places of the numbers.
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

  /// Forces in the place of displacements, of a batch of elements.
  static void product(const ElementLanes* numbers, ElementLanes* values);
};

}  // namespace pounding::stiffness
