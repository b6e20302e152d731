#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/types.h"
#include "elements/element_properties.h"
#include "soil/foundation.h"

namespace pounding {

/// Misfit of the worst term of some coupled motions over its diagonals, as a file states it.
struct FitMisfit {
  std::array<bool, 6> motions{};
  double largest = 0;     ///< over the frequencies [-]
  double largest_at = 0;  ///< its frequency [Hz]
  double mean = 0;        ///< over the frequencies [-]
};

/// Springs, dashpots and masses of a file of soil.
struct FittedSoil {
  std::vector<DirectedImpedance> parts;  ///< they act side by side
  std::vector<FitMisfit> misfits;
};

/// Soil under the rigid mat of a structure, as the user gives it: a half-space, or a file.
struct Soil {
  std::string mat;  ///< physical group of its nodes
  HalfSpace ground;
  bool disk = false;
  std::optional<std::array<double, 2>> sides;  ///< full, along x and y [m]; empty: the group's own
  double embedment = 0;                        ///< [m]
  bool frequency_dependence = true;
  std::string table;                 ///< file; empty: a half-space
  std::optional<FittedSoil> fitted;  ///< once the file is read; see read_soil_file
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
