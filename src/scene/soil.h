#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/types.h"
#include "elements/element_properties.h"
#include "soil/foundation.h"
#include "soil/impedance_fit.h"

namespace pounding {

/// Soil under the rigid mat of a structure, as the user gives it: a half-space, or a table of
/// impedances over the frequency.
struct Soil {
  std::string mat;  ///< physical group of its nodes
  HalfSpace ground;
  bool disk = false;
  std::optional<std::array<double, 2>> sides;  ///< full, along x and y [m]; empty: the group's own
  double embedment = 0;                        ///< [m]
  bool frequency_dependence = true;
  std::string table;                   ///< file; empty: a half-space
  std::optional<ImpedanceFit> fitted;  ///< to the table, once it is read; see fit_soil
};

/// Place of a mat in its mesh.
struct MatPlace {
  Vector3 node{0, 0, 0};          ///< position of the node that carries the soil [m]
  Vector3 centre{0, 0, 0};        ///< of the underside [m]
  std::array<double, 2> sides{};  ///< of the box around the group along x and y [m]
};

/// Soil under a mat as the mesh places it: springs of an element of one node, and links.
struct Foundation {
  Footprint footprint;                        ///< of a half-space
  Vector3 centre{0, 0, 0};                    ///< of the underside, where the impedances act [m]
  std::vector<DirectedImpedance> impedances;  ///< about the centre
  std::vector<GroundSpring> springs;          ///< likewise, of the node over the arm
};

/// Sides of a mat's underside along x and y [m]: as given, or the group's own; of a disk both are
/// the shorter one.
std::array<double, 2> sides_of(const Soil& soil, const MatPlace& place);

/// Foundation of a mat on its soil.
Foundation foundation_of(const Soil& soil, const MatPlace& place);

}  // namespace pounding
