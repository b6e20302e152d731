#include "stiffness/bricks/pair_line.h"

#include "common/wide_lanes.h"

namespace pounding::stiffness {

void split_pair(const double* near, const double* far, int count, std::ptrdiff_t stride,
                const PairLine& pair) {
  for (int c = 0; c < 3; ++c) {
    for (int p = 0; p < count; p += wide_lane_count) {
      WideLanes a, b;
      load(near + c * stride + p, a);
      load(far + c * stride + p, b);
      store(pair.sum + c * stride + p, b + a);
      store(pair.difference + c * stride + p, b - a);
    }
  }
}

void join_pair(const PairLine& pair, int count, std::ptrdiff_t stride, std::array<bool, 2> first,
               double* near, double* far) {
  const auto pass_on = [](bool set, WideLanes& force, double* to) {
    if (!set) {
      WideLanes before;
      load(to, before);
      force += before;
    }
    store(to, force);
  };
  for (int c = 3; c < 6; ++c) {
    for (int p = 0; p < count; p += wide_lane_count) {
      WideLanes sum, difference;
      load(pair.sum + c * stride + p, sum);
      load(pair.difference + c * stride + p, difference);
      WideLanes a = sum - difference;
      WideLanes b = sum + difference;
      pass_on(first[0], a, near + c * stride + p);
      pass_on(first[1], b, far + c * stride + p);
    }
  }
}

}  // namespace pounding::stiffness
