#include "common/row_products.h"

#include <algorithm>

#include "common/lanes.h"

namespace pounding {
namespace {

constexpr std::size_t lanes = lane_count;

/// `count` <= 4 rows: each value of x is read once.
template <std::size_t count>
void multiply_together(const double* rows, std::size_t n, const double* x, double* out,
                       std::size_t stride = 1) {
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

/// Rows whose sums have registers of their own, beside two factors.
constexpr std::size_t batch_rows = batch_parts == 1 ? 8 : batch_parts == 2 ? 6 : 3;

/// `count` rows; their sums stay in registers.
template <std::size_t count>
void multiply_together(const double* rows, std::size_t n, const BatchValue* x, BatchValue* out) {
  BatchValue sums[count]{};
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t r = 0; r < count; ++r) add_product(all_eight(rows[r * n + k]), x[k], sums[r]);
  }
  for (std::size_t r = 0; r < count; ++r) out[r] = sums[r];
}

/// out[k] += sum over r of parts[r] rows[r * n + k].
template <std::size_t count>
void add_together(const double* rows, std::size_t n, const double* parts, double* out) {
  std::size_t k = 0;
  for (; k + lanes <= n; k += lanes) {
    Lanes sum;
    load(out + k, sum);
    for (std::size_t r = 0; r < count; ++r) {
      Lanes row;
      load(rows + r * n + k, row);
      add_product(all_lanes(parts[r]), row, sum);
    }
    store(out + k, sum);
  }
  for (; k < n; ++k) {
    for (std::size_t r = 0; r < count; ++r) add_product(parts[r], rows[r * n + k], out[k]);
  }
}

template <std::size_t count>
void add_together(const double* rows, std::size_t n, const BatchValue* parts, BatchValue* out) {
  BatchValue scale[count];
  for (std::size_t r = 0; r < count; ++r) scale[r] = parts[r];
  for (std::size_t k = 0; k < n; ++k) {
    BatchValue sum = out[k];
    for (std::size_t r = 0; r < count; ++r) add_product(all_eight(rows[r * n + k]), scale[r], sum);
    out[k] = sum;
  }
}

template <std::size_t count, typename Value>
void add_both_ways(const double* rows, const double* weights, std::size_t n, const Value* x,
                   Value* parts, Value* out) {
  multiply_together<count>(rows, n, x, parts);
  for (std::size_t r = 0; r < count; ++r) parts[r] = (Value{} + weights[r]) * parts[r];
  add_together<count>(rows, n, parts, out);
}

/// B^T diag(weights) B x in blocks of `together` rows.
template <std::size_t together, typename Value>
void multiply_blocks_both_ways(const double* rows, const double* weights, std::size_t count,
                               std::size_t n, const Value* x, Value* parts, Value* out) {
  std::fill_n(out, n, Value{});
  std::size_t r = 0;
  for (; r + together <= count; r += together) {
    add_both_ways<together>(rows + r * n, weights + r, n, x, parts + r, out);
  }
  for (; r < count; ++r) add_both_ways<1>(rows + r * n, weights + r, n, x, parts + r, out);
}

}  // namespace

void multiply_rows(const double* rows, std::size_t count, std::size_t n, const double* x,
                   double* out, std::size_t stride) {
  std::size_t r = 0;
  for (; r + 4 <= count; r += 4) multiply_together<4>(rows + r * n, n, x, out + stride * r, stride);
  for (; r < count; ++r) multiply_together<1>(rows + r * n, n, x, out + stride * r, stride);
}

void multiply_rows(const double* rows, std::size_t count, std::size_t n, const BatchValue* x,
                   BatchValue* out) {
  std::size_t r = 0;
  for (; r + batch_rows <= count; r += batch_rows) {
    multiply_together<batch_rows>(rows + r * n, n, x, out + r);
  }
  for (; r + 3 <= count; r += 3) multiply_together<3>(rows + r * n, n, x, out + r);
  for (; r < count; ++r) multiply_together<1>(rows + r * n, n, x, out + r);
}

void add_rows(const double* rows, std::size_t count, std::size_t n, const double* parts,
              double* out) {
  std::size_t r = 0;
  for (; r + 4 <= count; r += 4) add_together<4>(rows + r * n, n, parts + r, out);
  for (; r < count; ++r) add_together<1>(rows + r * n, n, parts + r, out);
}

void multiply_both_ways(const double* rows, const double* weights, std::size_t count, std::size_t n,
                        const double* x, double* parts, double* out) {
  multiply_blocks_both_ways<4>(rows, weights, count, n, x, parts, out);
}

void multiply_both_ways(const double* rows, const double* weights, std::size_t count, std::size_t n,
                        const BatchValue* x, BatchValue* parts, BatchValue* out) {
  multiply_blocks_both_ways<batch_rows>(rows, weights, count, n, x, parts, out);
}

}  // namespace pounding
