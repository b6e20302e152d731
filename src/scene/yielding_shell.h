#pragma once

#include <optional>

#include "scene/hysteresis.h"

namespace pounding {

/// Shell that cracks by damage, see interactions/laws/cracking_shell.h. Ratios are of slopes: of
/// force over strain while damage grows, over that of the sound shell.
struct ShellCracking {
  double force = 0;        ///< in tension at which damage begins [N/m]
  double moment = 0;       ///< in bending likewise [N m/m]
  double tension = 0;      ///< ratio in tension
  double compression = 1;  ///< ratio in compression; 1: no damage by it
  double bending = 0;      ///< ratio in bending
};

/// Law that a shell follows by its mean strains: one of both at most.
struct YieldingShell {
  std::optional<Hysteresis> shear;  ///< stress [Pa] over the shear strain in the plane
  std::optional<ShellCracking> cracking;

  bool any() const { return shear || cracking; }
  /// The option that gave it.
  const char* option() const {
    return shear ? "<structure>_<group>_shear_skeleton" : "<structure>_<group>_cracking_force";
  }
};

}  // namespace pounding
