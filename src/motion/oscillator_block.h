#pragma once

#include <algorithm>
#include <span>

#include "common/octet.h"
#include "motion/oscillator_motion.h"
#include "motion/oscillator_step.h"

namespace pounding::oscillator {

/// Oscillators whose steps are summed as series, side by side: their chains of sums hide each
/// other's latency. In the variables of OscillatorStep.
struct OscillatorBlock {
  static constexpr std::size_t vectors = 3;
  static constexpr std::size_t size = vectors * octet_size;
  using Vector = Octet[vectors];

  /// `some`: one to `size` of them; they must outlive this object.
  explicit OscillatorBlock(std::span<const Oscillator> some) : oscillators(some) {
    for (std::size_t i = 0; i < size; ++i) {
      const auto [state_part, load_part] = oscillator_step(of(i).theta, of(i).xi);
      const std::size_t b = i / octet_size, l = i % octet_size;
      for (std::size_t r = 0; r < 2; ++r) {
        for (std::size_t c = 0; c < 2; ++c) {
          A[r][c][b].set(l, state_part[r][c]);
          B[r][c][b].set(l, load_part[r][c]);
        }
      }
    }
  }

  /// The oscillator in a lane: the last one fills up.
  const Oscillator& of(std::size_t lane) const {
    return oscillators[std::min(lane, oscillators.size() - 1)];
  }

  /// (u, h u') of vector b at the end of a step from those at its start and h^2 times the
  /// acceleration at both ends.
  void step(std::size_t b, const Octet& before, const Octet& behind, Octet& u, Octet& v) const {
    Octet u1 = B[0][0][b] * before, v1 = B[1][0][b] * before;
    add_product(B[0][1][b], behind, u1);
    add_product(B[1][1][b], behind, v1);
    add_product(A[0][1][b], v, u1);
    add_product(A[1][1][b], v, v1);
    add_product(A[0][0][b], u, u1);
    add_product(A[1][0][b], u, v1);
    u = u1;
    v = v1;
  }

  std::span<const Oscillator> oscillators;
  Vector A[2][2], B[2][2];
};

/// The oscillators of a block at the start of a stretch of the record.
struct BlockState {
  OscillatorBlock::Vector u, v;
};

}  // namespace pounding::oscillator
