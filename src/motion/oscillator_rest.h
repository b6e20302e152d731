#pragma once

#include "common/octet.h"

namespace pounding::oscillator {

/// Below it an oscillator is at rest: subnormal numbers would only cost time.
inline constexpr double rest = 1e-250;

/// Stops the oscillators that are at rest at the end of a stretch with this load.
inline void come_to_rest(double load, Octet& u, Octet& v) {
  const Octet size = magnitude(u) + magnitude(v) + all_octet(load);
  const OctetMask still = size < all_octet(rest);
  u = choose(still, Octet{}, u);
  v = choose(still, Octet{}, v);
}

}  // namespace pounding::oscillator
