#pragma once

#include <span>
#include <vector>

#include "motion/oscillator_block.h"
#include "motion/record_stretch.h"

namespace pounding::oscillator {

/// States of oscillators at the starts of the stretches of a record, without the steps between:
///
///     x_N = A^N x_0 + sum over k = 0..N of w_k h^2 a_k,     w_k = A^(N-k) b_1 + A^(N-1-k) b_0,
///
/// b_0 and b_1 the columns of B, w_0 without the first of the two and w_N = b_1 alone: two products
/// per oscillator and sample in place of eight, and no chain of sums.
class StretchJump {
 public:
  explicit StretchJump(const OscillatorBlock& block);

  /// states[s]: at the start of stretch s, from rest at the first. `acceleration`: see Stretch.
  void find_starts(std::span<const double> acceleration, double h2,
                   std::span<const Stretch> stretches, std::span<BlockState> states) const;

 private:
  /// Sums of w_k a_k over `count` stretches that follow each other, from sample `first` on.
  template <std::size_t count>
  void add_loads(const double* first, BlockState* sums) const;

  OscillatorBlock::Vector state_[2][2];  ///< A^N
  std::vector<BlockState> weights_;      ///< w_k, k = 0..N
};

}  // namespace pounding::oscillator
