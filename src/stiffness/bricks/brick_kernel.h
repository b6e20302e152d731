#pragma once

#include <cstddef>

#include "stiffness/bricks/brick_stencil.h"
#include "stiffness/bricks/pair_line.h"

namespace pounding::stiffness {

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
