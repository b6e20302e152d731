#pragma once

#include <vector>

#include "stiffness/rows/element_rows.h"

namespace pounding::testing_support {

/// Bricks of an nx x ny x nz grid, x fastest.
inline std::vector<stiffness::BrickElement> grid(int nx, int ny, int nz) {
  std::vector<stiffness::BrickElement> bricks;
  const auto node = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        stiffness::BrickElement brick;
        for (int bits = 0; bits < 8; ++bits) {
          brick.nodes[static_cast<std::size_t>(bits)] =
              node(i + (bits & 1), j + (bits >> 1 & 1), k + (bits >> 2));
        }
        bricks.push_back(brick);
      }
  return bricks;
}

}  // namespace pounding::testing_support
