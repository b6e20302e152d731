#pragma once

/// The stiffness of rows of congruent bricks as a stencil on lines of node pairs.
///
/// A node pair is the two nodes that face each other through the bricks' thickness, axis 2 of the
/// split. With the sums s = far + near and the differences d = far - near of its displacements, the
/// mid-plane splits every brick into two independent halves of three values each,
///
///     membrane  v = (s_0, s_1, d_2)           bending  v = (d_0, d_1, s_2)
///
/// and the forces on a pair are f_far = f_s + f_d, f_near = f_s - f_d. Of each value v_c a line of
/// pairs needs, at node i of a run along axis 0,
///
///     centre c v_i          sum v_{i-1} + v_{i+1}          slope v_{i+1} - v_{i-1}
///
/// and what a line does to itself and to its neighbours along axis 1 is a sum of these three times
/// a coefficient: adding up the bricks left and right, before and behind is done once and for all.
/// At the two ends of a run one of the bricks is missing: v_i / 2 takes the place of v_i, and a
/// fourth number enters where a slope does,
///
///     end    v_i at the first node, -v_i at the last one

#include <array>
#include <optional>

#include "common/lanes.h"
#include "elements/element_traits.h"

namespace pounding::stiffness {

// Bricks: hexahedra whose corners are those of a rectangular box. A box is unchanged by reflection
// in its three mid-planes, which splits its element matrix into eight 3 x 3 blocks, one per
// parity.

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

/// Coefficients of the sum of the two neighbours of a node, and of the node itself.
struct AlongRun {
  Lanes side{};
  Lanes centre{};
};

/// Even along axis 1:
///
///     f_0 += own_0 v_0 + slope v_2      f_1 += own_1 v_1      f_2 += own_2 v_2 - slope v_0
///
/// At the ends of a run, slope v_2 is that of v_2 plus its end and slope v_0 that of v_0 minus its
/// end in membranes, the other way round in bending.
struct EvenBlock {
  AlongRun own_0, own_1, own_2;
  Lanes slope{};
};

/// Odd along axis 1, `end` at the two ends of a run only:
///
///     odd   f_0 += slope v_1 - end v_1   f_1 += slope v_0 + end v_0 - cross v_2   f_2 += cross v_1
///     skew  f_0 += slope v_1 + end v_1   f_1 -= slope v_0 - end v_0 - cross v_2   f_2 += cross v_1
struct OddBlock {
  AlongRun cross;
  Lanes slope{};
  Lanes end{};
};

/// One half. A line acts on itself by `within` for the bricks on one side of it, plus `skew` for
/// those before it, minus `skew` for those behind; bricks on both sides leave `within_both` = 2
/// `within`. It acts on the line behind by across_even + across_odd, on the one before by
/// across_even - across_odd.
struct HalfStencil {
  EvenBlock within;
  EvenBlock within_both;
  OddBlock skew;
  EvenBlock across_even;
  OddBlock across_odd;
};

struct BrickStencil {
  HalfStencil membrane;
  HalfStencil bending;
};

/// Stencil of bricks with the given split, whose axis 2 is the thickness; coefficients in every
/// lane.
BrickStencil brick_stencil(const BrickSplit& split);

}  // namespace pounding::stiffness
