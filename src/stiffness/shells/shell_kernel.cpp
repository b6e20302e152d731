#include "stiffness/shells/shell_kernel.h"

#include <cstddef>

#include "common/wide_lanes.h"
#include "stiffness/rows/parity_split.h"

namespace pounding::stiffness {
namespace {

constexpr std::size_t corner_count = 4;
/// Corner bits of Gmsh's node order.
constexpr std::array<std::size_t, corner_count> gmsh_corner{0, 1, 3, 2};

/// Rows of H.
constexpr std::size_t sum = 0;
constexpr std::size_t along = 1;   // the run
constexpr std::size_t across = 2;  // it
constexpr std::size_t both = 3;

/// Offset in B of component c, row s, both named by the run.
std::size_t offset(std::size_t c, std::size_t s, int run_axis) {
  constexpr std::array<std::size_t, 6> other_component{1, 0, 2, 4, 3, 5};
  constexpr std::array<std::size_t, 4> other_row{sum, across, along, both};
  return run_axis == 0 ? s + corner_count * c : other_row[s] + corner_count * other_component[c];
}

/// c += b x for a number b.
POUNDING_INLINE void add_times(double b, const WideLanes& x, WideLanes& c) {
  add_product(all_wide(b), x, c);
}

/// (x, y) <- B (x, y), B = 00 01 11.
POUNDING_INLINE void multiply2(const std::array<double, 3>& b, WideLanes& x, WideLanes& y) {
  WideLanes first = b[0] * x;
  WideLanes second = b[1] * x;
  add_times(b[1], y, first);
  add_times(b[2], y, second);
  x = first;
  y = second;
}

/// (x, y, z) <- B (x, y, z), B = 00 01 02 11 12 22.
POUNDING_INLINE void multiply3(const std::array<double, 6>& b, WideLanes& x, WideLanes& y,
                               WideLanes& z) {
  WideLanes first = b[0] * x;
  WideLanes second = b[1] * x;
  WideLanes third = b[2] * x;
  add_times(b[1], y, first);
  add_times(b[3], y, second);
  add_times(b[4], y, third);
  add_times(b[2], z, first);
  add_times(b[4], z, second);
  add_times(b[5], z, third);
  x = first;
  y = second;
  z = third;
}

/// All bits set in the lanes of elements that a run of which `left` are left still has.
POUNDING_INLINE WideMask lanes_below(int left) {
  return lane_numbers < static_cast<std::int64_t>(left);
}

/// Forces of the far ends at the nodes of a vector from node i on: those of the elements from i on
/// reach the nodes from i + 1 on, the last one's is kept in `carry` for the next call, which takes
/// it out at its first node.
POUNDING_INLINE WideLanes carry_over(const WideLanes& far, WideLanes& carry) {
  const WideLanes shifted = shifted_back(carry, far);
  carry = far;
  return shifted;
}

/// One component of the four nodes of each rectangle of a vector: rows of H with axis 1 as 0: no,
/// 1: yes; `even` along the run without, `odd` with axis 0.
struct Transformed {
  WideLanes even[2];
  WideLanes odd[2];
};

/// Values at the near and at the far ends of the rectangles from one on, of their nodes in a line.
POUNDING_INLINE void load_ends(const double* line, WideLanes& near, WideLanes& far) {
  load(line, near);
#ifdef __AVX512F__  // a vector that begins between two cache lines is loaded twice
  WideLanes next;
  load(line + wide_lane_count, next);
  far = shifted_on(near, next);
#else
  load(line + 1, far);
#endif
}

/// Walsh-Hadamard transform of the rectangles of a vector between the nodes of two lines.
POUNDING_INLINE void transform(const double* line0, const double* line1, Transformed& out) {
  WideLanes near0, far0, near1, far1;
  load_ends(line0, near0, far0);
  load_ends(line1, near1, far1);
  const WideLanes sum0 = near0 + far0;
  const WideLanes sum1 = near1 + far1;
  const WideLanes difference0 = far0 - near0;
  const WideLanes difference1 = far1 - near1;
  out.even[0] = sum0 + sum1;
  out.even[1] = sum1 - sum0;
  out.odd[0] = difference0 + difference1;
  out.odd[1] = difference1 - difference0;
}

/// The components 0, 1, 5 of a rectangle, and the blocks of B they need.
struct Membrane {
  static constexpr int component[3] = {0, 1, 5};
  static constexpr bool translation[3] = {true, true, false};
  static POUNDING_INLINE void multiply(const ShellSplit& b, Transformed (&v)[3]) {
    multiply2(b.stretch, v[0].odd[0], v[1].even[1]);
    multiply2(b.bending[0], v[1].odd[1], v[2].even[1]);
    multiply2(b.bending[1], v[0].odd[1], v[2].odd[0]);
    multiply3(b.shear, v[0].even[1], v[1].odd[0], v[2].even[0]);
    v[2].odd[1] *= b.drilling;
  }
};

/// The components 2, 3, 4.
struct Plate {
  static constexpr int component[3] = {2, 3, 4};
  static constexpr bool translation[3] = {true, false, false};
  static POUNDING_INLINE void multiply(const ShellSplit& b, Transformed (&v)[3]) {
    multiply2(b.curvature, v[1].even[1], v[2].odd[0]);
    multiply2(b.slope[0], v[0].odd[0], v[2].even[0]);
    multiply2(b.slope[1], v[0].even[1], v[1].even[0]);
    multiply3(b.twist, v[0].odd[1], v[1].odd[0], v[2].even[1]);
    v[1].odd[1] *= b.hourglass[0];
    v[2].odd[1] *= b.hourglass[1];
  }
};

/// Forces of one component at the nodes of a vector: of the rectangles behind them, and of those
/// before, whose last one comes from the previous call through `carry`.
POUNDING_INLINE void transform_back(bool is_translation, const Transformed& v,
                                    WideLanes (&carry)[2], double* line0, double* line1) {
  WideLanes node[2];
  for (int t = 0; t < 2; ++t) {
    const bool vanishes = is_translation && t == 0;
    const WideLanes far = vanishes ? v.odd[t] : v.even[t] + v.odd[t];
    const WideLanes near = vanishes ? -v.odd[t] : v.even[t] - v.odd[t];
    node[t] = near + carry_over(far, carry[t]);
  }
  WideLanes total0, total1;
  load(line0, total0);
  load(line1, total1);
  total0 += node[0] - node[1];
  total1 += node[0] + node[1];
  store(line0, total0);
  store(line1, total1);
}

template <typename Half>
POUNDING_INLINE void gather(const std::array<ShellLine, 2>& lines, int line_stride, int first,
                            Transformed (&v)[3]) {
  for (int c = 0; c < 3; ++c) {
    const int shift = Half::component[c] * line_stride + first;
    transform(lines[0].displacement + shift, lines[1].displacement + shift, v[c]);
  }
}

template <typename Half>
POUNDING_INLINE void scatter(const Transformed (&v)[3], WideLanes (&carry)[3][2],
                             const std::array<ShellLine, 2>& lines, int line_stride, int first) {
  for (int c = 0; c < 3; ++c) {
    const int shift = Half::component[c] * line_stride + first;
    transform_back(Half::translation[c], v[c], carry[c], lines[0].force + shift,
                   lines[1].force + shift);
  }
}

/// Sets what rectangles beyond the end of the run would add to zero.
POUNDING_INLINE void mask(const WideMask& keep, Transformed (&v)[3]) {
  for (int c = 0; c < 3; ++c) {
    for (int t = 0; t < 2; ++t) {
      mask_lanes(keep, v[c].even[t]);
      mask_lanes(keep, v[c].odd[t]);
    }
  }
}

template <typename Half>
void add_half(const ShellSplit& split, const std::array<ShellLine, 2>& lines, int line_stride,
              int count) {
  WideLanes carry[3][2] = {};
  int first = 0;
  for (; first + wide_lane_count <= count; first += wide_lane_count) {
    Transformed v[3];
    gather<Half>(lines, line_stride, first, v);
    Half::multiply(split, v);
    scatter<Half>(v, carry, lines, line_stride, first);
  }
  Transformed v[3] = {};
  const int left = count - first;
  if (left > 0) {
    gather<Half>(lines, line_stride, first, v);
    Half::multiply(split, v);
    mask(lanes_below(left), v);
  }
  scatter<Half>(v, carry, lines, line_stride, first);
}

}  // namespace

std::optional<ShellSplit> split_rectangle(const ElementProperties& properties,
                                          const std::array<double, 2>& lengths, int run_axis) {
  BlockPicker picker(stiffness_by_parity(ElementType::shell4, properties,
                                         {lengths[0], lengths[1], 0}, gmsh_corner));
  const auto value = [&](std::size_t c, std::size_t s) { return offset(c, s, run_axis); };
  ShellSplit split;
  split.stretch = picker.take2(value(0, along), value(1, across));
  split.bending = {picker.take2(value(1, both), value(5, across)),
                   picker.take2(value(0, both), value(5, along))};
  split.shear = picker.take3(value(0, across), value(1, along), value(5, sum));
  split.drilling = picker.take1(value(5, both));
  split.curvature = picker.take2(value(3, across), value(4, along));
  split.slope = {picker.take2(value(2, along), value(4, sum)),
                 picker.take2(value(2, across), value(3, sum))};
  split.twist = picker.take3(value(2, both), value(3, along), value(4, across));
  split.hourglass = {picker.take1(value(3, both)), picker.take1(value(4, both))};
  return picker.took_all() ? std::optional(split) : std::nullopt;
}

void add_shell_run(const ShellSplit& split, const std::array<ShellLine, 2>& lines, int line_stride,
                   int count) {
  add_half<Membrane>(split, lines, line_stride, count);
  add_half<Plate>(split, lines, line_stride, count);
}

}  // namespace pounding::stiffness
