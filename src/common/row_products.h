#pragma once

#include <cstddef>

#include "common/batch_value.h"

namespace pounding {

/// out[stride * r] = sum over k of rows[r * n + k] x[k], for `count` dense rows of length n that
/// lie one after the other. Local; allocates nothing.
void multiply_rows(const double* rows, std::size_t count, std::size_t n, const double* x,
                   double* out, std::size_t stride = 1);

/// out[r] = sum over k of rows[r * n + k] x[k] in every lane.
void multiply_rows(const double* rows, std::size_t count, std::size_t n, const BatchValue* x,
                   BatchValue* out);

/// out[k] += sum over r of parts[r] rows[r * n + k], for `count` such rows.
void add_rows(const double* rows, std::size_t count, std::size_t n, const double* parts,
              double* out);

/// parts[r] = weights[r] (b_r . x) and out = sum over r of parts[r] b_r, with b_r the `count` dense
/// rows of length n that lie one after the other: B^T diag(weights) B x, in which each row is read
/// once; of single values and in every lane. Local; allocates nothing.
void multiply_both_ways(const double* rows, const double* weights, std::size_t count, std::size_t n,
                        const double* x, double* parts, double* out);
void multiply_both_ways(const double* rows, const double* weights, std::size_t count, std::size_t n,
                        const BatchValue* x, BatchValue* parts, BatchValue* out);

}  // namespace pounding
