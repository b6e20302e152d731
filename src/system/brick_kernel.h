#pragma once

#include <array>

#include "system/brick_class.h"

namespace pounding {

/// Elements that one vector instruction takes at once.
inline constexpr int lane_count = 4;

/// One line of nodes: displacements and forces, component by component (axis 0 of the split first);
/// array c starts c * line_stride doubles further.
struct BrickLine {
  const double* displacement = nullptr;
  double* force = nullptr;
};

/// Adds the forces of `count` congruent bricks in a row: brick i lies between the nodes i and i + 1
/// of four lines, line 0 on the near side of the axes 1 and 2, line 1 beyond axis 1, line 2 beyond
/// axis 2, line 3 beyond both. Up to lane_count values beyond node `count` are read, and zero is
/// added to as many forces there. The order of the sums does not depend on lane_count.
void add_brick_run(const BrickSplit& split, const std::array<BrickLine, 4>& lines, int line_stride,
                   int count);

}  // namespace pounding
