#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/// Scalar product of two arrays by four partial sums in a fixed order: the same bits from every
/// build, without waiting on one sum.
inline double dot_product(const double* a, const double* b, std::size_t n) {
  double sum0 = 0;
  double sum1 = 0;
  double sum2 = 0;
  double sum3 = 0;
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    sum0 += a[i] * b[i];
    sum1 += a[i + 1] * b[i + 1];
    sum2 += a[i + 2] * b[i + 2];
    sum3 += a[i + 3] * b[i + 3];
  }
  for (; i < n; ++i) sum0 += a[i] * b[i];
  return (sum0 + sum1) + (sum2 + sum3);
}

}  // namespace pounding
