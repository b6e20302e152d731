#pragma once

#include <array>
#include <cstddef>

namespace pounding::stiffness {

/// A line of node pairs: sums and differences of their displacements, each three arrays (axis 0 of
/// the split first) followed by three arrays of forces; array c starts c * stride doubles further.
struct PairLine {
  double* sum = nullptr;
  double* difference = nullptr;
};

/// Displacements of a pair from those of its chains, which may lend it their lines.
void split_pair(const double* near, const double* far, int count, std::ptrdiff_t stride,
                const PairLine& pair);
/// Forces of the chains, from those of a pair: set if they are the `first`, else added.
void join_pair(const PairLine& pair, int count, std::ptrdiff_t stride, std::array<bool, 2> first,
               double* near, double* far);

}  // namespace pounding::stiffness
