#pragma once

#include <array>
#include <cstddef>

#include "interactions/laws/hysteresis_path.h"

namespace pounding::interactions {

/// Path that unloads from the skeleton to where no force acts and goes from there to the farthest
/// point (E, F) that the skeleton of the other side has reached, its first break at least:
///
///     F = min( k_u (e - p), envelope ),   k_u = max( k0 (k_s / k0)^a, least ),   k_s = F / E
///
/// in the direction of the force; p is where it would vanish. The envelope is the line from where
/// the side was entered to its farthest point, by way of the pinch where there is one, and the
/// skeleton beyond. a = 1 points to the origin; straight, k_u is the slope of the line that joins
/// the farthest points of both sides. A side that carries nothing is a gap.
///
/// Strength deteriorates at each passage through no force, by the part b of what is left,
/// b = (D / (L - sum D))^c, with D the energy lost since the last one, L the lasting energy.
class PeakPath final : public HysteresisPath {
 public:
  explicit PeakPath(const Hysteresis& law);

  std::size_t memory_size() const override { return numbers; }
  State follow(double from, double to, std::span<double> memory, double strength) const override;

 private:
  /// Places in the memory. Of a pair the first is of negative forces.
  enum Number : std::size_t {
    side_now,       ///< -1, 1; 0 before the first motion
    plastic,        ///< p
    entered_minus,  ///< e at which the side was entered
    entered_plus,
    beyond_minus,  ///< E less the elongation of the first break
    beyond_plus,
    reached,      ///< farthest since then, in its direction: up to there it loads as it unloads
    weakened,     ///< part of the strength that is gone
    lost_before,  ///< energy lost up to the last passage
    lost_since,   ///< and since then, with what is stored
    numbers
  };

  const Skeleton& skeleton(int side) const { return side > 0 ? law_.positive : law_.negative; }
  bool carries(int side) const { return !skeleton(side).breaks.empty(); }
  double first_break(int side) const { return skeleton(side).breaks.front().elongation; }
  double farthest(int side, std::span<const double> memory) const {
    return first_break(side) + memory[side > 0 ? beyond_plus : beyond_minus];
  }
  double on_skeleton(int side, double elongation, std::span<const double> memory) const {
    return (1 - memory[weakened]) * skeleton_force(skeleton(side), stiffness_, elongation);
  }
  bool goes_straight(std::span<const double> memory) const;
  double unloading(int side, std::span<const double> memory) const;
  double envelope(int side, double elongation, std::span<const double> memory) const;
  /// Elongation of the pinch; not beyond the one at which the side was entered if there is none.
  double pinch(int side, std::span<const double> memory) const;
  double next_corner(int side, double elongation, std::span<const double> memory) const;
  void load(int side, double from, double to, std::span<double> memory) const;
  void pass_through_zero(int side, std::span<double> memory) const;

  Hysteresis law_;
  double stiffness_;
};

}  // namespace pounding::interactions
