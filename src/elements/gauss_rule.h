#pragma once

#include <array>

#include "common/types.h"

/// Two-point Gauss-Legendre rule per direction on [-1, 1]: exact for cubics, all weights 1.
namespace pounding {

inline constexpr double gauss_abscissa = 0.57735026918962576451;  // 1 / sqrt(3)

/// Signs of the eight corners of the reference cube, in Gmsh's node order: bottom
/// counter-clockwise seen from above, then top.
inline constexpr std::array<Vector3, 8> hex_corners{{{-1, -1, -1},
                                                     {1, -1, -1},
                                                     {1, 1, -1},
                                                     {-1, 1, -1},
                                                     {-1, -1, 1},
                                                     {1, -1, 1},
                                                     {1, 1, 1},
                                                     {-1, 1, 1}}};

/// The eight points of the 2 x 2 x 2 rule, each of weight 1.
constexpr std::array<Vector3, 8> hex_gauss_points() {
  std::array<Vector3, 8> points = hex_corners;
  for (Vector3& point : points) {
    for (double& coordinate : point) coordinate *= gauss_abscissa;
  }
  return points;
}

}  // namespace pounding
