#pragma once

#include <optional>
#include <string>

#include "common/types.h"
#include "soil/foundation.h"

namespace pounding {

/// Soil under the rigid mat of a structure, as the user gives it.
struct Soil {
  std::string mat;  ///< physical group of its nodes
  HalfSpace ground;
  bool disk = false;
  std::optional<std::array<double, 2>> sides;  ///< full, along x and y [m]; empty: the group's own
  double embedment = 0;                        ///< [m]
  bool frequency_dependence = true;
};

/// Place of a mat in its mesh.
struct MatPlace {
  Vector3 node{0, 0, 0};          ///< position of the node that carries the soil [m]
  Vector3 centre{0, 0, 0};        ///< of the underside [m]
  std::array<double, 2> sides{};  ///< of the box around the group along x and y [m]
};

/// Soil under a mat as the mesh places it: springs of an element of one node, and links.
struct Foundation {
  Footprint footprint;
  Vector3 centre{0, 0, 0};  ///< of the underside, where the impedances act [m]
  Vector3 arm{0, 0, 0};     ///< from the element's node to the centre [m]
  Impedances impedances;
};

/// Sides of a mat's underside along x and y [m]: as given, or the group's own; of a disk both are
/// the shorter one.
std::array<double, 2> sides_of(const Soil& soil, const MatPlace& place);

/// Foundation of a mat on its soil.
Foundation foundation_of(const Soil& soil, const MatPlace& place);

}  // namespace pounding
