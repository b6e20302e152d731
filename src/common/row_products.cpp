#include "common/row_products.h"

#include <cstring>

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

/// out[w] = sum over l of entries[across * w + along * l] x[l], `length` products in each of
/// `width` sums, which stay in registers.
template <std::size_t width>
void multiply_together(const double* entries, std::size_t across, std::size_t along,
                       std::size_t length, const Octet* x, Octet* out) {
  Octet sums[width]{};
  for (std::size_t l = 0; l < length; ++l) {
    for (std::size_t w = 0; w < width; ++w) {
      add_product(all_octet(entries[across * w + along * l]), x[l], sums[w]);
    }
  }
  for (std::size_t w = 0; w < width; ++w) out[w] = sums[w];
}

/// Eight times `width` elements of the transposed product, eight neighbours in a vector.
template <std::size_t width>
void multiply_columns(const double* rows, std::size_t count, std::size_t n, const double* x,
                      double* out) {
  Octet sums[width]{};
  for (std::size_t r = 0; r < count; ++r) {
    for (std::size_t k = 0; k < width; ++k) {
      Octet row;
      std::memcpy(&row, rows + r * n + octet_size * k, sizeof row);
      add_product(all_octet(x[r]), row, sums[k]);
    }
  }
  std::memcpy(out, sums, sizeof sums);
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
  for (; r + 8 <= count; r += 8) multiply_together<8>(rows + r * n, n, 1, n, x, out + r);
  for (; r + 3 <= count; r += 3) multiply_together<3>(rows + r * n, n, 1, n, x, out + r);
  for (; r < count; ++r) multiply_together<1>(rows + r * n, n, 1, n, x, out + r);
}

void multiply_transposed_rows(const double* rows, std::size_t count, std::size_t n, const double* x,
                              double* out) {
  std::size_t k = 0;
  for (; k + 4 * octet_size <= n; k += 4 * octet_size) {
    multiply_columns<4>(rows + k, count, n, x, out + k);
  }
  for (; k + octet_size <= n; k += octet_size) multiply_columns<1>(rows + k, count, n, x, out + k);
  for (; k < n; ++k) {
    double sum = 0;
    for (std::size_t r = 0; r < count; ++r) add_product(x[r], rows[r * n + k], sum);
    out[k] = sum;
  }
}

void multiply_transposed_rows(const double* rows, std::size_t count, std::size_t n, const Octet* x,
                              Octet* out) {
  std::size_t k = 0;
  for (; k + 8 <= n; k += 8) multiply_together<8>(rows + k, 1, n, count, x, out + k);
  for (; k < n; ++k) multiply_together<1>(rows + k, 1, n, count, x, out + k);
}

}  // namespace pounding
