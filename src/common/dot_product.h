#pragma once

#include <cstddef>

namespace pounding {

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
