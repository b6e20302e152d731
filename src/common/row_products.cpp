#include "common/row_products.h"

#include "common/lanes.h"

namespace pounding {
namespace {

constexpr std::size_t lanes = lane_count;

/// `count` <= 4 rows: each value of x is read once.
template <std::size_t count>
void multiply_together(const double* rows, std::size_t n, const double* x, double* out,
                       std::size_t stride) {
  Lanes sums[2][count]{};  // two chains per row hide the latency of the sums
  std::size_t i = 0;
  for (; i + 2 * lanes <= n; i += 2 * lanes) {
    for (std::size_t half = 0; half < 2; ++half) {
      Lanes values;
      load(x + i + half * lanes, values);
      for (std::size_t r = 0; r < count; ++r) {
        Lanes row;
        load(rows + r * n + i + half * lanes, row);
        add_product(row, values, sums[half][r]);
      }
    }
  }
  for (std::size_t r = 0; r < count; ++r) {
    double sum = add_up(sums[0][r] + sums[1][r]);
    for (std::size_t k = i; k < n; ++k) sum += rows[r * n + k] * x[k];
    out[r * stride] = sum;
  }
}

template <std::size_t count>
void multiply_together(const double* rows, std::size_t n, const Octet* x, Octet* out) {
  Octet sums[count]{};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t r = 0; r < count; ++r) {
      add_product(all_octet(rows[r * n + i]), x[i], sums[r]);
    }
  }
  for (std::size_t r = 0; r < count; ++r) out[r] = sums[r];
}

}  // namespace

void multiply_rows(const double* rows, std::size_t count, std::size_t n, const double* x,
                   double* out, std::size_t stride) {
  std::size_t r = 0;
  for (; r + 4 <= count; r += 4) multiply_together<4>(rows + r * n, n, x, out + stride * r, stride);
  for (; r < count; ++r) multiply_together<1>(rows + r * n, n, x, out + stride * r, stride);
}

void multiply_rows(const double* rows, std::size_t count, std::size_t n, const Octet* x,
                   Octet* out) {
  std::size_t r = 0;
  for (; r + 8 <= count; r += 8) multiply_together<8>(rows + r * n, n, x, out + r);
  for (; r + 3 <= count; r += 3) multiply_together<3>(rows + r * n, n, x, out + r);
  for (; r < count; ++r) multiply_together<1>(rows + r * n, n, x, out + r);
}

}  // namespace pounding
