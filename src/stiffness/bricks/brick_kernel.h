#pragma once

#include <array>
#include <cstddef>

#include "stiffness/bricks/brick_stencil.h"

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

/// Sides of a line on which the bricks lie, along axis 1.
enum class Sides { before, behind, both };

/// Adds the forces that the displacements of `line` cause through `count` congruent bricks in a row
/// along axis 0, on each of the `sides`: on itself and on the lines `before` and `behind`, those of
/// them that bound the bricks. Brick i lies between the pairs i and i + 1 of each line. With
/// `first_behind` the forces of the line behind are set instead. Up to lane_count - 1 values beyond
/// pair `count` are read, and zero is added to (or set in) as many forces there.
void add_line_forces(const BrickStencil& stencil, Sides sides, bool first_behind,
                     const PairLine& line, const PairLine& before, const PairLine& behind,
                     std::ptrdiff_t stride, int count);

}  // namespace pounding::stiffness
