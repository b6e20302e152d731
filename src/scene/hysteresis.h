#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pounding {

/// Path that a law takes back from its skeleton and towards it again, see docs/nonlinear.md.
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

  /// One of its laws, and the plane in which it acts.
  struct Law {
    std::string name;  ///< "shear_y" say
    const Hysteresis* law = nullptr;
    bool shear = false;
    std::size_t axis = 0;  ///< 1: local y, 2: local z, along which or about which it acts
  };
  /// Its laws in the order in which they are numbered.
  std::vector<Law> laws() const;
  /// Their names.
  std::vector<std::string> names() const;
  bool any() const { return shear[0] || shear[1] || bending[0] || bending[1]; }
  /// The option that gave the first of them.
  const char* option() const {
    if (shear[0]) return "<structure>_<group>_shear_skeleton_y";
    if (shear[1]) return "<structure>_<group>_shear_skeleton_z";
    return bending[0] ? "<structure>_<group>_bending_skeleton_y"
                      : "<structure>_<group>_bending_skeleton_z";
  }
};

/// Same law of another unit of elongation: each elongation times `length`, forces times `strength`.
Hysteresis scaled(const Hysteresis& law, double length, double strength);

}  // namespace pounding
