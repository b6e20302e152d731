#include "stiffness/bricks/brick_stencil.h"

#include <cstddef>

#include "stiffness/rows/parity_split.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t corner_count = 8;
/// Corner bits of Gmsh's node order.
constexpr std::array<std::size_t, corner_count> gmsh_corner{0, 1, 3, 2, 4, 5, 7, 6};

constexpr std::size_t value(std::size_t component, std::size_t axes) {
  return axes + corner_count * component;
}

/// A term of the energy of a brick in the sum (even) and the difference (odd) of its two ends.
struct Term {
  double even = 0;
  double odd = 0;
};

Term operator+(Term a, Term b) {
  return {a.even + b.even, a.odd + b.odd};
}
Term operator-(Term a, Term b) {
  return {a.even - b.even, a.odd - b.odd};
}
Term operator*(double factor, Term a) {
  return {factor * a.even, factor * a.odd};
}

/// Sum over the two bricks left and right of node i: even terms give v_{i-1} + 2 v_i + v_{i+1}, odd
/// ones -v_{i-1} + 2 v_i - v_{i+1}.
AlongRun along_run(Term term) {
  AlongRun result;
  result.side = all_lanes(term.even - term.odd);
  result.centre = all_lanes(2 * (term.even + term.odd));
  return result;
}

/// Three values x, y, z of a node that act on each other only; at node i, with the slopes of the
/// run,
///
///     f_x = xx x + xy y' + xz z'      f_y = yy y + yz z - xy x'      f_z = zz z + yz y - xz x'
struct Chain {
  Term xx, yy, zz, yz;
  double xy = 0;
  double xz = 0;
};

EvenBlock even_block(const Chain& sum, const Chain& difference, double sign, double factor) {
  EvenBlock block;
  block.own_0 = along_run(factor * (sum.xx + sign * difference.xx));
  block.own_1 = along_run(factor * (difference.yy + sign * sum.yy));
  block.own_2 = along_run(factor * (sum.zz + sign * difference.zz));
  block.slope = all_lanes(factor * (sum.xz + sign * difference.xz));
  return block;
}

/// `sum`: values (P_0, Q_1, P_2), `difference`: (Q_0, P_1, Q_2), with P = b + a and Q = b - a of
/// the lines a before and b behind a row of bricks.
HalfStencil half_stencil(const Chain& sum, const Chain& difference) {
  HalfStencil half;
  half.within = even_block(sum, difference, 1, 1);
  half.within_both = even_block(sum, difference, 1, 2);
  half.across_even = even_block(sum, difference, -1, 1);
  half.across_odd.cross = along_run(difference.yz - sum.yz);
  half.across_odd.slope = all_lanes(difference.xy - sum.xy);
  half.across_odd.end = all_lanes(difference.xy + sum.xy);
  half.skew.cross = along_run(difference.yz + sum.yz);
  half.skew.slope = all_lanes(difference.xy + sum.xy);
  half.skew.end = all_lanes(sum.xy - difference.xy);
  return half;
}

}  // namespace

std::optional<BrickSplit> split_brick(ElementType type, const ElementProperties& properties,
                                      const Vector3& lengths) {
  BlockPicker picker(stiffness_by_parity(type, properties, lengths, gmsh_corner));
  BrickSplit split;
  split.dilation = picker.take3(value(0, 1), value(1, 2), value(2, 4));
  split.twist = picker.take3(value(0, 6), value(1, 5), value(2, 3));
  split.bending = {picker.take2(value(1, 3), value(2, 5)), picker.take2(value(0, 3), value(2, 6)),
                   picker.take2(value(0, 5), value(1, 6))};
  split.shear = {picker.take2(value(0, 2), value(1, 1)), picker.take2(value(0, 4), value(2, 1)),
                 picker.take2(value(1, 4), value(2, 2))};
  split.hourglass = {picker.take1(value(0, 7)), picker.take1(value(1, 7)),
                     picker.take1(value(2, 7))};
  return picker.took_all() ? std::optional(split) : std::nullopt;
}

BrickStencil brick_stencil(const BrickSplit& split) {
  const auto& [dilation, twist, bending, shear, hourglass] = split;
  Chain membrane_sum;
  membrane_sum.xx = {0, dilation[0]};
  membrane_sum.xy = -dilation[1];
  membrane_sum.xz = -dilation[2];
  membrane_sum.yy = {dilation[3], bending[0][0]};
  membrane_sum.yz = {dilation[4], bending[0][1]};
  membrane_sum.zz = {dilation[5], bending[0][2]};
  Chain membrane_difference;
  membrane_difference.xx = {shear[0][0], bending[1][0]};
  membrane_difference.xy = shear[0][1];
  membrane_difference.xz = -bending[1][1];
  membrane_difference.yy = {0, shear[0][2]};
  membrane_difference.zz = {bending[1][2], hourglass[2]};
  Chain bending_sum;
  bending_sum.xx = {shear[1][0], bending[2][0]};
  bending_sum.xy = -bending[2][1];
  bending_sum.xz = shear[1][1];
  bending_sum.yy = {bending[2][2], hourglass[1]};
  bending_sum.zz = {0, shear[1][2]};
  Chain bending_difference;
  bending_difference.xx = {twist[0], hourglass[0]};
  bending_difference.xy = twist[1];
  bending_difference.xz = twist[2];
  bending_difference.yy = {shear[2][0], twist[3]};
  bending_difference.yz = {shear[2][1], twist[4]};
  bending_difference.zz = {shear[2][2], twist[5]};
  return {half_stencil(membrane_sum, membrane_difference),
          half_stencil(bending_sum, bending_difference)};
}

}  // namespace pounding::stiffness
