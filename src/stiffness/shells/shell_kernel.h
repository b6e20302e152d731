#pragma once

#include <array>

#include "stiffness/shells/shell_class.h"

namespace pounding::stiffness {

/// A line of nodes: displacements and forces, component by component, those of the split's axes 0,
/// 1 and the normal first, then the rotations about them; array c starts c * line_stride further.
struct ShellLine {
  const double* displacement = nullptr;
  double* force = nullptr;
};

/// Adds the forces of `count` congruent rectangles in a row: rectangle i lies between the nodes i
/// and i + 1 of two lines of six components, line 0 on the near side of axis 1. Up to lane_count
/// values beyond node `count` are read, and zero is added to as many forces there. The order of the
/// sums does not depend on lane_count.
void add_shell_run(const ShellSplit& split, const std::array<ShellLine, 2>& lines, int line_stride,
                   int count);

}  // namespace pounding::stiffness
