#pragma once

#include <cstddef>

#include "common/octet.h"

namespace pounding {

/// out[stride * r] = sum over k of rows[r * n + k] x[k], for `count` dense rows of length n that
/// lie one after the other. Local; allocates nothing.
void multiply_rows(const double* rows, std::size_t count, std::size_t n, const double* x,
                   double* out, std::size_t stride = 1);

/// out[r] = sum over k of rows[r * n + k] x[k] in every lane.
void multiply_rows(const double* rows, std::size_t count, std::size_t n, const Octet* x,
                   Octet* out);

/// The transposed product out[k] = sum over r of rows[r * n + k] x[r] of the same rows, each sum in
/// the order of the rows; of single values and in every lane. Local; allocates nothing.
void multiply_transposed_rows(const double* rows, std::size_t count, std::size_t n, const double* x,
                              double* out);
void multiply_transposed_rows(const double* rows, std::size_t count, std::size_t n, const Octet* x,
                              Octet* out);

}  // namespace pounding
