#pragma once

#include <optional>

#include "scene/scene.h"

namespace pounding {

/// Laws of shells, in the places that a Region has for laws of sections: shear[0] is that of the
/// stress [Pa] over the shear strain in the plane; bending[0] and bending[1] are the skeletons of a
/// shell that cracks, of the moment per length over the curvature about one axis and of the force
/// per length over the strain along one axis, tension positive.

/// Shell that cracks by damage, see interactions/laws/cracking_shell.h. Ratios are of slopes: of
/// force over strain while damage grows, over that of the sound shell.
struct ShellCracking {
  double force = 0;        ///< in tension at which damage begins [N/m]
  double moment = 0;       ///< in bending likewise [N m/m]
  double tension = 0;      ///< ratio in tension
  double compression = 1;  ///< ratio in compression; 1: no damage by it
  double bending = 0;      ///< ratio in bending
};

/// Skeleton of two slopes, the first one `stiffness`, one after another `force`.
inline Skeleton two_slopes(double stiffness, double force, double ratio) {
  return {{{force / stiffness, force}}, ratio * stiffness};
}

/// Puts the law of a shell that cracks, whose material and thickness are known, into its region.
inline void set_cracking(Region& region, const ShellCracking& law) {
  const double t = region.thickness;
  const double membrane = region.material.young * t, bent = membrane * t * t / 12;
  Hysteresis& bending = region.yielding.bending[0].emplace();
  bending.positive = bending.negative = two_slopes(bent, law.moment, law.bending);
  Hysteresis& plane = region.yielding.bending[1].emplace();
  plane.positive = two_slopes(membrane, law.force, law.tension);
  plane.negative = two_slopes(membrane, law.force, law.compression);
}

/// The law of a shell that cracks; none for all others.
inline std::optional<ShellCracking> cracking_of(const Region& region) {
  if (!is_shell(region.element) || !region.yielding.bending[0]) return {};
  const Hysteresis& bending = *region.yielding.bending[0];
  const Hysteresis& plane = *region.yielding.bending[1];
  const double stiffness = plane.first_slope();
  return ShellCracking{plane.positive.breaks.front().force, bending.positive.breaks.front().force,
                       plane.positive.last_slope / stiffness, plane.negative.last_slope / stiffness,
                       bending.positive.last_slope / bending.first_slope()};
}

/// The option that takes the stiffness of a region's elements out of K, of shells as well.
inline const char* option_of_law(const Region& region) {
  if (!region.inelastic || !is_shell(region.element)) return law_option(region);
  return region.yielding.shear[0] ? "<structure>_<group>_shear_skeleton"
                                  : "<structure>_<group>_cracking_force";
}

}  // namespace pounding
