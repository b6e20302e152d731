#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/lanes.h"
#include "common/types.h"
#include "elements/element_traits.h"

namespace pounding::stiffness {

/// Numbers of a beam between two nodes, and its product by them.
struct BeamShape {
  using Number = double;
  static constexpr std::size_t node_count = 2;
  static constexpr std::size_t components = 6;

  // Offsets of the numbers.
  static constexpr std::size_t axes = 0;             ///< rows x, y, z
  static constexpr std::size_t stretch = axes + 9;   ///< E A / L
  static constexpr std::size_t twist = stretch + 1;  ///< G J / L
  /// Stiffness of u_y and r_z: 12 E I_z / (L^3 (1 + Phi)), 6 E I_z / (L^2 (1 + Phi)),
  /// 2 E I_z / L, and the pure number (2 - Phi) / (2 + 2 Phi).
  static constexpr std::size_t bending_y = twist + 1;
  static constexpr std::size_t bending_z = bending_y + 4;  ///< the same of I_y: u_z, r_y
  static constexpr std::size_t number_count = bending_z + 4;

  /// Numbers of a beam with node coordinates of shape (2, 3) [m].
  static std::array<double, number_count> numbers(std::span<const double> coordinates,
                                                  const ElementProperties& properties);
  /// Forces and moments in the place of displacements and rotations, node by node, of four beams
  /// or of one in several runs. The force on the second node is minus that on the first.
  template <typename Numbers, typename Value>
  static void product(Numbers numbers, Value* values);
};

/// Beams, four at a time, from their ten local stiffnesses and their axes instead of 12 x 12
/// matrices. With d = u_1 - u_2, the rotations r_1, r_2 in local axes, and Phi of beam2.h, which is
/// 0 without flexibility in shear:
///
///     f_x = E A / L d_x                          t_1 = -t_2 = G J / L (r_1x - r_2x)
///     f_y = (12 E I_z / L^3 d_y + 6 E I_z / L^2 (r_1z + r_2z)) / (1 + Phi)
///     m_1z = (6 E I_z / L^2 d_y + E I_z / L ((4 + Phi) r_1z + (2 - Phi) r_2z)) / (1 + Phi)
///
/// and likewise f_z, m_y with E I_y and the other sign of the terms in L^2; node 2 takes -f.
class BeamElements {
 public:
  struct Beam {
    /// Slots of the six dofs in a row of each node.
    std::array<LocalIndex, 2> start{};
    std::array<double, BeamShape::number_count> numbers{};
  };

  /// `idle`: slot of six dofs that no node uses, for the lanes of the last batch.
  BeamElements(const std::vector<Beam>& beams, LocalIndex idle);

  /// q += K w; both arrays hold all slots. Allocates nothing.
  void apply(const double* w, double* q) const;

 private:
  struct Batch {
    std::array<std::array<LocalIndex, 4>, 2> start{};
    Lanes numbers[BeamShape::number_count] = {};
  };

  std::vector<Batch> batches_;
};

}  // namespace pounding::stiffness
