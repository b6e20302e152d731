#pragma once

#include <array>
#include <optional>

#include "elements/element.h"

/// Bricks: hexahedra whose corners are those of a rectangular box. A box is unchanged by reflection
/// in its three mid-planes, which splits its element matrix into eight 3 x 3 blocks, one per
/// parity.
namespace pounding::stiffness {

/// A brick's stiffness split by parity in axes 0, 1, 2. H is the 8-point Walsh-Hadamard transform,
/// entries prod_d of -1 (near) or +1 (far) over the axes d of a row; value "c|s" stands for
/// component c in row s of H. With B = H K H' / 64, K = H' B H and B holds only
///
///   dilation  3 x 3   0|0   1|1   2|2           twist    3 x 3   0|12  1|02  2|01
///   bending   2 x 2   three of them: component d along no axis is a translation, it drops out;
///                     d = 0: 1|01 2|02     d = 1: 0|01 2|12     d = 2: 0|02 1|12
///   shear     2 x 2   0|1 1|0    0|2 2|0    1|2 2|1
///   hourglass 1       0|012  1|012  2|012
struct BrickSplit {
  std::array<double, 6> dilation{};                ///< 00 01 02 11 12 22
  std::array<double, 6> twist{};                   ///< the same
  std::array<std::array<double, 3>, 3> bending{};  ///< 00 01 11 each; bending[d]
  std::array<std::array<double, 3>, 3> shear{};    ///< of 01, 02, 12
  std::array<double, 3> hourglass{};
};

/// Splits the stiffness of a hex8 or hex8_full box with edges `lengths` [m] along axes 0, 1, 2.
/// Nothing when entries outside the pattern exceed 1e-13 of the largest.
std::optional<BrickSplit> split_brick(ElementType type, const ElementProperties& properties,
                                      const Vector3& lengths);

}  // namespace pounding::stiffness
