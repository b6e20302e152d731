#pragma once

#include "common/types.h"

namespace pounding::stiffness {

/// How many elements of a structure, over all ranks, are applied in which way.
struct ElementKinds {
  GlobalIndex bricks = 0;      ///< split by their mid-planes, in rows
  GlobalIndex rectangles = 0;  ///< shells likewise
  GlobalIndex general = 0;     ///< other hexahedra, quadrangles, triangles, by their strains
  GlobalIndex beams = 0;       ///< from their local stiffnesses
  GlobalIndex other = 0;       ///< in a sparse matrix
};

}  // namespace pounding::stiffness
