#include "system/brick_kernel.h"

#include "system/lanes.h"

#define POUNDING_INLINE static inline __attribute__((always_inline))

namespace pounding {
namespace {

/// One component of the eight nodes of each brick: rows of H with axes 1 and 2 as 0: none, 1: axis
/// 1, 2: axis 2, 3: both; `even` along the run without, `odd` with axis 0.
struct Transformed {
  Lanes even[4];  // even[0], the mean, is neither needed nor set
  Lanes odd[4];
};

/// Walsh-Hadamard transform of bricks i .. i + 3 between the nodes of four lines.
POUNDING_INLINE void transform(const double* const (&line)[4], Transformed& out) {
  Lanes sum[4];
  Lanes difference[4];
  for (int l = 0; l < 4; ++l) {
    Lanes near;
    Lanes far;
    load(line[l], near);
    load(line[l] + 1, far);
    sum[l] = near + far;
    difference[l] = far - near;
  }
  const Lanes step_near = sum[1] - sum[0];
  const Lanes step_far = sum[3] - sum[2];
  out.even[1] = step_near + step_far;
  out.even[2] = (sum[2] + sum[3]) - (sum[0] + sum[1]);
  out.even[3] = step_far - step_near;
  const Lanes odd_near = difference[0] + difference[1];
  const Lanes odd_far = difference[2] + difference[3];
  const Lanes slope_near = difference[1] - difference[0];
  const Lanes slope_far = difference[3] - difference[2];
  out.odd[0] = odd_near + odd_far;
  out.odd[1] = slope_near + slope_far;
  out.odd[2] = odd_far - odd_near;
  out.odd[3] = slope_far - slope_near;
}

POUNDING_INLINE void multiply2(const std::array<double, 3>& b, Lanes& x, Lanes& y) {
  const Lanes first = b[0] * x + b[1] * y;
  y = b[1] * x + b[2] * y;
  x = first;
}

POUNDING_INLINE void multiply3(const std::array<double, 6>& b, Lanes& x, Lanes& y, Lanes& z) {
  const Lanes first = b[0] * x + b[1] * y + b[2] * z;
  const Lanes second = b[1] * x + b[3] * y + b[4] * z;
  z = b[2] * x + b[4] * y + b[5] * z;
  x = first;
  y = second;
}

/// The blocks of B, in place.
POUNDING_INLINE void multiply(const BrickSplit& b, Transformed (&v)[3]) {
  multiply3(b.dilation, v[0].odd[0], v[1].even[1], v[2].even[2]);
  multiply3(b.twist, v[0].even[3], v[1].odd[2], v[2].odd[1]);
  multiply2(b.bending[0], v[1].odd[1], v[2].odd[2]);
  multiply2(b.bending[1], v[0].odd[1], v[2].even[3]);
  multiply2(b.bending[2], v[0].odd[2], v[1].even[3]);
  multiply2(b.shear[0], v[0].even[1], v[1].odd[0]);
  multiply2(b.shear[1], v[0].even[2], v[2].odd[0]);
  multiply2(b.shear[2], v[1].even[2], v[2].even[1]);
  v[0].odd[3] *= b.hourglass[0];
  v[1].odd[3] *= b.hourglass[1];
  v[2].odd[3] *= b.hourglass[2];
}

/// Sets what bricks beyond the end of the run would add to zero.
POUNDING_INLINE void mask(const LaneMask& keep, Transformed (&v)[3]) {
  for (int c = 0; c < 3; ++c) {
    for (int t = 0; t < 4; ++t) {
      if (t > 0) {
        v[c].even[t] = (Lanes)((LaneMask)v[c].even[t] & keep);
      }
      v[c].odd[t] = (Lanes)((LaneMask)v[c].odd[t] & keep);
    }
  }
}

/// Forces of one component at nodes i .. i + 3: of the bricks i .. i + 3 behind them, and of the
/// bricks before, whose last one comes from the previous call through `carry`.
POUNDING_INLINE void transform_back(const Transformed& v, Lanes (&carry)[4],
                                    double* const (&line)[4]) {
  Lanes node[4];
  for (int t = 0; t < 4; ++t) {
    const Lanes far = t == 0 ? v.odd[0] : v.even[t] + v.odd[t];
    const Lanes near = t == 0 ? -v.odd[0] : v.even[t] - v.odd[t];
    node[t] = near + __builtin_shuffle(carry[t], far, LaneMask{3, 4, 5, 6});
    carry[t] = far;
  }
  const Lanes near_sum = node[0] - node[2];
  const Lanes near_step = node[1] - node[3];
  const Lanes far_sum = node[0] + node[2];
  const Lanes far_step = node[1] + node[3];
  const Lanes force[4] = {near_sum - near_step, near_sum + near_step, far_sum - far_step,
                          far_sum + far_step};
  for (int l = 0; l < 4; ++l) {
    Lanes total;
    load(line[l], total);
    total += force[l];
    store(line[l], total);
  }
}

/// Bricks first .. first + 3 of a run, to be multiplied.
POUNDING_INLINE void gather(const std::array<BrickLine, 4>& lines, int line_stride, int first,
                            Transformed (&v)[3]) {
  for (int c = 0; c < 3; ++c) {
    const int shift = c * line_stride + first;
    const double* const from[4] = {lines[0].displacement + shift, lines[1].displacement + shift,
                                   lines[2].displacement + shift, lines[3].displacement + shift};
    transform(from, v[c]);
  }
}

/// Their forces, and those that the bricks before left in `carry`.
POUNDING_INLINE void scatter(const Transformed (&v)[3], Lanes (&carry)[3][4],
                             const std::array<BrickLine, 4>& lines, int line_stride, int first) {
  for (int c = 0; c < 3; ++c) {
    const int shift = c * line_stride + first;
    double* const to[4] = {lines[0].force + shift, lines[1].force + shift, lines[2].force + shift,
                           lines[3].force + shift};
    transform_back(v[c], carry[c], to);
  }
}

}  // namespace

void add_brick_run(const BrickSplit& split, const std::array<BrickLine, 4>& lines, int line_stride,
                   int count) {
  Lanes carry[3][4] = {};
  int first = 0;
  for (; first + lane_count <= count; first += lane_count) {
    Transformed v[3];
    gather(lines, line_stride, first, v);
    multiply(split, v);
    scatter(v, carry, lines, line_stride, first);
  }
  Transformed v[3] = {};
  const int left = count - first;
  if (left > 0) {
    gather(lines, line_stride, first, v);
    multiply(split, v);
    const LaneMask lane{0, 1, 2, 3};
    mask(lane < LaneMask{left, left, left, left}, v);
  }
  scatter(v, carry, lines, line_stride, first);
}

}  // namespace pounding
