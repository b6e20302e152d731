#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "scene/hysteresis.h"

namespace pounding {

/// Nonlinear behaviour of springs and bars, beyond their stiffness, as the user gives it.
struct NonlinearSpring {
  /// Force or moment at which each component yields, along and about x, y, z, of a bar the first
  /// one [N, N m]; 0: never.
  std::array<double, 6> yield_force{};
  double hardening = 0;  ///< stiffness after yield over that before [-]
  /// The two translations that yield together, on a circle, and the third one; equal: none do.
  std::array<int, 3> circle{0, 0, 0};
  /// Coefficient of a sliding bearing, which yields at this times the compression along the third
  /// [-]; 0: none.
  double friction = 0;
  double radius = 0;            ///< of a friction pendulum [m]; 0: none
  double dashpot_exponent = 1;  ///< power of the rate to which its dashpots go [-]
  /// Stiffness in series with each dashpot, along and about x, y, z [N/m, N m]; 0: rigid.
  std::array<double, 6> dashpot_stiffness{};
  double slack = 0;  ///< of a tension-only bar, stretched so far before it pulls [m]
  /// Rule by which it yields, and skeleton of the one component that has one; of a bar over its
  /// strain. Without breaks the skeleton is that of yield force and hardening.
  Hysteresis law;

  /// Some dashpot is in series with a spring.
  bool has_series() const {
    return std::ranges::any_of(dashpot_stiffness, [](double stiffness) { return stiffness > 0; });
  }
  bool has_circle() const { return circle[0] != circle[1]; }
  bool is_in_circle(std::size_t component) const {
    return has_circle() &&
           (circle[0] == static_cast<int>(component) || circle[1] == static_cast<int>(component));
  }
  /// Whether a component may leave its straight line.
  bool yields(std::size_t component) const {
    return yield_force[component] > 0 || (friction > 0 && is_in_circle(component));
  }
  /// The option by which its force is no longer that of its stiffness; null: it is.
  const char* option() const {
    if (friction > 0) return "<structure>_<group>_sliding_friction";
    return yields() ? "<structure>_<group>_yield_force" : nullptr;
  }
  bool has_skeleton() const { return !law.positive.breaks.empty(); }
  /// Whether a component follows more than kinematic hardening of two slopes.
  bool is_hysteretic(std::size_t component) const {
    return yield_force[component] > 0 && (has_skeleton() || law.rule != HystereticRule::kinematic);
  }
  /// The law of a component that yields at a force of its own; `stiffness` before [N/m], `length`
  /// of a bar, 1 else [m].
  Hysteresis law_of(std::size_t component, double stiffness, double length) const {
    if (has_skeleton()) return scaled(law, length, 1);
    Hysteresis result = law;
    const double force = yield_force[component];
    result.lasting_energy *= length;
    result.positive = result.negative = {{{force / stiffness, force}}, hardening * stiffness};
    return result;
  }
  bool yields() const {
    for (std::size_t c = 0; c < yield_force.size(); ++c) {
      if (yields(c)) return true;
    }
    return false;
  }
};

}  // namespace pounding
