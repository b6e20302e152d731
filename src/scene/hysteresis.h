#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "scene/option_row.h"

namespace pounding {

/// Path that a law takes back from its skeleton and towards it again, see
/// docs/reference/nonlinear.md.
enum class HystereticRule : std::uint8_t {
  kinematic,  ///< the elastic range moves
  isotropic,  ///< the elastic range grows, both ways at once
  origin,     ///< back towards the origin
  peak,       ///< back by the unloading stiffness, then to the farthest point of the other side
  straight,   ///< back straight to the farthest point of the other side: no area
  bending,    ///< straight up to the second break, peak beyond
  pinching    ///< as peak, by way of a pinch
};

/// Words of the options for it, in its order.
inline constexpr std::string_view rule_words =
    "kinematic|isotropic|origin|peak|straight|bending|pinching";

/// Corner of a skeleton, both positive.
struct SkeletonBreak {
  double elongation = 0;  ///< [m], or strain, rotation, curvature
  double force = 0;       ///< [N], or moment
};

/// Skeleton of one direction: from the origin through its breaks, whose secant never grows, and on
/// by `last_slope`. Without breaks that direction carries nothing.
struct Skeleton {
  std::vector<SkeletonBreak> breaks;
  double last_slope = 0;
};

/// Law in one dimension: a skeleton in each direction and the rule of what is between them. The
/// first slope is the same in both.
struct Hysteresis {
  HystereticRule rule = HystereticRule::kinematic;
  Skeleton positive;
  Skeleton negative;  ///< of its elongations and forces taken positive
  /// Exponent a of the unloading stiffness k0 (k_s / k0)^a, k_s the secant of the farthest point.
  double unloading_exponent = 0;
  double unloading_least = 0;   ///< least unloading stiffness over k0
  double pinch_force = 0;       ///< of the pinch, over that of the farthest point
  double pinch_elongation = 0;  ///< of the pinch, over the way there from where no force acts
  /// Energy [J] that it can lose before its strength is gone; infinite: strength stays.
  double lasting_energy = std::numeric_limits<double>::infinity();
  double deterioration_exponent = 1;
  /// Part of the elongations that is elastic, over the force, and no part of the ductility: bending
  /// in series with a law in shear, within `positive` and `negative` already [m/N].
  double flexibility = 0;

  double first_slope() const {
    const Skeleton& given = positive.breaks.empty() ? negative : positive;
    return given.breaks.front().force / given.breaks.front().elongation;
  }
  /// Whether one of the directions carries nothing.
  bool is_one_sided() const { return positive.breaks.empty() || negative.breaks.empty(); }
};

/// Laws of a beam's section, along and about its local y and z; empty where it stays elastic.
struct YieldingSection {
  std::array<std::optional<Hysteresis>, 2> shear;    ///< force [N] over shear strain
  std::array<std::optional<Hysteresis>, 2> bending;  ///< moment [N m] over curvature [1/m]
  /// N_y [N] and a: an axial force N leaves 1 - (|N| / N_y)^a of the strength in bending; 0: all.
  double axial_strength = 0;
  double axial_exponent = 1;
};

/// A law in another unit of elongation: each elongation times `length`, forces times `strength`.
Hysteresis scaled(const Hysteresis& law, double length, double strength);

/// Shell that cracks by damage, see laws/cracking_shell.h. Ratios are of slopes: of
/// force over strain while damage grows, over that of the sound shell.
struct ShellCracking {
  double force = 0;        ///< in tension at which damage begins [N/m]
  double moment = 0;       ///< in bending likewise [N m/m]
  double tension = 0;      ///< ratio in tension
  double compression = 1;  ///< ratio in compression; 1: no damage by it
  double bending = 0;      ///< ratio in bending

  static void describe(auto& option) {
    using namespace option_words;
    // clang-format off
    option(&ShellCracking::force, "<structure>_<group>_cracking_force", real("N/m", absent("left out: elastic"), positive), "shell that cracks by damage: force per length in tension along one axis at which it begins", for_shells);
    option(&ShellCracking::moment, "<structure>_<group>_cracking_moment", real("N", absent("left out: cracking_force thickness / 6"), positive), "its moment per length about one axis at which damage begins", for_shells);
    option(&ShellCracking::tension, "<structure>_<group>_cracked_tension", real("-", absent("required with cracking_force"), below_1), "slope of its force while it cracks in tension, over that of the sound shell", for_shells);
    option(&ShellCracking::compression, "<structure>_<group>_cracked_compression", real("-", "1", up_to_1), "likewise in compression; 1: no damage by it", for_shells);
    option(&ShellCracking::bending, "<structure>_<group>_cracked_bending", real("-", absent("left out: cracked_tension"), below_1), "likewise in bending", for_shells);
    // clang-format on
  }
};

/// Law that a shell follows by its mean strains: one of both at most.
struct YieldingShell {
  std::optional<Hysteresis> shear;  ///< stress [Pa] over the shear strain in the plane
  std::optional<ShellCracking> cracking;
};

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

  bool has_circle() const { return circle[0] != circle[1]; }
  bool is_in_circle(std::size_t component) const {
    return has_circle() &&
           (circle[0] == static_cast<int>(component) || circle[1] == static_cast<int>(component));
  }
  /// Whether a component may leave its straight line.
  bool yields(std::size_t component) const {
    return yield_force[component] > 0 || (friction > 0 && is_in_circle(component));
  }
  bool has_skeleton() const { return !law.positive.breaks.empty(); }
  /// Whether a component yields at a force of its own, by a law in one dimension.
  bool yields_alone(std::size_t component) const {
    return yield_force[component] > 0 && !is_in_circle(component);
  }
  /// Whether some component does.
  bool yields_alone() const {
    for (std::size_t c = 0; c < yield_force.size(); ++c) {
      if (yields_alone(c)) return true;
    }
    return false;
  }
  bool yields() const {
    return friction > 0 || std::ranges::any_of(yield_force, [](double force) { return force > 0; });
  }
};

}  // namespace pounding
