#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace pounding {

/// Largest |value|, 0 of none; numbers that are not finite may pass unseen.
inline double largest_magnitude(std::span<const double> values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

inline bool all_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

}  // namespace pounding
