#pragma once

#include <array>
#include <vector>

#include "interactions/laws/hysteresis_path.h"

namespace pounding::interactions {

/// Path of isotropic hardening, or softening: with the plastic elongation p and the length k of the
/// way that it has gone,
///
///     F = k0 (e - p),   -R-(k) <= F <= R+(k)
///
/// R the force of the skeleton at that much plastic elongation.
class IsotropicPath final : public HysteresisPath {
 public:
  explicit IsotropicPath(const Hysteresis& law);

  /// p and k.
  std::size_t memory_size() const override { return 2; }
  State follow(double from, double to, std::span<double> memory, double strength) const override;

 private:
  struct Point {
    double way = 0;    ///< k [m]
    double force = 0;  ///< R [N]
  };
  struct Side {
    std::vector<Point> points;
    double last_slope = 0;  ///< dR/dk beyond them

    double strength(double way) const;
  };
  /// The way k at which the force `trial` - k0 (k - way) is R.
  double return_to(const Side& side, double way, double trial) const;

  double stiffness_;
  std::array<Side, 2> sides_;  ///< of negative and of positive forces
};

}  // namespace pounding::interactions
