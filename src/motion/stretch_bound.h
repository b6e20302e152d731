#pragma once

#include <span>
#include <vector>

#include "motion/oscillator_block.h"
#include "motion/record_stretch.h"

namespace pounding::oscillator {

/// Bounds of the displacements of the oscillators of a block within a whole stretch of N steps,
/// from the states at both of its ends alone. The free motion from (u, h u') at the start is R
/// exp(-xi theta s) cos(q theta s + phase) with R^2 = u^2 + z^2, z = (h u' / theta + xi u) / q; the
/// load adds at most L, the smaller of the largest |h^2 a| times the integral of the response to an
/// impulse, and of the largest |h v| times that of its slope, which is below N. So |u| <= R + L;
/// and u lies within N^2 / 8 times the largest |h^2 u''| of its chord, the part of the load within
/// N / 2 times the range of h v as well:
///
///     |u| <= max(|u_0|, |u_N|) + D + N^2 / 8 (2 xi theta (theta R + N |h^2 a|) + theta^2 (R + L)),
///
/// D = min(N^2 / 8 |h^2 a|, N / 2 range).
class StretchBound {
 public:
  explicit StretchBound(const OscillatorBlock& block);

  /// Whether the bounds leave open that a displacement within the stretch is larger than `peak`,
  /// per oscillator, for any of them.
  bool may_exceed(const BlockState& start, const BlockState& end, const Stretch& stretch,
                  const OscillatorBlock::Vector& peak) const;

 private:
  OscillatorBlock::Vector slope_;         ///< z = slope_ h u' + share_ u
  OscillatorBlock::Vector share_;         ///< xi / q
  OscillatorBlock::Vector impulse_;       ///< integral of the response to an impulse over N steps
  OscillatorBlock::Vector of_amplitude_;  ///< N^2 / 8 (2 xi theta^2 + theta^2)
  OscillatorBlock::Vector of_load_;       ///< N^2 / 8 2 xi theta N
  OscillatorBlock::Vector of_response_;   ///< N^2 / 8 theta^2
};

}  // namespace pounding::oscillator
